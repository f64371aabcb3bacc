// Where the body rests: painted on it with the pointer, solved as an organ file by a program behind
// the window.

#include "app/organs/support_painting.h"
#include "app/organs/support_panel.h"
#include "app/panels/panel_area.h"
#include "app/shell/child_program.h"
#include "app/shell/dock.h"
#include "app/shell/message_bar.h"
#include "app/supports/support_region.h"
#include "app/window/vtkPalpPressStyle.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/surface/surface_point.h"
#include "haptics/units.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkRenderWindowInteractor.h>

#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QScrollArea>

namespace palp
{
namespace
{

// what is felt of a surface, as a command reads it
QStringList argumentsOf(const MeshSource& source)
{
  QStringList words;
  source.bundled == "liver" ? void()
                            : words.push_back(QString::fromStdString(source.feltFile().string()));
  const auto add = [&words](const char* option, const std::string& value)
  { words << option << QString::fromStdString(value); };
  source.unit ? add("--unit", unitName(*source.unit)) : void();
  source.part.series.empty() ? void() : add("--series", source.part.series);
  source.part.level ? add("--level", shortest(*source.part.level)) : void();
  source.part.band ? add("--values", bandText(*source.part.band)) : void();
  source.part.labels.empty() ? void() : add("--label", labelsText(source.part.labels));
  return words;
}

} // namespace

// made when it is first asked for
void Window::showSupports()
{
  if (!isFree())
  {
    return;
  }
  if (painting_ == nullptr)
  {
    auto* panel = new SupportPanel;
    auto* area = new QScrollArea;
    scrollDownOnly(*area, panel);
    auto* dock = addDock(this, Qt::RightDockWidgetArea, tr("Supports"), area);
    if (auto* curves = findChild<QDockWidget*>(tr("Force over time")))
    {
      tabifyDockWidget(curves, dock); // the higher place, where all of it is seen
    }
    const auto changed = [this] { isStale_ = true; };
    const auto behind = [this](const std::function<FindRegion()>& read)
    { return inBackground<FindRegion>(tr("Reading what it rests on"), read); };
    painting_ = std::make_unique<SupportPainting>(*renderer_, *panel, undo_, changed, behind);
    connect(dock, &QDockWidget::visibilityChanged, this,
      [this, dock, panel]
      {
        painting_->setVisible(!dock->isHidden());
        dock->isHidden() ? panel->endPainting() : void();
      });
    followSupports();
    paintByPointer();
    openSupports();
  }
  auto* dock = findChild<QDockWidget*>(tr("Supports"));
  dock->show();
  bringUp(dock);
}

// what the panel asks for
void Window::followSupports()
{
  SupportPanel* panel = &painting_->panel();
  connect(panel, &SupportPanel::paintToggled, this,
    [this, before = view_.look().tool](bool paints) mutable
    {
      BodyLook look = view_.look();
      before = paints ? look.tool : before;
      look.tool = paints ? ToolLook::Outlined : before; // it hides what is below it
      view_.setLook(look);
      isStale_ = true;
    });
  connect(panel, &SupportPanel::clearAsked, this, [this] { painting_->clear(); });
  connect(panel, &SupportPanel::othersChanged, this,
    [this](const QString& supports)
    { attempt([&] { painting_->setOthers(supports.toStdString()); }); });
  connect(panel, &SupportPanel::solveAsked, this,
    [this]
    {
      const QString file = QFileDialog::getSaveFileName(
        this, tr("Solve into an organ file"), "body.organ", tr("Organ files (*.organ)"));
      file.isEmpty() ? false : solveOrgan(file);
    });
}

// the brush takes the place of the tool while it paints
void Window::paintByPointer()
{
  const auto paints = [this] { return painting_->panel().paints(); };
  // and all of the way, as a fast hand is told of at few of its places
  const auto last = std::make_shared<Eigen::Vector2d>();
  const auto paint = [this, last](int x, int y)
  {
    constexpr double kStep = 4.0; // [pixels]
    pointer_.hover(x, y);
    followPointer();
    const Eigen::Vector2d before = std::exchange(*last, Eigen::Vector2d(x, y));
    const int steps = 1 + static_cast<int>((*last - before).norm() / kStep);
    std::vector<SurfacePoint> places;
    for (int i = 1; i <= steps; ++i)
    {
      const Eigen::Vector2d at = before + (*last - before) * i / steps;
      const SightLine line = sightLine(at.x(), at.y());
      const auto place = pick(*supported().haptic, line.origin, line.direction);
      place ? places.push_back(*place) : void();
    }
    painting_->paint(places);
  };
  style_->Press = [last, paints, paint, press = style_->Press](int x, int y)
  {
    *last = { x, y };
    paints() ? paint(x, y) : press(x, y);
  };
  style_->Drag = [this, paints, paint, drag = style_->Drag](int pixelsDown)
  {
    const int* at = canvas_->interactor()->GetEventPosition();
    paints() ? paint(at[0], at[1]) : drag(pixelsDown);
  };
  style_->Release = [this, release = style_->Release]
  {
    painting_->endStroke();
    release();
  };
  style_->Wheel = [paints, wheel = style_->Wheel](int notches)
  { paints() ? void() : wheel(notches); };
  style_->Deepen = [this, paints, deepen = style_->Deepen](int steps)
  {
    const auto target = pointer_.target();
    if (!paints() || !target)
    {
      deepen(steps);
      return;
    }
    painting_->paint({ { target->position, target->normal } });
    painting_->endStroke();
  };
}

// the organ that is chosen, or the only body
const SceneBody& Window::supported() const
{
  return session_.body().felt(session_.organs(), chosenFelt().value_or(0));
}

void Window::openSupports()
{
  if (painting_ != nullptr)
  {
    attempt([&] { painting_->open(supported().haptic, supported().sources.front()); });
  }
}

// by palp organ, behind the window, which stays at 1 kHz; then felt
bool Window::solveOrgan(const QString& file)
{
  return attempt(
    [&]
    {
      const std::vector<MeshSource>& sources = supported().sources;
      if (sources.size() > 1)
      {
        throw Error(ErrorCode::BadValue,
          "an organ file is of one surface, these are several in one body; join them in one file");
      }
      const QString out = QFileInfo(file).absoluteFilePath();
      QStringList words = QStringList("organ") + argumentsOf(sources.front());
      for (const std::string& support : painting_->write(out.toStdString()))
      {
        words << "--support" << QString::fromStdString(support);
      }
      words << "--cell" << QString("%1mm").arg(units::toMillimeters(painting_->panel().cell()));
      words << "--poisson" << QString::number(tissueInUse().law.material().poissonRatio);
      words << "--out" << out;
      painting_->panel().endPainting();
      std::optional<EndedProgram> ended;
      saves_.write(
        [&]
        {
          ended = inBackground<EndedProgram>(
            tr("Solving how it gives way"), [words] { return runProgram("palp", words); });
        });
      if (!ended)
      {
        say(tr("Canceled: what was reached waits beside %1; Solve again goes on").arg(file));
        return;
      }
      throwUnlessWell(*ended);
      openOrgan(out);
    });
}

} // namespace palp
