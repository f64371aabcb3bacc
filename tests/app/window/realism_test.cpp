#include "app/shell/window_memory.h"
#include "pipeline/figure/gl_renderer.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/surfaces.h"

#include <QImage>

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <utility>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

namespace palp
{
namespace
{

using test::WindowTest;

class RealismTest : public WindowTest
{
protected:
  [[nodiscard]] QAction* action() const
  {
    return window_->findChild<QAction*>("realisticAction");
  }

  [[nodiscard]] QImage still() const
  {
    QImage picture;
    const auto isStill = [&]
    {
      const QImage before = std::exchange(picture, canvas_->grabFramebuffer());
      waitForFrames();
      return before == picture;
    };
    EXPECT_TRUE(QTest::qWaitFor(isStill, kPatience));
    return picture;
  }

  struct Change
  {
    double body = 0.0;   // share of pixels that differ clearly, in the middle
    double ground = 0.0; // and in the upper corners
  };

  [[nodiscard]] static Change changeOf(const QImage& a, const QImage& b)
  {
    const auto share = [&](const QRect& part)
    {
      int changed = 0;
      for (int y = part.top(); y <= part.bottom(); ++y)
      {
        for (int x = part.left(); x <= part.right(); ++x)
        {
          changed += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > 8 ? 1 : 0;
        }
      }
      return 1.0 * changed / (part.width() * part.height());
    };
    const QPoint middle = a.rect().center();
    return { .body = share(QRect(middle - QPoint(60, 60), QSize(120, 120))),
      .ground = share(QRect(0, 0, 60, 60)) };
  }
};

// this machine has no graphics card, or this test nothing to say of its default
TEST_F(RealismTest, IsOffWithoutACardTurnedOnByHandAndRemembered)
{
  window_->resize(kUsual);                 // as the next one will be
  QTest::mouseMove(canvas_, QPoint(5, 5)); // off the body
  const QImage plain = still();
  EXPECT_EQ(action()->isChecked(), !drawsInSoftware(rendererNameOf(*canvas_->renderWindow())));
  EXPECT_FALSE(WindowMemory().isRealistic()) << "nobody said so";
  if (action()->isChecked())
  {
    action()->trigger();
  }
  action()->trigger();
  const QImage wet = still();
  EXPECT_GT(changeOf(plain, wet).body, 0.3);
  EXPECT_LT(changeOf(plain, wet).ground, 0.01);
  EXPECT_EQ(WindowMemory().isRealistic(), true);
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  const QImage ball = still();

  window_ = std::make_unique<Window>(*session_, silent_); // the next start
  window_->show();
  canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
  EXPECT_TRUE(QTest::qWaitFor([this] { return action()->isChecked(); }, kPatience));
  EXPECT_LT(changeOf(ball, still()).body, 0.1) << "the same wet ball";

  action()->trigger();
  EXPECT_FALSE(action()->isChecked());
  const QImage dull = still();
  EXPECT_GT(changeOf(ball, dull).body, 0.3);
  EXPECT_EQ(WindowMemory().isRealistic(), false);
  EXPECT_FALSE(action()->toolTip().isEmpty());
}

class LargeSurface : public WindowTest
{
protected:
  // a ball of 60 mm
  [[nodiscard]] QString file() const
  {
    const auto [points, triangles] = test::ball(60.0, 190);
    const std::filesystem::path path = folder_.path() / "ball.off";
    std::ofstream out(path);
    out << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
    for (const Eigen::Vector3d& p : points)
    {
      out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    for (const Triangle& triangle : triangles)
    {
      out << "3 " << triangle[0] << ' ' << triangle[1] << ' ' << triangle[2] << '\n';
    }
    return QString::fromStdString(path.string());
  }

  // of what is drawn with the most
  [[nodiscard]] vtkIdType triangles() const
  {
    vtkActorCollection& actors =
      *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer()->GetActors();
    vtkIdType most = 0;
    actors.InitTraversal();
    while (vtkActor* actor = actors.GetNextActor())
    {
      auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
      const bool isDrawn = mapper != nullptr && mapper->GetInput() != nullptr;
      most = std::max(most, isDrawn ? mapper->GetInput()->GetNumberOfCells() : 0);
    }
    return most;
  }

  // in any picture meanwhile
  void expectFewIn(const std::function<void()>& work)
  {
    std::vector<vtkIdType> counts;
    std::function<void()> count = [&] { counts.push_back(triangles()); };
    vtkNew<vtkCallbackCommand> drawn;
    drawn->SetClientData(&count);
    drawn->SetCallback([](vtkObject*, unsigned long, void* data, void*)
      { (*static_cast<std::function<void()>*>(data))(); });
    const auto observer = canvas_->renderWindow()->AddObserver(vtkCommand::EndEvent, drawn);
    work();
    waitForFrames(2);
    canvas_->renderWindow()->RemoveObserver(observer);
    EXPECT_EQ(session_->body().display->GetNumberOfCells(), 12 * 190 * 190);
    ASSERT_FALSE(counts.empty());
    EXPECT_GT(std::ranges::min(counts), 10'000);
    EXPECT_LT(std::ranges::max(counts), 100'000);
    EXPECT_TRUE(said().contains("433,200 take long here")) << said().toStdString();
  }
};

TEST_F(LargeSurface, IsNeverDrawnWholeWhereThatTakesLong)
{
  if (!drawsInSoftware(rendererNameOf(*canvas_->renderWindow())))
  {
    GTEST_SKIP() << "a graphics card draws";
  }
  waitForFrames();
  expectFewIn([this] { ASSERT_TRUE(window_->openFile(file())); });
  EXPECT_TRUE(said().contains("Opened ball.off")) << said().toStdString();

  window_.reset(); // and of the command line
  session_ =
    std::make_unique<Session>(ScenePlan{ .meshes = { { .file = file().toStdString() } } }, silent_);
  window_ = std::make_unique<Window>(*session_, silent_);
  canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
  expectFewIn([this] { window_->show(); });
}

} // namespace
} // namespace palp
