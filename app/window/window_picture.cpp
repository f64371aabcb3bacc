// How the window's picture is looked at.

#include "app/shell/theme.h"
#include "app/window/window.h"
#include "pipeline/figure/gl_renderer.h"
#include "pipeline/view/appearance.h"

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QActionGroup>
#include <QMenu>

#include <array>
#include <cmath>

namespace palp
{

// by the sides of a patient in LPS, which other surfaces are looked at by, too
void Window::addStandardViews(QMenu& menu)
{
  struct Standard
  {
    QString name;
    Eigen::Vector3d eye;
    Eigen::Vector3d up;
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const std::array<Standard, 6> views{ { { tr("&Anterior, from -y"), -y, z },
    { tr("&Posterior, from +y"), y, z }, { tr("&Left, from +x"), x, z },
    { tr("&Right, from -x"), -x, z }, { tr("&Superior, from +z"), z, -y },
    { tr("&Inferior, from -z"), -z, -y } } };
  QMenu* standard = menu.addMenu(tr("&Standard views"));
  int key = Qt::Key_1;
  const auto add = [&](const QString& name, const std::function<void()>& look)
  {
    standard->addAction(
      name, this,
      [this, look]
      {
        keepView();
        look();
        isStale_ = true;
      },
      QKeySequence(static_cast<int>(Qt::CTRL) | key++));
  };
  for (const Standard& view : views)
  {
    add(view.name, [this, view] { view_.lookFrom(view.eye, view.up); });
  }
  add(tr("From the &tool"),
    [this]
    {
      const Eigen::Vector3d eye = -shown_.pose.axis.normalized();
      const bool isUpright = std::abs(eye.z()) > 0.9;
      view_.lookFrom(eye, { 0.0, isUpright ? -1.0 : 0.0, isUpright ? 0.0 : 1.0 });
    });
}

// of the picture and the charts, which know no palette
void Window::takeTheme()
{
  using appearance::Color;
  const bool dark = isDark(palette());
  const Color ground = dark ? Color{ 0.16, 0.17, 0.19 } : appearance::kGround;
  const Color sky = dark ? Color{ 0.30, 0.32, 0.35 } : appearance::kSky;
  renderer_->SetBackground(ground[0], ground[1], ground[2]);
  renderer_->SetBackground2(sky[0], sky[1], sky[2]);
  orientation_.setInk(dark ? appearance::kSky : appearance::kInk);
  scaleBar_.setInk(dark ? appearance::kSky : appearance::kInk);
  isStale_ = true;
  undrawn_ = chartPanels_;
  chartsAreStale_ = true;
}

void Window::addMarks(QMenu& menu)
{
  const auto add = [&](const QString& name, const char* id, const std::function<void(bool)>& show)
  {
    QAction* action = menu.addAction(name);
    action->setObjectName(id);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this,
      [this, show](bool on)
      {
        show(on);
        isStale_ = true;
      });
    action->setChecked(true);
  };
  add(tr("A&xes"), "axesAction", [this](bool on) { orientation_.setVisible(on); });
  add(tr("Scale &bar"), "scaleBarAction", [this](bool on) { scaleBar_.setVisible(on); });
}

void Window::addBodyLooks(QMenu& menu)
{
  struct Part
  {
    QString name;
    const char* id;
    bool BodyLook::*part;
  };
  for (const Part& one : { Part{ tr("&Edges of triangles"), "edgesAction", &BodyLook::hasEdges },
         { tr("See-through s&urface"), "translucentAction", &BodyLook::isTranslucent },
         Part{ tr("Cut &open at the contact"), "cutAction", &BodyLook::isCut } })
  {
    QAction* action = menu.addAction(one.name);
    action->setObjectName(one.id);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this,
      [this, part = one.part](bool on)
      {
        BodyLook look = view_.look();
        look.*part = on;
        view_.setLook(look);
        showInside();
      });
  }
  addToolLooks(*menu.addMenu(tr("&Tool")));
  addRealism(menu);
  menu.addSeparator();
}

// one after the other by a key
void Window::addToolLooks(QMenu& menu)
{
  menu.setObjectName("toolLooks");
  auto* looks = new QActionGroup(this);
  for (const auto& [name, tool] : { std::pair(tr("&Solid"), ToolLook::Solid),
         { tr("&Outlined"), ToolLook::Outlined }, { tr("&Hidden"), ToolLook::Hidden } })
  {
    QAction* action = looks->addAction(menu.addAction(name));
    action->setCheckable(true);
    action->setChecked(tool == view_.look().tool);
    connect(action, &QAction::toggled, this,
      [this, tool = tool](bool on)
      {
        BodyLook look = view_.look();
        look.tool = on ? tool : look.tool;
        view_.setLook(look);
        isStale_ = true;
      });
  }
  menu.addSeparator();
  menu.addAction(
    tr("&Next look of the tool"), this,
    [looks]
    {
      const QList<QAction*> all = looks->actions();
      all[(all.indexOf(looks->checkedAction()) + 1) % all.size()]->setChecked(true);
    },
    QKeySequence(Qt::Key_T));
}

void Window::addRealism(QMenu& menu)
{
  realistic_ = menu.addAction(tr("Realis&tic light"));
  realistic_->setObjectName("realisticAction");
  realistic_->setCheckable(true);
  realistic_->setToolTip(
    tr("Wet surface (PBR), darker where little light comes (SSAO): on by itself "
       "where a graphics card draws; without one a picture takes a second"));
  connect(realistic_, &QAction::toggled, this, &Window::setRealistic);
  connect(realistic_, &QAction::triggered, this, [this](bool on) { memory_.setRealistic(on); });
}

void Window::setRealistic(bool on)
{
  on ? realism_.turnOn(vtkPolyData::SafeDownCast(view_.press().GetInput())->GetLength())
     : realism_.turnOff();
  setSmooth(false);
  isStale_ = true;
}

// once something was drawn, which tells what draws
void Window::chooseRealism()
{
  if (!hasCard_ && renderWindow_->GetNeverRendered() == 0)
  {
    hasCard_ = !drawsInSoftware(rendererNameOf(*renderWindow_));
    realistic_->setChecked(memory_.isRealistic().value_or(*hasCard_));
    *hasCard_ ? showPictured() : void(); // whole
  }
}

// once of each body that is drawn with fewer triangles than it has
void Window::tellCoarse()
{
  const SceneBody& body = session_.body();
  vtkSmartPointer<vtkPolyData> last;
  vtkIdType drawn = 0;
  vtkIdType all = 0;
  const auto add = [&](const SceneBody& one)
  {
    if (one.coarse != nullptr)
    {
      last = one.coarse;
      drawn += one.coarse->GetNumberOfCells();
      all += one.display->GetNumberOfCells();
    }
  };
  body.organs.empty() ? add(body) : void(std::ranges::for_each(body.organs, add));
  if (hasCard_ != false || coarseTold_ == last)
  {
    return;
  }
  coarseTold_ = last;
  if (coarseTold_ != nullptr)
  {
    message_->add(
      tr("Drawn with %L1 triangles, as %L2 take long here; all of them are felt and exported")
        .arg(drawn)
        .arg(all));
  }
}

// all of the body, until the user looks at it in another way
void Window::fitView()
{
  const int* size = renderWindow_->GetSize();
  if (fittedTo_ && *fittedTo_ != std::pair(size[0], size[1]))
  {
    fittedTo_ = std::pair(size[0], size[1]);
    view_.lookAtSurface();
    isStale_ = true;
  }
}

void Window::keepView()
{
  fittedTo_.reset();
  still_ = 0;
  setSmooth(false);
}

// what lies behind each other is seen in its order by the slow way alone
void Window::setSmooth(bool smooth)
{
  const bool isFast = !smooth && !realism_.isOn() && !view_.look().isTranslucent;
  renderer_->SetGradientBackground(!isFast);
  if (realism_.isOn())
  {
    return; // its edges are smooth
  }
  renderer_->SetUseFXAA(smooth);
  renderer_->SetPass(isFast ? fast_.Get() : nullptr);
}

// what moves is drawn as soon as can be, what stands still with smooth edges and where it came to
void Window::smoothen(const Sample& newest)
{
  constexpr int kStill = 12; // pictures
  if (++still_ == kStill)
  {
    setSmooth(true);
    shown_ = newest;
    other_.show(shown_, other_.shown());
    renderWindow_->Render();
    showReadings();
  }
}

} // namespace palp
