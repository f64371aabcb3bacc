#include "tests/app/window/window_rig.h"
#include "tests/support/csv_table.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QLineEdit>
#include <QPushButton>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

namespace palp
{
namespace
{

using test::WindowTest;

class PressBarTest : public WindowTest
{
protected:
  void typePlace(const std::string& place) const
  {
    auto* field = window_->findChild<QLineEdit*>("pressPlace");
    field->selectAll();
    QTest::keyClicks(field, QString::fromStdString(place));
  }
  void pressButton() const
  {
    QTest::mouseClick(window_->findChild<QPushButton*>("pressButton"), Qt::LeftButton);
  }

  // of the recording so far, where it was deepest
  [[nodiscard]] Sample deepest() const
  {
    Sample most;
    for (const Sample& sample : session_->recording().samples)
    {
      most = sample.contact.depth > most.contact.depth ? sample : most;
    }
    return most;
  }
};

// the command line presses there by a path of its own
TEST_F(PressBarTest, PressesWhereAndAsDeepAsTyped)
{
  typePlace("-48.5, 38.4, 39.5");
  type("pressDepth", "3.2");
  type("pressSpeed", "20 mm/s");
  pressButton();
  waitForPresses(1);
  const Sample most = deepest();
  EXPECT_NEAR(most.contact.depth, 3.2e-3, 0.02e-3);

  const std::string out = (folder_.path() / "out").string();
  const test::Finished run = test::runCommand(PALP_PROGRAM
    " run --at -48.5,38.4,39.5 --depth 3.2mm --speed 20mm/s --no-picture --out " +
    out);
  ASSERT_EQ(run.code, 0) << run.err;
  const std::vector<double> forces = test::readCsv(out + "/samples.csv")["force_N"];
  ASSERT_FALSE(forces.empty());
  EXPECT_NEAR(most.response.force, *std::ranges::max_element(forces), 0.01 * most.response.force);
}

// so that the next key acts on the picture
TEST_F(PressBarTest, ReturnGivesThePictureTheKeys)
{
  auto* field = window_->findChild<QLineEdit*>("pressPlace");
  field->setFocus();
  typePlace("0, 0, 900");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(window_->focusWidget(), field) << "what is refused is to be mended there";
  typePlace("-48.5, 38.4, 39.5");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(window_->focusWidget(), canvas_);
  waitForPresses(1);
}

// at each sample, however late the window is
TEST_F(PressBarTest, PressesAtTheTypedSpeed)
{
  typePlace("-48.5, 38.4, 39.5");
  type("pressDepth", "2");
  for (const double speed : { 1e-3, 10e-3, 100e-3 })
  {
    type("pressSpeed", (QString::number(1e3 * speed) + " mm/s").toUtf8());
    const std::size_t before = session_->presses().presses().size();
    pressButton();
    waitForPresses(before + 1);
    const PressSummary press = session_->presses().presses().back().summary;
    double most = 0.0;
    std::optional<double> first; // depth [m]
    int samples = 0;
    for (const Sample& sample : session_->recording().samples)
    {
      if (sample.time < press.begin)
      {
        continue;
      }
      const double depth = sample.contact.depth;
      first = first.value_or(depth);
      const double line = std::min(2e-3, *first + speed * (sample.time - press.begin));
      most = std::max(most, std::abs(depth - line));
      ++samples;
      if (depth > 2e-3 - 1e-7)
      {
        break;
      }
    }
    EXPECT_LT(most, 1e-6) << speed;
    EXPECT_GT(samples, 5) << speed;
    EXPECT_NEAR(press.deepest.depth, 2e-3, 1e-6) << speed;
  }
}

TEST_F(PressBarTest, KnowsThePlaceOfAPressByTheMouse)
{
  press(60);
  release();
  EXPECT_TRUE(waitForLift());
  const Sample byHand = deepest();
  const double asked = byHand.contact.depth;
  type("pressDepth", QString::number(1e3 * asked, 'f', 3).toUtf8());
  window_->findChild<QLineEdit*>("pressPlace")->setFocus();
  QTest::keyClick(window_->findChild<QLineEdit*>("pressPlace"), Qt::Key_Return);
  QTest::mouseMove(canvas_, canvas_->rect().center() + QPoint(60, 20)); // which leads it nowhere
  const double before = session_->newest().time;
  waitForPresses(2);
  Sample again;
  for (const Sample& sample : session_->recording().samples)
  {
    again = sample.time > before && sample.contact.depth > again.contact.depth ? sample : again;
  }
  EXPECT_NEAR(again.contact.depth, asked, 0.02e-3);
  EXPECT_LT((again.pose.apex - byHand.pose.apex).norm(), 0.5e-3);
}

TEST_F(PressBarTest, AnArrowKeyIsATenthOfAMillimeter)
{
  auto* depth = window_->findChild<QAbstractSpinBox*>("pressDepth");
  type("pressDepth", "12.3");
  QTest::keyClick(depth, Qt::Key_Up);
  EXPECT_EQ(depth->text(), "12.4 mm");
  type("pressDepth", "0.4");
  QTest::keyClick(depth, Qt::Key_Down);
  EXPECT_EQ(depth->text(), "0.3 mm");
}

// a list of 3D Slicer: one place is chosen, or all are pressed, each as deep as asked
TEST_F(PressBarTest, OffersAndPressesThePlacesOfAList)
{
  const auto file = folder_.path() / "places.fcsv";
  std::ofstream(file)
    << "# CoordinateSystem = LPS\n"
       "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
       "a,-48.5,38.4,39.5,0,0,0,1,1,1,0,back,,\n"
       "b,-14.8,-3.6,77.5,0,0,0,1,1,1,0,top,,\n";
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString(file.string()) }));
  auto* field = window_->findChild<QLineEdit*>("pressPlace");
  EXPECT_EQ(field->text(), "-48.50, 38.40, 39.50");
  EXPECT_TRUE(said().contains("2 places"));
  field->actions().last()->trigger();
  const QAbstractItemModel& list = *field->completer()->popup()->model();
  ASSERT_EQ(list.rowCount(), 2);
  EXPECT_TRUE(list.index(1, 0).data().toString().contains("top"));
  QTest::keyClick(field->completer()->popup(), Qt::Key_Down);
  QTest::keyClick(field->completer()->popup(), Qt::Key_Down);
  QTest::keyClick(field->completer()->popup(), Qt::Key_Return);
  EXPECT_EQ(field->text(), "-14.80, -3.60, 77.50");

  type("pressDepth", "2");
  type("pressSpeed", "20 mm/s");
  answer("Press all");
  const auto& presses = session_->presses().presses();
  EXPECT_TRUE(QTest::qWaitFor([&] { return presses.size() == 2; }, 2 * kPatience));
  const Eigen::Vector3d places[]{ { -48.5e-3, 38.4e-3, 39.5e-3 }, { -14.8e-3, -3.6e-3, 77.5e-3 } };
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_LT((presses.at(i).summary.deepest.center - places[i]).norm(), 1e-3);
    EXPECT_NEAR(presses.at(i).summary.deepest.depth, 2e-3, 0.02e-3);
    EXPECT_EQ(presses.at(i).summary.name, i == 0 ? "back" : "top");
  }
}

// as palp run does
TEST_F(PressBarTest, TellsOfPointsWithoutAPlaceAndNamesAPressByItsPoint)
{
  const auto file = folder_.path() / "places.mrk.json";
  std::ofstream(file) << R"({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
    "coordinateUnits": "mm", "controlPoints": [
    {"label": "back", "position": [-48.5, 38.4, 39.5], "positionStatus": "defined"},
    {"label": "top", "position": [0, 0, 0], "positionStatus": "undefined"}]}]})";
  ASSERT_TRUE(window_->openFiles({ QString::fromStdString(file.string()) }));
  EXPECT_TRUE(said().contains("1 place, ") && said().endsWith("1 point without a place left out"))
    << said().toStdString();
  pressButton();
  waitForPresses(1);
  typePlace("-14.8, -3.6, 77.5");
  pressButton();
  waitForPresses(2);
  const auto& presses = session_->presses().presses();
  EXPECT_EQ(presses[0].summary.name, "back");
  EXPECT_EQ(presses[1].summary.name, "press 2");
}

TEST_F(PressBarTest, RefusesInOneSentence)
{
  const auto said = [this]
  {
    pressButton();
    return WindowTest::said();
  };
  EXPECT_TRUE(said().contains("Place")) << said().toStdString(); // none is typed
  typePlace("1,2");
  EXPECT_TRUE(said().contains("Place"));
  typePlace("0,0,900");
  EXPECT_TRUE(said().contains("off the surface")) << said().toStdString();
  typePlace("-48.5,38.4,39.5");
  type("pressDepth", "99");
  EXPECT_TRUE(said().contains("half of the")) << said().toStdString();
  EXPECT_FALSE(session_->newest().contact.touching());
  type("pressDepth", "3");
  EXPECT_EQ(said().toStdString(), "") << "what was refused is mended";
  waitForPresses(1);
}

TEST_F(PressBarTest, NamesWhatIsWrongWithAPlace)
{
  for (const char* place : { "-48.5;38.4;39.5", "-48,5;38,4;39,5" })
  {
    typePlace(place);
    pressButton();
    EXPECT_TRUE(said().contains("no comma between its numbers")) << said().toStdString();
  }
  for (const char* place : { "abc", "-50 -20 60 3mm 20mm/s", "1,2,3mm" })
  {
    typePlace(place);
    pressButton();
    EXPECT_TRUE(said().startsWith("Place: ")) << said().toStdString();
  }
  typePlace("-48.5,38.4,39.5, 5 mm, 3mm/s"); // a speed, which has its own field
  pressButton();
  EXPECT_TRUE(said().startsWith("Place: '3mm/s' stands behind the depth")) << said().toStdString();
  typePlace("-48.5,38.4,39.5, 5"); // a depth without its unit
  pressButton();
  EXPECT_TRUE(said().startsWith("Depth: ") && said().contains("unit")) << said().toStdString();
}

// as long as a field holds it, whatever else is typed
TEST_F(PressBarTest, PressesNothingWhileAFieldHoldsWhatWasRefused)
{
  typePlace("-48.5, 38.4, 39.5");
  auto* depth = window_->findChild<QAbstractSpinBox*>("pressDepth");
  auto* message = window_->findChild<MessageBar*>();
  const QColor plain = depth->palette().color(QPalette::Text);
  type("pressDepth", "12,5");
  EXPECT_TRUE(said().contains("Depth: '12,5' has a comma")) << said().toStdString();
  EXPECT_NE(depth->palette().color(QPalette::Text), plain);
  type("pressSpeed", "20 mm/s");
  EXPECT_TRUE(said().contains("'12,5'")) << said().toStdString();
  type("pressSpeed", "0mm/s");
  EXPECT_TRUE(said().startsWith("Speed: ")) << said().toStdString();
  message->hide();
  pressButton();
  EXPECT_TRUE(said().contains("'12,5'")) << said().toStdString();
  waitForFrames(); // in which a press would have begun
  EXPECT_FALSE(session_->newest().contact.touching());
  EXPECT_EQ(session_->recording().deepest(), nullptr);

  type("pressSpeed", "20 mm/s");
  type("pressDepth", "2.5");
  EXPECT_FALSE(message->isVisible()) << "empty, over the picture";
  EXPECT_EQ(depth->palette().color(QPalette::Text), plain);
  pressButton();
  waitForPresses(1);
  EXPECT_NEAR(deepest().contact.depth, 2.5e-3, 0.02e-3);
}

// what was told since then is not taken away
TEST_F(PressBarTest, MendingAFieldLeavesOtherMessages)
{
  auto* message = window_->findChild<MessageBar*>();
  type("pressDepth", "12,5");
  message->tell("Something else");
  type("pressDepth", "2.5");
  EXPECT_EQ(said(), "Something else");
}

} // namespace
} // namespace palp
