#include "tests/app/dialog_closer.h"
#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QComboBox>

#include <filesystem>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::WindowTest;

// made when it is asked for; what it saves is what the press shows
TEST_F(WindowTest, SavesAMovieOfThePress)
{
  press(80);
  release();
  waitForPresses(1);
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1); // which ends the recording
  ASSERT_TRUE(window_->saveReplay(QString::fromStdString((folder_.path() / "press.mp4").string())));
  const auto file = std::filesystem::directory_iterator(folder_.path())->path();
  EXPECT_EQ(file.stem(), "press");
  EXPECT_GT(std::filesystem::file_size(file), 10'000U);
}

// with nothing pressed there is no question; a press of before the last change counts
TEST_F(WindowTest, AMovieIsOfAPressThatWasMade)
{
  const test::DialogCloser closer;
  for (const char* name : { "movieAction", "turntableAction" })
  {
    window_->findChild<QAction*>(name)->trigger();
    EXPECT_EQ(closer.count(), 0) << name;
    EXPECT_TRUE(said().contains("press first")) << said().toStdString();
  }
  press(60);
  release();
  waitForPresses(1);
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  ASSERT_FALSE(session_->recording().isTouched());
  window_->findChild<QAction*>("movieAction")->trigger();
  EXPECT_GT(closer.count(), 0) << said().toStdString();
}

} // namespace
} // namespace palp
