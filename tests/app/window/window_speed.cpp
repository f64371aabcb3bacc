// What the window takes, printed: a machine that does much else takes more, so it is no test.
// window_speed [MINUTES [FILE]]: of random presses as a servo of 1 kHz records them, for the
// memory; 0 without. FILE: a body.
#include "app/program/machine.h"
#include "tests/app/window/window_rig.h"

#include <QElapsedTimer>
#include <QWheelEvent>

#include <cstdio>
#include <fstream>
#include <malloc.h>
#include <random>
#include <sys/resource.h>
#include <unistd.h>

namespace palp
{
namespace
{

double minutes = 0.0;
ScenePlan plan;

// [s] since this program was started
double age()
{
  std::ifstream stat("/proc/self/stat");
  std::string word;
  for (int i = 0; i < 22; ++i) // the 22nd tells the start, and no name here has a blank
  {
    stat >> word;
  }
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
    std::stod(word) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// [s] on processors, all threads
double work()
{
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time)
  { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double megabytes()
{
  std::ifstream status("/proc/self/statm");
  double pages = 0.0;
  status >> pages >> pages;
  return 1e-6 * pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

class Speed : public test::WindowTest
{
protected:
  explicit Speed(const ScenePlan& scene = plan)
    : WindowTest(scene)
  {
    started_ = age();
    window_->resize(1440, 860);
    waitFor([](const Sample&) { return true; });
  }

  void moveTo(QPoint place) const
  {
    QTest::mouseMove(canvas_, place);
  }

  // after each picture of the canvas, until the end of the call
  void whileDrawn(const std::function<void()>& drawn, const std::function<void()>& work) const
  {
    vtkNew<vtkCallbackCommand> command;
    std::function<void()> call = drawn;
    command->SetClientData(&call);
    command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
      { (*static_cast<std::function<void()>*>(data))(); });
    const auto observer = canvas_->renderWindow()->AddObserver(vtkCommand::EndEvent, command);
    work();
    canvas_->renderWindow()->RemoveObserver(observer);
  }

  double started_ = 0.0; // [s]
};

TEST_F(Speed, FirstPicture)
{
  std::printf("first picture after %.2f s\n", started_);
}

// until the picture tells another depth
TEST_F(Speed, PointerToPicture)
{
  press(60);
  std::vector<double> delays;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> pause(250, 300); // [ms]: after the smooth picture, at any tick
  for (int i = 0; i < 40; ++i)
  {
    const QString before = readings();
    QElapsedTimer clock;
    double delay = 0.0;
    whileDrawn(
      [&]
      {
        if (delay == 0.0 && readings() != before)
        {
          delay = 1e-6 * static_cast<double>(clock.nsecsElapsed());
        }
      },
      [&]
      {
        clock.start();
        moveTo(canvas_->rect().center() + QPoint(0, i % 2 == 0 ? 70 : 60));
        while (delay == 0.0) // QTest looks every 10 ms alone
        {
          QApplication::processEvents(QEventLoop::WaitForMoreEvents);
        }
      });
    delays.push_back(delay);
    waitForRest();
    QTest::qWait(pause(random));
  }
  std::ranges::sort(delays);
  std::printf("pointer to picture: median %.0f ms, 95 %% within %.0f ms\n",
    delays[delays.size() / 2], delays[delays.size() * 95 / 100]);
}

// a held depth, along the surface and back
TEST_F(Speed, Sliding)
{
  const QPoint middle = canvas_->rect().center();
  moveTo(middle);
  waitFor([](const Sample&) { return true; });
  for (int i = 0; i < 10; ++i) // 5 mm
  {
    QWheelEvent notch(middle, canvas_->mapToGlobal(middle), {}, QPoint(0, -120), Qt::NoButton,
      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(canvas_, &notch);
  }
  waitForRest();
  int pictures = 0;
  constexpr int kTime = 10'000; // [ms]
  const double before = work();
  whileDrawn([&] { ++pictures; },
    [&]
    {
      QElapsedTimer clock;
      clock.start();
      for (int i = 0; clock.elapsed() < kTime; ++i)
      {
        const int along = i % 160 < 80 ? i % 160 : 160 - i % 160;
        moveTo(middle + QPoint(along - 40, 0));
        QTest::qWait(8);
      }
    });
  const double used = work() - before;
  std::printf("sliding %.1f mm deep: %.1f pictures/s at %d x %d, %.1f ms of processors each\n",
    1e3 * session_->newest().contact.depth, 1e3 * pictures / kTime, window_->width(),
    window_->height(), 1e3 * used / pictures);
}

// what a picture of a press takes where nothing moves: drawn alone, and brought to the screen
TEST_F(Speed, Parts)
{
  constexpr int kPictures = 60;
  press(60);
  const auto timeOf = [](const std::function<void()>& draw)
  {
    const double before = work();
    QElapsedTimer clock;
    clock.start();
    for (int i = 0; i < kPictures; ++i)
    {
      draw();
    }
    return QString("%1 ms (%2 ms of processors)")
      .arg(1e-6 * static_cast<double>(clock.nsecsElapsed()) / kPictures, 0, 'f', 1)
      .arg(1e3 * (work() - before) / kPictures, 0, 'f', 1)
      .toStdString();
  };
  auto& window = *static_cast<vtkGenericOpenGLRenderWindow*>(canvas_->renderWindow());
  moveTo(canvas_->rect().center() + QPoint(0, 61)); // as while it moves
  QTest::qWait(50);
  const auto drawn = [&]
  {
    window.Render();
    window.WaitForCompletion();
  };
  const std::string alone = timeOf(drawn);
  const std::string shown = timeOf(
    [&]
    {
      window.Render();
      canvas_->repaint();
    });
  std::printf("a picture of %d x %d pixels that nothing changes: VTK %s, with the window %s\n",
    canvas_->width(), canvas_->height(), alone.c_str(), shown.c_str());
}

TEST_F(Speed, Idle)
{
  QTest::qWait(5'000);
  constexpr int kTime = 30'000; // [ms]
  const double before = work();
  QTest::qWait(kTime);
  std::printf("idle: %.1f %% of a core\n", 1e5 * (work() - before) / kTime);
}

// what fills the ring of ten minutes in two and a half
class FastServo : public Speed
{
protected:
  static constexpr double kTimes = 4.0; // faster than else

  FastServo()
    : Speed(fast())
  {
  }

  static ScenePlan fast()
  {
    ScenePlan scene = plan;
    scene.servoPeriod /= kTimes;
    return scene;
  }

  void pressOnce(std::mt19937& random) const
  {
    std::uniform_int_distribution<int> aside(-120, 120);
    std::uniform_int_distribution<int> down(10, 90);
    const QPoint place = canvas_->rect().center() + QPoint(aside(random), aside(random) / 2);
    moveTo(place);
    QTest::qWait(50);
    QTest::mousePress(canvas_, Qt::LeftButton, {}, place);
    for (int i = 0; i < 20; ++i)
    {
      moveTo(place + QPoint(aside(random) / 10, down(random)));
      QTest::qWait(40);
    }
    QTest::mouseRelease(canvas_, Qt::LeftButton);
    QTest::qWait(100);
  }
};

TEST_F(FastServo, Memory)
{
  std::mt19937 random(1);
  double told = 0.0;
  QElapsedTimer clock;
  clock.start();
  for (double now = 0.0; now < minutes; now = kTimes * static_cast<double>(clock.elapsed()) / 6e4)
  {
    pressOnce(random);
    if (told <= now)
    {
      const Recording& recording = session_->recording();
      const std::size_t samples = recording.samples.size();
      const struct mallinfo2 heap = mallinfo2();
      std::printf("memory: %.1f MB after %.0f min of random presses, %.1f in use of a heap of %.1f "
                  "and of %.1f in large blocks; %zu samples, %zu of them thinned; %zu presses\n",
        megabytes(), told, 1e-6 * static_cast<double>(heap.uordblks),
        1e-6 * static_cast<double>(heap.arena), 1e-6 * static_cast<double>(heap.hblkhd), samples,
        recording.thinned, session_->presses().presses().size());
      std::fflush(stdout);
      told += 1.0;
    }
  }
}

} // namespace
} // namespace palp

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  palp::giveBackLargeBlocks(); // as the program does
  palp::minutes = argc > 1 ? std::stod(argv[1]) : 0.0;
  if (argc > 2)
  {
    palp::plan.meshes = { { .file = argv[2] } };
  }
  return RUN_ALL_TESTS();
}
