#include "tests/app/window/check_rig.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;

class CheckRepair : public CheckTest
{
};

TEST_F(CheckRepair, RepairsAsTheCommandLineAndOpensThat)
{
  openBroken({});
  for (const char* kind : { ".vtp", ".stl" })
  {
    const std::filesystem::path mine = path("mine").replace_extension(kind);
    const std::filesystem::path other = path("other").replace_extension(kind);
    const test::Finished printed =
      command(path("block.obj"), "--unit mm --close-holes 30mm --repair " + other.string());
    EXPECT_EQ(printed.code, 0) << printed.out << printed.err;
    repair(mine, "30");
    EXPECT_TRUE(suggested_.ends_with("/block_repaired.vtp")) << suggested_;
    ASSERT_TRUE(QTest::qWaitFor([this] { return choice("Open it") != nullptr; }, kPatience))
      << said().toStdString();
    EXPECT_EQ(test::readAll(mine), test::readAll(other));
    const std::string from = "# repaired: ";
    const std::size_t begin = printed.out.find(from) + from.size();
    const std::string done = printed.out.substr(begin, printed.out.find('\n', begin) - begin);
    EXPECT_NE(done.find("1 hole closed"), std::string::npos);
    EXPECT_TRUE(said().contains(QString::fromStdString(done))) << said().toStdString();
    EXPECT_TRUE(said().contains("nothing disturbs a press")) << said().toStdString();
  }
  waitForFrames(); // the answers of before go
  choice("Open it")->click();
  ASSERT_EQ(session_->body().name, "mine.stl") << said().toStdString();
  EXPECT_EQ(session_->body().unit, "mm");
  check();
  EXPECT_EQ(verdict().find("disturbed"), std::string::npos) << verdict();
}

TEST_F(CheckRepair, NeverReplacesWhatItChecked)
{
  openBroken({});
  const std::string before = test::readAll(path("block.obj"));
  bool isRefused = false;
  QTimer::singleShot(100, window_.get(),
    [&]
    {
      auto* box = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      isRefused = box != nullptr && box->objectName() != "repairDialog";
      isRefused ? box->accept() : void();
      window_->findChild<QFileDialog*>("repairDialog")->reject();
    });
  repair(path("block.obj"), "0");
  EXPECT_TRUE(isRefused);
  EXPECT_EQ(test::readAll(path("block.obj")), before);
}

TEST_F(CheckRepair, ACanceledRepairLeavesNoFile)
{
  write(path("fine.obj"), makeBox({ 64e-3, 64e-3, 20e-3 }, 0.4e-3));
  ASSERT_TRUE(open("fine.obj")) << said().toStdString();
  check();
  dock()->findChild<QPushButton*>("repairSurface")->setEnabled(true); // of what has no fault
  QTimer cancel;
  bool isCanceled = false;
  QObject::connect(&cancel, &QTimer::timeout,
    [&]
    {
      if (said().startsWith("Repairing") && choice("Cancel") != nullptr)
      {
        isCanceled = true;
        choice("Cancel")->click();
      }
    });
  cancel.start(5);
  repair(path("fine.vtp"), "0");
  EXPECT_TRUE(isCanceled);
  EXPECT_TRUE(said().contains("canceled")) << said().toStdString();
  window_.reset(); // which waits for what was given up
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

} // namespace
} // namespace palp
