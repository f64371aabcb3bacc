#include "app/panels/open_dialog.h"

#include "pipeline/surface_io/surface_io.h"
#include "tests/app/application.h"
#include "tests/app/panels/label_map.h"
#include "tests/support/process.h"

#include <QCheckBox>
#include <QLineEdit>
#include <QListWidget>

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(OpenDialog, ListsTheLabelsOfAnImageToBeTicked)
{
  test::application();
  const test::TemporaryFolder folder;
  const std::filesystem::path file = test::writeLabelMap(folder.path() / "a.mha");
  OpenDialog dialog(QString::fromStdString(file.string()));
  dialog.setLabels(readFileOrgans(file, {}, true));
  auto* list = dialog.findChild<QListWidget*>("labels");
  ASSERT_NE(list, nullptr);
  ASSERT_EQ(list->count(), 2);
  EXPECT_TRUE(list->item(0)->text().contains("32 ml")) << list->item(0)->text().toStdString();
  list->item(0)->setCheckState(Qt::Checked);
  list->item(1)->setCheckState(Qt::Checked);
  EXPECT_EQ(dialog.findChild<QLineEdit*>("label")->text(), "2,7");
  EXPECT_TRUE(list->item(1)->text().contains("16 voxels")) << list->item(1)->text().toStdString();
  const std::vector<FileOrgan> organs = dialog.organs();
  ASSERT_EQ(organs.size(), 2U);
  EXPECT_EQ(organs[1].label, "7");
  dialog.findChild<QCheckBox*>("areOrgans")->setChecked(false);
  EXPECT_TRUE(dialog.organs().empty()) << "one body of both";
  list->item(0)->setCheckState(Qt::Unchecked);
  EXPECT_EQ(dialog.source().part.labels, std::vector<std::string>{ "7" });
}

} // namespace
} // namespace palp
