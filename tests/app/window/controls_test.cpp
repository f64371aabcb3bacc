// What each control of the window and its dialogs tells, also to those who cannot see it, and which
// keys there are.
#include "tests/app/dialog_closer.h"
#include "tests/app/panels/label_map.h"
#include "tests/app/window/window_rig.h"

#include <QAccessible>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSlider>
#include <QTabBar>
#include <QToolButton>

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <vtkCamera.h>

namespace palp
{
namespace
{

using test::WindowTest;

ScenePlan twoOrgans()
{
  setenv("PALP_DATA", PALP_SHARE, 1);
  ScenePlan plan;
  plan.meshes = { { .bundled = "block_30" }, { .bundled = "sphere_30" } };
  plan.organs = { { .name = "block" }, { .name = "ball", .role = OrganRole::Through } };
  return plan;
}

// all that the window can show, and a hand that opens its dialogs
class Controls : public WindowTest
{
protected:
  Controls()
    : WindowTest(twoOrgans())
  {
    trigger("supportsAction");
    trigger("trainingAction");
    (void)showPlots();
    for (QDockWidget* dock : window_->findChildren<QDockWidget*>())
    {
      dock->show();
    }
  }

  void trigger(const char* action) const
  {
    window_->findChild<QAction*>(action)->trigger();
  }

  // to a screen reader, which takes the choice of a list for its name where there is no other
  [[nodiscard]] static bool isNamed(QWidget* widget)
  {
    const QAccessibleInterface* told = QAccessible::queryAccessibleInterface(widget);
    const bool isList = qobject_cast<const QComboBox*>(widget) != nullptr;
    return !widget->accessibleName().isEmpty() || !told->relations(QAccessible::Label).isEmpty() ||
      (!isList && !told->text(QAccessible::Name).isEmpty());
  }

  // of Qt's own, or a part of another one
  [[nodiscard]] static bool isStock(const QWidget* widget)
  {
    const QWidget* above = widget->parentWidget();
    const bool isOfFiles = qobject_cast<const QFileDialog*>(widget->window()) != nullptr &&
      qobject_cast<const QCheckBox*>(widget) == nullptr && widget->objectName() != "size";
    return isOfFiles || widget->objectName().startsWith("qt_") ||
      qobject_cast<const QHeaderView*>(widget) != nullptr ||
      qobject_cast<const QDialogButtonBox*>(above) != nullptr ||
      qobject_cast<const QAbstractSpinBox*>(above) != nullptr ||
      qobject_cast<const QComboBox*>(above) != nullptr ||
      qobject_cast<const QTabBar*>(above) != nullptr ||
      (qobject_cast<const QTabBar*>(widget) != nullptr && above == widget->window());
  }

  // what takes an order or a value; else it shows something, and is scrolled or turned by keys
  [[nodiscard]] static bool isControl(const QWidget* widget)
  {
    return qobject_cast<const QAbstractButton*>(widget) != nullptr ||
      qobject_cast<const QAbstractSpinBox*>(widget) != nullptr ||
      qobject_cast<const QComboBox*>(widget) != nullptr ||
      qobject_cast<const QLineEdit*>(widget) != nullptr ||
      qobject_cast<const QSlider*>(widget) != nullptr;
  }

  // what keys come to; returns how many
  [[nodiscard]] static int checkNames(const QWidget& all)
  {
    int found = 0;
    for (QWidget* widget : all.findChildren<QWidget*>())
    {
      if ((widget->focusPolicy() & Qt::TabFocus) == 0 || isStock(widget) ||
        widget->window() != all.window())
      {
        continue;
      }
      const std::string which =
        std::string(widget->metaObject()->className()) + ' ' + widget->objectName().toStdString();
      EXPECT_TRUE(isNamed(widget)) << which;
      EXPECT_TRUE(!isControl(widget) || !widget->toolTip().isEmpty()) << which;
      ++found;
    }
    return found;
  }

  // symbol, unit, range; then what it is
  [[nodiscard]] static int checkQuantities(const QWidget& all)
  {
    static const QRegularExpression told("^\\S{1,3} \\[\\S+\\]( of [^,]+)?, "
                                         "(more than 0|0 or more|[0-9.]+ to (less than )?\\w)");
    int found = 0;
    for (const QAbstractSpinBox* box : all.findChildren<QAbstractSpinBox*>())
    {
      EXPECT_TRUE(told.match(box->toolTip()).hasMatch())
        << box->objectName().toStdString() << ": " << box->toolTip().toStdString();
      ++found;
    }
    return found;
  }

  // looks at what opens, and closes it
  static void expectDialog(const std::function<void()>& open, int controls, int quantities)
  {
    const test::DialogCloser closer(
      [&](QDialog& dialog)
      {
        SCOPED_TRACE(dialog.windowTitle().toStdString());
        EXPECT_GE(checkNames(dialog), controls);
        EXPECT_EQ(checkQuantities(dialog), quantities);
      });
    open();
    EXPECT_GT(closer.count(), 0);
  }

  template <typename... Arguments>
  static void connect(Arguments&&... arguments)
  {
    QObject::connect(std::forward<Arguments>(arguments)...);
  }
};

TEST_F(Controls, OfTheWindowHaveANameAndSayWhatTheyDo)
{
  EXPECT_GE(checkNames(*window_), 60);
}

TEST_F(Controls, OfTheWindowTellSymbolUnitAndRange)
{
  EXPECT_GE(checkQuantities(*window_), 12);
}

TEST_F(Controls, OfDialogsTellAllOfIt)
{
  const auto image = test::writeLabelMap(folder_.path() / "labels.mha");
  expectDialog([&] { window_->openFile(QString::fromStdString(image.string())); }, 5, 0);
  expectDialog([this] { trigger("figureAction"); }, 8, 0);
  expectDialog([this] { trigger("mapAction"); }, 5, 3);
  expectDialog([this] { window_->findChild<QToolButton*>("axes")->click(); }, 6, 0);
}

// the sheet of keys, and a hand that tries every key in the picture
class Keys : public WindowTest
{
protected:
  Keys()
  {
    QTest::keyClick(window_.get(), Qt::Key_F1);
    auto* sheet = window_->findChild<QDialog*>("keySheet");
    for (const QLabel* label : sheet->findChildren<QLabel*>())
    {
      sheet_ << label->text().remove("<b>").remove("</b>");
    }
    sheet->close();
    for (QAction* action : window_->findChildren<QAction*>())
    {
      action->disconnect(); // is counted instead
      action->setEnabled(true);
      QObject::connect(action, &QAction::triggered, [this] { ++triggered_; });
    }
    canvas_->setFocus();
  }

  [[nodiscard]] bool isOnSheet(const QString& key) const
  {
    const QRegularExpression whole("(^|[ ,])" + QRegularExpression::escape(key) + "($|[ ,])",
      QRegularExpression::CaseInsensitiveOption);
    return !sheet_.filter(whole).isEmpty();
  }

  // by what the tool and the view come to
  [[nodiscard]] bool acts(int key, Qt::KeyboardModifiers modifiers)
  {
    constexpr double kAnswer = 0.05; // [s] of the servo's own time, which may be kept waiting
    const auto state = [this]
    {
      const double* eye = canvas_->renderWindow()
                            ->GetRenderers()
                            ->GetFirstRenderer()
                            ->GetActiveCamera()
                            ->GetPosition();
      Eigen::VectorXd all(6);
      all << Eigen::Map<const Eigen::Vector3d>(eye), session_->newest().pose.apex;
      return all;
    };
    const int triggered = triggered_;
    const Eigen::VectorXd before = state();
    QTest::keyClick(canvas_, static_cast<Qt::Key>(key), modifiers);
    const double at = session_->newest().time;
    EXPECT_TRUE(QTest::qWaitFor(
      [&] { return triggered_ > triggered || session_->newest().time > at + kAnswer; }, kPatience));
    constexpr double kMoved = 1e-5; // [m]; a tool that comes to rest moves by less
    const bool hasMoved = (state() - before).norm() > kMoved;
    hasMoved ? waitForRest() : void(); // else the next one would seem to have done it
    return triggered_ > triggered || hasMoved;
  }

  QStringList sheet_;
  int triggered_ = 0;
};

TEST_F(Keys, OfTheMenusActAsTheSheetSays)
{
  for (const QAction* action : window_->findChildren<QAction*>())
  {
    for (const QKeySequence& key : action->shortcuts())
    {
      const std::string name = key.toString(QKeySequence::NativeText).toStdString();
      EXPECT_TRUE(isOnSheet(QString::fromStdString(name))) << name;
      const bool isOfAList = action->shortcutContext() == Qt::WidgetWithChildrenShortcut;
      triggered_ = 0;
      QTest::keySequence(canvas_, key);
      EXPECT_EQ(triggered_, isOfAList ? 0 : 1) << name << ": one, and no other";
    }
  }
}

TEST_F(Keys, ThatActAreOnTheSheet)
{
  std::set<int> tried{ Qt::Key_Home, Qt::Key_End, Qt::Key_Insert, Qt::Key_Escape };
  for (const auto& [first, last] : { std::pair(Qt::Key_A, Qt::Key_Z), { Qt::Key_F1, Qt::Key_F20 },
         { Qt::Key_Space, Qt::Key_At }, { Qt::Key_Left, Qt::Key_PageDown } })
  {
    for (int key = first; key <= last; ++key)
    {
      tried.insert(key);
    }
  }
  const std::map<int, QString> names{ { Qt::Key_Left, "Arrows" }, { Qt::Key_Right, "Arrows" },
    { Qt::Key_Up, "Arrows" }, { Qt::Key_Down, "Arrows" }, { Qt::Key_PageDown, "Page Down" },
    { Qt::Key_PageUp, "Page Down or Up" } };
  int acting = 0;
  for (const int key : tried)
  {
    const auto named = names.find(key);
    const QString name = named == names.end() ? QKeySequence(key).toString() : named->second;
    for (const QString& with : { QString(), QString("Ctrl+") })
    {
      if (acts(key, with.isEmpty() ? Qt::NoModifier : Qt::ControlModifier))
      {
        EXPECT_TRUE(isOnSheet(with + name)) << (with + name).toStdString();
        ++acting;
      }
    }
  }
  EXPECT_GE(acting, 30);
}

} // namespace
} // namespace palp
