#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/scene/scene_file.h"
#include "tests/app/window/window_rig.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <optional>
#include <vtkCamera.h>

namespace palp
{
namespace
{

using test::WindowTest;

// presses that a program left, and the question about them
class RestoredPresses : public WindowTest
{
protected:
  RestoredPresses()
  {
    std::optional<Autosave> before(folder_.path());
    window_->saveTo(*before);
    press(60);
    release();
    waitForPresses(1);
    before.reset(); // as another program would end
    window_->saveTo(now_.emplace(folder_.path()));
  }

  ~RestoredPresses() override
  {
    session_->saveTo(nullptr);
  }

  std::optional<Autosave> now_;
};

TEST_F(RestoredPresses, AreOfferedAgainWhereDiscardIsUndone)
{
  const auto& presses = session_->presses().presses();
  const double force = presses.front().summary.force;
  answer("Discard");
  EXPECT_TRUE(said().startsWith("Discarded 1 press of before; Undo")) << said().toStdString();
  EXPECT_TRUE(now_->left().empty());
  canvas_->setFocus();
  QTest::keyClick(canvas_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(said().startsWith("Not exported yet: 1 press of before")) << said().toStdString();
  answer("Restore");
  ASSERT_TRUE(QTest::qWaitFor([&] { return presses.size() == 2; }, kPatience));
  EXPECT_EQ(presses.back().summary.force, force);
}

TEST_F(RestoredPresses, AreNotSaidToBeDiscardedWhereAnotherWindowHasThem)
{
  Autosave other(now_->folder().parent_path());
  ASSERT_EQ(other.left().size(), 1U);
  ASSERT_GT(other.adopt(other.left().front()), 0);
  answer("Discard");
  EXPECT_TRUE(said().startsWith("None is left to discard")) << said().toStdString();
  canvas_->setFocus();
  QTest::keyClick(canvas_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(said().startsWith("None is left to discard")) << said().toStdString();
  EXPECT_TRUE(other.has(1));
}

TEST_F(RestoredPresses, AreInTheMenuWhenTheirOfferIsGone)
{
  auto* restore = window_->findChild<QAction*>("restoreAction");
  window_->findChild<MessageBar*>()->tell("something else");
  restore->trigger();
  EXPECT_TRUE(
    QTest::qWaitFor([&] { return session_->presses().presses().size() == 2; }, kPatience));
  restore->trigger();
  EXPECT_TRUE(said().startsWith("None is left to restore")) << said().toStdString();
}

// nobody wants a press twice without a word
TEST_F(RestoredPresses, AreNotLoadedTwiceUnasked)
{
  const auto out = folder_.path() / "out";
  const QString folder = QString::fromStdString(out.string());
  const auto listed = [this] { return session_->presses().presses().size(); };
  ASSERT_TRUE(window_->exportData(folder));
  ASSERT_TRUE(window_->loadPresses(folder));
  ASSERT_EQ(listed(), 2U);
  window_->loadPresses(folder + "/../out/");
  EXPECT_EQ(listed(), 2U);
  EXPECT_TRUE(said().endsWith("is loaded already")) << said().toStdString();
  answer("Load again");
  EXPECT_EQ(listed(), 3U);

  const QString none = QString::fromStdString((folder_.path() / "empty").string());
  std::filesystem::create_directory(folder_.path() / "empty");
  EXPECT_FALSE(window_->loadPresses(none));
  EXPECT_TRUE(said().startsWith(none + ": is no exported folder")) << said().toStdString();
}

// each as its own body was seen, not as the one that is open
TEST_F(WindowTest, AnEarlierBodyIsExportedFromWhereItWasSeen)
{
  press(80);
  release();
  EXPECT_TRUE(waitForLift());
  const Eigen::Vector3d from(
    canvas_->renderWindow()->GetRenderers()->GetFirstRenderer()->GetActiveCamera()->GetPosition());
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  waitForFrames();
  press(80);
  release();
  EXPECT_TRUE(waitForLift());
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  const auto cameraOf = [this](const char* folder)
  { return readExport(folder_.path() / folder).plan.camera.value().position; };
  EXPECT_LT((cameraOf("earlier-1") - from).norm(), 1e-6 * from.norm());
  EXPECT_GT((cameraOf(".") - from).norm(), 0.01 * from.norm());
}

// which says itself that it exports nothing but when asked
class OfAWindowsScene : public WindowTest
{
protected:
  OfAWindowsScene()
    : WindowTest(readScene("liver_mouse"))
  {
  }
};

TEST_F(OfAWindowsScene, PressesAreExportedAndSavedWhole)
{
  Autosave autosave(folder_.path() / "state");
  window_->saveTo(autosave);
  press(60);
  release();
  waitForPresses(1);
  const std::filesystem::path saved = autosave.folderOf(autosave.saved());
  EXPECT_TRUE(QTest::qWaitFor([&] { return exists(saved / "scene.json"); }, kPatience));
  const auto out = folder_.path() / "out";
  for (const auto& folder : { saved, out })
  {
    EXPECT_TRUE(folder == saved || window_->exportData(QString::fromStdString(out.string())));
    const auto again = folder_.path() / "again" / folder.filename();
    const test::Finished run =
      test::runCommand(PALP_PROGRAM " run " + folder.string() + " --out " + again.string());
    EXPECT_EQ(run.code, 0) << run.err;
    for (const char* file : { "samples.csv", "presses.csv", "deformed.vtp" })
    {
      EXPECT_TRUE(exists(again / file)) << file;
      EXPECT_TRUE(folder == saved || exists(out / file)) << file;
    }
  }
  session_->saveTo(nullptr);
}

TEST_F(WindowTest, ADeletedPressIsInNoExportAndTheOthersKeepTheirNames)
{
  for (std::size_t i = 1; i <= 3; ++i)
  {
    press(40 + 10 * static_cast<int>(i));
    release();
    waitForPresses(i);
  }
  session_->presses().remove(2);
  const auto out = folder_.path() / "out";
  ASSERT_TRUE(window_->exportData(QString::fromStdString(out.string())));
  const std::string table = test::readAll(out / "presses.csv");
  EXPECT_NE(table.find("\n\"press 1\""), table.npos) << table;
  EXPECT_EQ(table.find("\n\"press 2\""), table.npos) << table;
  EXPECT_NE(table.find("\n\"press 3\""), table.npos) << table;
  ASSERT_TRUE(window_->loadPresses(QString::fromStdString(out.string())));
  EXPECT_EQ(session_->presses().presses().size(), 4U) << "two of their own, two loaded";
}

// of a surface that is gone, which an export of others must not forget
class LostBody : public WindowTest
{
protected:
  ~LostBody() override
  {
    session_->saveTo(nullptr);
  }

  const std::filesystem::path state_ = folder_.path() / "state";
};

TEST_F(LostBody, ItsPressesAreKeptUntilItIsBack)
{
  const auto body = folder_.path() / "bx.vtp";
  std::filesystem::copy_file(PALP_SHARE "/meshes/block_50.vtp", body);
  std::optional<Autosave> before(state_);
  window_->saveTo(*before);
  ASSERT_TRUE(window_->openFile(QString::fromStdString(body.string())));
  waitForFrames();
  press(60);
  release();
  waitForPresses(1);
  std::optional<Autosave> now(state_);
  window_->saveTo(*now);
  before.reset(); // as another program would end
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  waitForFrames();
  press(60);
  release();
  waitForPresses(2);
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/liver.vtp")); // so that it is read anew
  std::filesystem::rename(body, body.string() + ".away");
  window_->saveTo(*now);
  answer("Restore");
  EXPECT_TRUE(said().startsWith("A press of before is kept, but not restored: "))
    << said().toStdString();
  EXPECT_FALSE(std::filesystem::exists(body));
  now->clear(); // as an export does
  session_->saveTo(nullptr);
  EXPECT_EQ(Autosave(state_).left().size(), 1U);
}

TEST_F(LostBody, AWindowAsksBeforeItLosesWhatIsKeptNowhere)
{
  Autosave nowhere("/proc/none");
  window_->saveTo(nowhere);
  EXPECT_TRUE(said().startsWith("Presses are not kept on the disk: export them"))
    << said().toStdString();
  press(60);
  release();
  waitForPresses(1);
  EXPECT_FALSE(window_->close());
  EXPECT_EQ(said(), "Neither exported nor kept on the disk: 1 press");
  ASSERT_TRUE(window_->exportData(QString::fromStdString((folder_.path() / "out").string())));
  EXPECT_TRUE(window_->close());
}

TEST_F(LostBody, AWindowClosesWhereAllIsKept)
{
  Autosave somewhere(state_);
  window_->saveTo(somewhere);
  press(60);
  release();
  waitForPresses(1);
  EXPECT_TRUE(window_->close());
}

} // namespace
} // namespace palp
