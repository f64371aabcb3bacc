#include "app/panels/folder_dialog.h"
#include "tests/app/application.h"
#include "tests/support/process.h"

#include <QDir>
#include <QLineEdit>
#include <QTest>

#include <filesystem>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

// what is typed and taken with the return key
QString answer(const QString& in, const QString& typed)
{
  FolderDialog dialog("Export data into", "palp_export");
  dialog.setDirectory(in);
  dialog.show();
  EXPECT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  auto* line = dialog.findChild<QLineEdit*>();
  EXPECT_EQ(line->text(), "palp_export");
  line->selectAll();
  QTest::keyClicks(line, typed);
  QTest::keyClick(line, Qt::Key_Return);
  EXPECT_EQ(dialog.result(), QDialog::Accepted) << typed.toStdString();
  return dialog.folder();
}

// a folder of that name was left alone, and the one above it taken
TEST(FolderDialog, GivesTheFolderThatWasTyped)
{
  test::application();
  const test::TemporaryFolder folder;
  const QString in = QString::fromStdString(folder.path().string());
  std::filesystem::create_directory(folder.path() / "old");
  EXPECT_EQ(answer(in, "old"), in + "/old");
  EXPECT_EQ(answer(in, in + "/old"), in + "/old");
  EXPECT_EQ(answer(in, "new one"), in + "/new one");
  EXPECT_EQ(answer(in, in + "/old/new/"), in + "/old/new");
  EXPECT_EQ(answer(in, "."), in);
  EXPECT_EQ(answer(in, ".."), QString::fromStdString(folder.path().parent_path().string()));
  EXPECT_EQ(answer(in, "~/new"), QDir::homePath() + "/new");
}

} // namespace
} // namespace palp
