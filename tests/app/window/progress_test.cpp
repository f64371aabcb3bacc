#include "tests/app/dialog_closer.h"
#include "tests/app/window/window_rig.h"

#include <QAbstractButton>
#include <QDialog>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

using test::WindowTest;

// long work, as the bar of messages tells of it
class Progress : public WindowTest
{
protected:
  struct Told
  {
    std::set<QString> texts;
    std::set<int> percents; // without those that nobody knew
  };

  // what it tells while something is done; canceled by its button once it tells something, of as
  // many percents as that
  Told whileDone(
    const std::function<void()>& work, const QString& cancelAt = {}, std::size_t percents = 0)
  {
    Told told;
    QTimer look;
    auto* bar = window_->findChild<MessageBar*>();
    QObject::connect(&look, &QTimer::timeout,
      [&]
      {
        auto* progress = bar->findChild<QProgressBar*>("progress");
        if (!progress->isVisible())
        {
          return;
        }
        told.texts.insert(bar->text());
        progress->maximum() > 0 ? void(told.percents.insert(progress->value())) : void();
        for (auto* button : bar->findChildren<QPushButton*>())
        {
          const bool isTime = !cancelAt.isEmpty() && bar->text().contains(cancelAt) &&
            told.percents.size() >= percents;
          isTime && button->text() == "Cancel" ? button->click() : void();
        }
      });
    look.start(10);
    work();
    return told;
  }

  // of programs whose arguments name a file
  [[nodiscard]] static int processesWith(const std::string& file)
  {
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
    {
      const std::string line = test::readAll(entry.path() / "cmdline");
      found += line.find(file) != std::string::npos ? 1 : 0;
    }
    return found;
  }

  // of the event loop, with a program at work that something is drawn by
  static int turnsWhile(const std::string& program, const std::function<void()>& drawn)
  {
    int turns = 0;
    QTimer turn;
    QObject::connect(&turn, &QTimer::timeout, [&] { turns += processesWith(program) > 0 ? 1 : 0; });
    turn.start(0);
    drawn();
    return turns;
  }

  // a sheet of two million triangles, which takes seconds
  [[nodiscard]] QString largeSurface() const
  {
    constexpr int kSide = 1000;
    const auto file = folder_.path() / "large.obj";
    std::ofstream out(file);
    for (int i = 0; i < kSide * kSide; ++i)
    {
      out << "v " << 0.1 * (i % kSide) << ' ' << 0.1 * (i / kSide) << " 0\n";
    }
    for (int i = 1; i < kSide * (kSide - 1); ++i)
    {
      i % kSide == 0 ? void()
                     : void(out << "f " << i << ' ' << i + 1 << ' ' << i + kSide << "\nf " << i + 1
                                << ' ' << i + kSide + 1 << ' ' << i + kSide << '\n');
    }
    return QString::fromStdString(file.string());
  }
};

TEST_F(Progress, OfReadingTellsPercentAndCancelEndsTheReader)
{
  const QString file = largeSurface();
  const std::string before = session_->body().name;
  bool isOpened = true;
  const Told told = whileDone([&] { isOpened = window_->openFile(file); }, "Reading");
  EXPECT_FALSE(told.texts.empty()) << "done before it was told of";
  EXPECT_FALSE(isOpened);
  EXPECT_EQ(session_->body().name, before);
  EXPECT_TRUE(QTest::qWaitFor([&] { return processesWith(file.toStdString()) == 0; }, 500))
    << "it reads on unseen";
}

// which asks for the unit, and is not told of as if it went on
TEST_F(Progress, OfReadingEndsWhereItFails)
{
  const std::filesystem::path odd = folder_.path() / "odd.obj";
  std::ofstream(odd) << "v 0 0 0\nv 9e9 0 0\nv 0 9e9 0\nf 1 2 3\n";
  QString behind = "no dialog";
  const test::DialogCloser closer([&](QDialog&) { behind = said(); });
  window_->openFile(QString::fromStdString(odd.string()));
  EXPECT_EQ(behind, "");
  EXPECT_EQ(said(), "");
}

TEST_F(Progress, OfAnExportTellsStepsAndPercent)
{
  press(100);
  QTest::qWait(3000); // samples
  release();
  EXPECT_TRUE(waitForLift());
  const auto out = folder_.path() / "out";
  const Told told = whileDone([&] { window_->exportData(QString::fromStdString(out.string())); });
  EXPECT_TRUE(std::filesystem::exists(out / "samples.csv"));
  EXPECT_FALSE(told.percents.empty());
  EXPECT_TRUE(
    std::ranges::any_of(told.texts, [](const QString& text) { return text.contains("writing"); }));
}

TEST_F(Progress, OfAMovieCountsItsPicturesAndIsCanceled)
{
  press(80);
  release();
  EXPECT_TRUE(waitForLift());
  const auto file = folder_.path() / "press.mp4";
  constexpr int kMoving = 2; // percents
  const Told told = whileDone(
    [&] { window_->saveReplay(QString::fromStdString(file.string())); }, "pictures", kMoving);
  EXPECT_TRUE(said().contains("canceled")) << said().toStdString();
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_TRUE(QTest::qWaitFor([] { return processesWith("--movie") == 0; }, 3000));
}

TEST_F(Progress, TheWindowGoesOnWhileFiguresAndCurvesAreDrawn)
{
  press(80);
  const auto fileOf = [&](const char* name)
  { return QString::fromStdString((folder_.path() / name).string()); };
  constexpr ImageSize kLarge{ .width = 3840, .height = 2160 };
  constexpr int kMany = 5; // a window that waits has none
  EXPECT_GT(turnsWhile("--figure",
              [&] { EXPECT_TRUE(window_->saveFigure(fileOf("figure.png"), kLarge, {})); }),
    kMany);
  EXPECT_GT(
    turnsWhile("--charts", [&] { EXPECT_TRUE(window_->saveChart(0, fileOf("c.png"), kLarge)); }),
    kMany);
  release();
  for (const char* name : { "figure.png", "c.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / name)) << name;
  }
}

// each is asked for while the first is drawn
TEST_F(Progress, WhatIsSavedMeanwhileIsSavedAfterwards)
{
  press(60);
  release();
  waitForPresses(1);
  const auto file = [this](const char* name) { return folder_.path() / name; };
  const auto named = [&](const char* name) { return QString::fromStdString(file(name).string()); };
  QTimer::singleShot(100,
    [&]
    {
      EXPECT_TRUE(window_->saveChart(1, named("curve.png"), { 400, 300 }));
      EXPECT_TRUE(window_->saveScreenshot(named("shot.png")));
      EXPECT_TRUE(window_->exportData(named("export")));
      EXPECT_FALSE(std::filesystem::exists(file("figure.png"))) << "drawn before all was asked for";
    });
  EXPECT_TRUE(window_->saveFigure(named("figure.png"), { 1280, 720 }, { .isRealistic = true }));
  const auto isAll = [&] { return std::filesystem::exists(file("export") / "scene.json"); };
  EXPECT_TRUE(QTest::qWaitFor(isAll, 4 * kPatience));
  for (const char* name : { "figure.png", "curve.png", "shot.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
  }
}

TEST_F(Progress, OfAFigureIsCanceledAndLeavesNoFile)
{
  press(80);
  const auto file = folder_.path() / "figure.png";
  const Told told = whileDone(
    [&]
    {
      window_->saveFigure(QString::fromStdString(file.string()), { .width = 3840, .height = 2160 },
        { .isRealistic = true });
    },
    "drawing");
  release();
  EXPECT_FALSE(told.texts.empty());
  EXPECT_TRUE(said().contains("canceled")) << said().toStdString();
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_TRUE(QTest::qWaitFor([] { return processesWith("--figure") == 0; }, 3000));
}

// a window that is closed while a file is written
class Quitting : public Progress
{
protected:
  Quitting()
  {
    press(80);
    release();
    waitForPresses(1);
  }

  // closes once an export goes on, and answers; returns what was asked
  QString quitDuringExport(const QString& answer)
  {
    QString asked;
    QTimer hand;
    QObject::connect(&hand, &QTimer::timeout,
      [&]
      {
        auto* box = window_->findChild<QMessageBox*>("quitQuestion");
        if (box == nullptr)
        {
          said().startsWith("Exporting") ? void(window_->close()) : void();
          return;
        }
        hand.stop();
        asked = box->text();
        EXPECT_TRUE(window_->isVisible());
        EXPECT_EQ(box->defaultButton()->text(), "&Wait, then quit");
        for (auto* button : box->buttons())
        {
          button->text().remove('&') == answer ? button->click() : void();
        }
      });
    hand.start(10);
    window_->exportData(QString::fromStdString(out_.string()));
    return asked;
  }

  [[nodiscard]] bool isClosed() const
  {
    return QTest::qWaitFor([this] { return !window_->isVisible(); }, kPatience);
  }

  std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(Quitting, WaitsForAnExport)
{
  const QString asked = quitDuringExport("Wait, then quit");
  EXPECT_TRUE(asked.startsWith("A file is still being written")) << asked.toStdString();
  EXPECT_TRUE(isClosed());
  EXPECT_TRUE(std::filesystem::exists(out_ / "scene.json"));
}

TEST_F(Quitting, GivesAnExportUpWhereThatIsAsked)
{
  quitDuringExport("Quit without it");
  EXPECT_TRUE(isClosed());
  EXPECT_FALSE(std::filesystem::exists(out_ / "scene.json"));
}

TEST_F(Quitting, StaysWhereItIsCanceledOrTheExportFails)
{
  quitDuringExport("Cancel");
  EXPECT_TRUE(std::filesystem::exists(out_ / "scene.json"));
  out_ = "/proc/nowhere";
  quitDuringExport("Wait, then quit");
  waitForFrames(); // in which it would close
  EXPECT_TRUE(window_->isVisible());
  EXPECT_TRUE(said().contains("/proc/nowhere")) << said().toStdString();
}

} // namespace
} // namespace palp
