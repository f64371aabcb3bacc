// How long the window waits at most for what it does, printed: no test, as another program's work
// counts, too. window_waits [FILE]: a body to open.
#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QPushButton>

#include <cstdio>
#include <fstream>

namespace palp
{
namespace
{

std::filesystem::path body;

class Waits : public test::WindowTest
{
protected:
  Waits()
  {
    window_->resize(1440, 860);
    waitFor([](const Sample&) { return true; });
  }

  [[nodiscard]] QString file(const char* name) const
  {
    return QString::fromStdString((folder_.path() / name).string());
  }
};

// [ms] on a processor, of this thread
double ownWork()
{
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

// [ms] that this thread, the first, was ready to go on while others had the processors
double ownQueue()
{
  std::ifstream stat("/proc/self/schedstat");
  double ran = 0.0;
  double waited = 0.0;
  stat >> ran >> waited;
  return 1e-6 * waited;
}

struct Wait
{
  double longest = 0.0; // between two turns of the event loop [ms]
  double work = 0.0;    // of that, on a processor
  double queue = 0.0;   // and ready for one
  double most = 0.0;    // work in any turn [ms]
};

Wait longestWait(const std::function<void()>& work)
{
  QElapsedTimer since;
  Wait wait;
  double before = ownWork();
  double queued = ownQueue();
  QTimer turn;
  QObject::connect(&turn, &QTimer::timeout,
    [&]
    {
      const double took = 1e-6 * static_cast<double>(since.nsecsElapsed());
      since.start();
      const double ran = ownWork();
      const double ready = ownQueue();
      const double most = std::max(wait.most, ran - before);
      wait = took > wait.longest ? Wait{ took, ran - before, ready - queued } : wait;
      wait.most = most;
      before = ran;
      queued = ready;
    });
  turn.start(0);
  since.start();
  work();
  QTest::qWait(50);
  return wait;
}

void printWait(const char* what, const std::function<void()>& work)
{
  QElapsedTimer clock;
  clock.start();
  const Wait wait = longestWait(work);
  std::printf("%s: %.1f s, longest wait of the window %.0f ms: at work %.0f, for a core %.0f; most "
              "work in any %.0f ms\n",
    what, 1e-3 * static_cast<double>(clock.elapsed()), wait.longest, wait.work, wait.queue,
    wait.most);
}

TEST_F(Waits, Saving)
{
  press(60);
  QTest::qWait(1000);
  printWait("at rest", [] { QTest::qWait(10'000); });
  for (const ImageSize size : { ImageSize{ 1920, 1080 }, { 3840, 2160 }, { 7680, 4320 } })
  {
    const std::string of =
      " of " + std::to_string(size.width) + " x " + std::to_string(size.height);
    printWait(("figure" + of).c_str(),
      [&] { window_->saveFigure(file("figure.png"), size, { .isRealistic = true }); });
    printWait(("chart" + of).c_str(), [&] { window_->saveChart(0, file("chart.png"), size); });
  }
  for (const char* name : { "curves.svg", "curves.pdf", "curves.csv" })
  {
    printWait(name, [&] { window_->saveCurves(file(name)); });
  }
  printWait("screenshot", [&] { window_->saveScreenshot(file("shot.png")); });
  release();
}

TEST_F(Waits, Exporting)
{
  press(60);
  release();
  waitForPresses(1);
  printWait("movie", [&] { window_->saveReplay(file("press.mp4")); });
  printWait("export", [&] { window_->exportData(file("export")); });
}

// each by the widget that does it, back and forth by undo and redo
TEST_F(Waits, Changing)
{
  press(60);
  release();
  waitForPresses(1);
  const auto choose = [this](const char* what, const char* box, int item)
  {
    auto* choices = window_->findChild<QComboBox*>(box);
    printWait(what, [&] { choices->setCurrentIndex(item); });
  };
  const auto trigger = [this](const char* key)
  {
    for (QAction* action : window_->findChildren<QAction*>())
    {
      if (action->shortcuts().contains(QKeySequence(key)))
      {
        printWait(key, [action] { action->trigger(); });
      }
    }
  };
  choose("cone", "kind", 1);
  choose("flat punch", "kind", 2);
  choose("blunt cone", "kind", 4);
  choose("exact law", "law", 1);
  choose("corrected law", "law", 2);
  choose("sphere, corrected", "kind", 0);
  printWait("its radius", [&] { type("radius", "7 mm"); });
  for (const char* key : { "Ctrl+Z", "Ctrl+Y" })
  {
    for (int i = 0; i < 7; ++i)
    {
      trigger(key);
    }
  }
}

TEST_F(Waits, Opening)
{
  for (const std::filesystem::path& file :
    { body, std::filesystem::path(PALP_SHARE "/meshes/liver.vtp"), body })
  {
    if (!file.empty())
    {
      printWait(
        file.filename().c_str(), [&] { window_->openFile(QString::fromStdString(file.string())); });
      printWait("its first pictures", [] { QTest::qWait(5'000); });
    }
  }
}

TEST_F(Waits, Checking)
{
  body.empty() ? void() : void(window_->openFile(QString::fromStdString(body.string())));
  QTest::qWait(3'000);
  const auto trigger = [this](const char* action)
  { window_->findChild<QAction*>(action)->trigger(); };
  for (const char* what : { "check", "check again" })
  {
    printWait(what, [&] { trigger("checkAction"); });
    printWait("its first pictures", [] { QTest::qWait(2'000); });
  }
  for (auto* button : window_->findChildren<QPushButton*>())
  {
    button->text().remove('&') == "Look at" ? printWait("look at", [&] { button->click(); })
                                            : void();
  }
  auto* dock = window_->findChild<QDockWidget*>("Surface check");
  printWait("closed",
    [&]
    {
      dock->close();
      QTest::qWait(500);
    });
}

} // namespace
} // namespace palp

int main(int argc, char** argv)
{
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  testing::InitGoogleTest(&argc, argv);
  palp::body = argc > 1 ? argv[1] : "";
  return RUN_ALL_TESTS();
}
