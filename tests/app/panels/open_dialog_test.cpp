#include "app/panels/open_dialog.h"

#include "haptics/error.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/app/application.h"
#include "tests/app/panels/label_map.h"
#include "tests/support/label_images.h"
#include "tests/support/process.h"

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>

#include <fstream>
#include <gtest/gtest.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// of an image with the labels 2 and 7
struct Opened
{
  // lists them
  QListWidget* list()
  {
    dialog.setLabels(readFileOrgans(file, {}, true));
    return dialog.findChild<QListWidget*>("labels");
  }

  QApplication& application = test::application();
  test::TemporaryFolder folder{};
  std::filesystem::path file = test::writeLabelMap(folder.path() / "a.mha");
  OpenDialog dialog{ QString::fromStdString(file.string()) };
};

TEST(OpenDialog, ListsTheLabelsOfAnImageToBeTicked)
{
  Opened opened;
  OpenDialog& dialog = opened.dialog;
  const QListWidget* list = opened.list();
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

// as 3D Slicer writes it; a label that it does not name stays as it is
// as palp import takes all of them
TEST(OpenDialog, TakesAllLabels)
{
  Opened opened;
  OpenDialog& dialog = opened.dialog;
  const QListWidget* list = opened.list();
  auto* label = dialog.findChild<QLineEdit*>("label");
  auto* all = dialog.findChild<QPushButton*>("allLabels");
  list->item(1)->setCheckState(Qt::Checked);
  all->click();
  EXPECT_EQ(label->text(), "2,7");
  EXPECT_EQ(list->item(0)->checkState(), Qt::Checked);
  all->click();
  EXPECT_EQ(label->text(), "");
  EXPECT_EQ(list->item(1)->checkState(), Qt::Unchecked);
  label->setText("all");
  EXPECT_EQ(dialog.source().part.labels, (std::vector<std::string>{ "2", "7" }));
  EXPECT_EQ(dialog.organs().size(), 2U);
}

// which have no surface, and would keep the others from being opened
TEST(OpenDialog, LeavesLabelsOfFewVoxelsOutOfAll)
{
  Opened opened;
  OpenDialog& dialog = opened.dialog;
  FileOrgans found = readFileOrgans(opened.file, {}, true);
  found.organs[0].voxels = 7;
  dialog.setLabels(std::move(found));
  auto* label = dialog.findChild<QLineEdit*>("label");
  auto* all = dialog.findChild<QPushButton*>("allLabels");
  all->click();
  EXPECT_EQ(label->text(), "7");
  all->click();
  EXPECT_EQ(label->text(), "");
  label->setText("all");
  EXPECT_EQ(dialog.source().part.labels, std::vector<std::string>{ "7" });
}

TEST(OpenDialog, CallsLabelsAsATableDoes)
{
  Opened opened;
  OpenDialog& dialog = opened.dialog;
  const QListWidget* list = opened.list();
  list->item(1)->setCheckState(Qt::Checked);
  const std::filesystem::path table = opened.folder.path() / "names.ctbl";
  std::ofstream(table) << "7 spleen 10 32 255 255\n9 stomach 1 2 3 255\n";
  dialog.setNames(table);
  EXPECT_TRUE(list->item(1)->text().startsWith("7  spleen  16 voxels"))
    << list->item(1)->text().toStdString();
  EXPECT_TRUE(list->item(0)->text().startsWith("2    ")) << list->item(0)->text().toStdString();
  EXPECT_EQ(dialog.findChild<QLineEdit*>("label")->text(), "7");
  list->item(0)->setCheckState(Qt::Checked);
  const std::vector<FileOrgan> organs = dialog.organs();
  ASSERT_EQ(organs.size(), 2U);
  EXPECT_EQ(organs[1].name, "spleen");
  EXPECT_EQ(organs[1].color, "#0a20ff");
  const std::filesystem::path cut = opened.folder.path() / "cut.json";
  std::ofstream(cut) << "{\"7\": ";
  EXPECT_THROW(dialog.setNames(cut), Error);
  EXPECT_TRUE(list->item(1)->text().startsWith("7  spleen"));
}

TEST(OpenDialog, TakesWhatHasValuesInARange)
{
  Opened opened;
  OpenDialog& dialog = opened.dialog;
  auto* values = dialog.findChild<QLineEdit*>("values");
  const auto why = [&] { return dialog.findChild<QLabel*>("why")->text().toStdString(); };
  const auto isTaken = [&](const char* text)
  {
    values->setText(text);
    dialog.setResult(QDialog::Rejected);
    dialog.accept();
    return dialog.result() == QDialog::Accepted;
  };
  EXPECT_FALSE(isTaken("9:1"));
  EXPECT_NE(why().find("'9:1' is empty"), std::string::npos) << why();
  EXPECT_TRUE(isTaken(" 1.5:9 "));
  EXPECT_EQ(dialog.source().part.band, (std::array{ 1.5, 9.0 }));
  EXPECT_NEAR(readFileSurface(opened.file, dialog.source().part).field, 60.0, 1e-9);
  dialog.findChild<QLineEdit*>("level")->setText("2");
  EXPECT_FALSE(isTaken("1.5:9"));
  EXPECT_NE(why().find("more than one is given"), std::string::npos) << why();
}

// as 3D Slicer numbers the segments of each layer anew
TEST(OpenDialog, AsksByNameForLabelsOfOneValue)
{
  test::application();
  const test::TemporaryFolder folder;
  const auto file = test::writeLayers(folder.path() / "a.seg.nrrd", 1,
    "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment1_Name:=vein\nSegment1_LabelValue:=2\nSegment1_Layer:=0\n"
    "Segment2_Name:=tumor, left\nSegment2_LabelValue:=1\nSegment2_Layer:=1\n",
    [](int i) {
      return std::string{ i < 32 ? '\1' : '\2', i % 4 < 2 ? '\1' : '\0' };
    });
  OpenDialog dialog(QString::fromStdString(file.string()));
  dialog.setLabels(readFileOrgans(file, {}, true));
  auto* list = dialog.findChild<QListWidget*>("labels");
  ASSERT_EQ(list->count(), 3);
  for (int i = 0; i < 3; ++i)
  {
    list->item(i)->setCheckState(Qt::Checked);
  }
  EXPECT_EQ(dialog.findChild<QLineEdit*>("label")->text(), "liver,2,\"tumor, left\"");
  const std::vector<FileOrgan> organs = dialog.organs();
  ASSERT_EQ(organs.size(), 3U);
  EXPECT_EQ(organs[2].name, "tumor, left");
  for (const FileOrgan& organ : organs)
  {
    EXPECT_GT(readSurface(file, {}, { {}, { organ.label } }).mesh->GetNumberOfPoints(), 8);
  }
}

} // namespace
} // namespace palp
