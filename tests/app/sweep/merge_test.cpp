#include "app/sweep/case_folders.h"
#include "app/sweep/cases/merge.h"
#include "app/sweep/cases/status.h"
#include "app/sweep/plan.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "tests/app/sweep/simulated_result.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <sstream>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLTableReader.h>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

// a planned sweep with results that nobody computed
class SimulatedSweep : public testing::Test
{
protected:
  Manifest planned(std::size_t young, std::size_t tools) const
  {
    Sweep sweep{ .title = "simulated", .kind = "force", .fixed = { { "depth", "0:1:1mm" } } };
    sweep.axes.push_back({ { "young" }, {} });
    sweep.axes.push_back({ { "tip" }, {} });
    for (std::size_t i = 0; i < young; ++i)
    {
      sweep.axes[0].rows.push_back({ std::to_string(i + 1) + "kPa" });
    }
    for (std::size_t i = 0; i < tools; ++i)
    {
      sweep.axes[1].rows.push_back({ "sphere:" + std::to_string(i + 1) + "mm" });
    }
    planSweep(
      sweep, "/", { { "young", "tip", "depth" }, {} }, [](const auto&) {}, folder_.path());
    return Manifest(folder_.path());
  }

  // as a runner would leave it
  void finish(const PlannedCase& one, const std::string& table) const
  {
    test::leaveResult(folder_.path(), one.name, table);
  }

  [[nodiscard]] std::string merged(
    Manifest& manifest, const std::string& name, MergeOptions options = {}) const
  {
    options.overwrite = true;
    mergeResults(manifest, options, folder_.path() / name);
    return test::readAll(folder_.path() / name);
  }

  test::TemporaryFolder folder_;
};

TEST_F(SimulatedSweep, MergesInTheOrderOfTheCasesWhateverTheirFolders)
{
  Manifest manifest = planned(3, 2);
  manifest.forEach([&](const PlannedCase& one)
    { finish(one, "# said\ndepth_mm,force_N\n0,0\n1," + std::to_string(one.number) + "\n"); });
  EXPECT_EQ(merged(manifest, "all.csv", { .largest = "force_N" }),
    "young_kPa,tip,depth_mm,force_N\n1,sphere:1mm,0,0\n1,sphere:2mm,1,1\n2,sphere:1mm,1,2\n"
    "2,sphere:2mm,1,3\n3,sphere:1mm,1,4\n3,sphere:2mm,1,5\n");
}

TEST_F(SimulatedSweep, ColumnsOfSomeCasesAreEmptyInTheOthers)
{
  Manifest manifest = planned(1, 3);
  const std::array<std::string, 3> tables{ "a,b\n1,2\n", "a,c\n3,\"say \"\"x\"\", y\"\n",
    "b,a\n4,5\n" };
  manifest.forEach([&](const PlannedCase& one) { finish(one, tables.at(one.number)); });
  EXPECT_EQ(merged(manifest, "all.csv"),
    "young_kPa,tip,a,b,c\n1,sphere:1mm,1,2,\n1,sphere:2mm,3,,\"say \"\"x\"\", y\"\n"
    "1,sphere:3mm,5,4,\n");
}

TEST_F(SimulatedSweep, TellsAResultFromAVariedValueOfTheSameName)
{
  Manifest manifest = planned(1, 1);
  finish(manifest.at(0), "young_kPa,result,tip\n7,8,sphere\n");
  EXPECT_EQ(merged(manifest, "all.csv"),
    "young_kPa,tip,result_young_kPa,result,result_tip\n1,sphere:1mm,7,8,sphere\n");
}

// what VTK itself reads of it
TEST_F(SimulatedSweep, TheTableOfVtkIsTheCsv)
{
  Manifest manifest = planned(40, 2);
  manifest.forEach(
    [&](const PlannedCase& one)
    {
      const std::string number = shortest(0.1 * static_cast<double>(one.number) + 1e-9);
      finish(one, one.number == 7 ? "force_N,word\n,<no & \n" : "force_N,word\n" + number + ",w\n");
    });
  (void)merged(manifest, "all.vtt");
  std::istringstream csv(merged(manifest, "all.csv"));
  vtkNew<vtkXMLTableReader> reader;
  reader->SetFileName((folder_.path() / "all.vtt").c_str());
  reader->Update();
  vtkTable* table = reader->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 80);
  const auto* young = vtkDoubleArray::SafeDownCast(table->GetColumnByName("young_kPa"));
  const auto* force = vtkDoubleArray::SafeDownCast(table->GetColumnByName("force_N"));
  auto* tip = vtkStringArray::SafeDownCast(table->GetColumnByName("tip"));
  auto* word = vtkStringArray::SafeDownCast(table->GetColumnByName("word"));
  ASSERT_TRUE(young && force && tip && word);
  std::string line;
  std::getline(csv, line);
  for (vtkIdType i = 0; std::getline(csv, line); ++i)
  {
    const auto cells = csvFields(line);
    EXPECT_EQ(shortest(young->GetValue(i)), cells[0]);
    EXPECT_EQ(tip->GetValue(i), cells[1]);
    EXPECT_EQ(std::isnan(force->GetValue(i)) ? "" : shortest(force->GetValue(i)), cells[2]);
    EXPECT_EQ(word->GetValue(i), cells[3]);
  }
}

TEST_F(SimulatedSweep, RefusesWhatIsMissingOrDamaged)
{
  Manifest manifest = planned(2, 1);
  finish(manifest.at(0), "a\n1\n");
  EXPECT_THROW((void)merged(manifest, "all.csv"), Error);
  EXPECT_EQ(merged(manifest, "all.csv", { .partial = true }), "young_kPa,tip,a\n1,sphere:1mm,1\n");
  finish(manifest.at(1), "a\n1,2\n");
  EXPECT_THROW((void)merged(manifest, "all.csv"), Error);
  finish(manifest.at(1), "");
  EXPECT_THROW((void)merged(manifest, "all.csv"), Error);
  finish(manifest.at(1), "a\n2\n");
  EXPECT_THROW((void)merged(manifest, "all.txt"), Error);
  EXPECT_THROW((void)merged(manifest, "all.csv", { .largest = "b" }), Error);
}

// a copy of another case's folder
TEST_F(SimulatedSweep, MergesNoResultOfAnotherCase)
{
  Manifest manifest = planned(2, 1);
  const CaseFolders folders{ folder_.path() };
  manifest.forEach([&](const PlannedCase& one) { finish(one, "a\n1\n"); });
  EXPECT_NO_THROW((void)merged(manifest, "all.csv"));
  fs::copy(folders.result(manifest.at(0).name), folders.result(manifest.at(1).name),
    fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  EXPECT_THROW((void)merged(manifest, "all.csv"), Error);
}

// by a disk, or by a hand: a digit, a row, all of it, or the record
TEST_F(SimulatedSweep, MergesNoResultThatIsNotWhatItsCaseLeft)
{
  Manifest manifest = planned(1, 1);
  const PlannedCase one = manifest.at(0);
  const fs::path place = CaseFolders{ folder_.path() }.result(one.name);
  for (const char* table : { "a\n1\n3\n", "a\n1\n", "", "gone", "a\n1\n2" })
  {
    finish(one, "a\n1\n2\n");
    EXPECT_NO_THROW((void)merged(manifest, "all.csv"));
    std::ofstream(place / "force.csv") << table;
    if (std::string(table) == "gone")
    {
      fs::remove(place / "force.csv");
    }
    EXPECT_THROW((void)merged(manifest, "all.csv"), Error) << table;
  }
  for (const char* record : { "", "[]", "{}", R"({"table_sha256": 3})" })
  {
    finish(one, "a\n1\n2\n");
    std::ofstream(place / kCaseFile) << record;
    EXPECT_THROW((void)merged(manifest, "all.csv"), Error) << record;
  }
}

TEST_F(SimulatedSweep, OfManyCasesKeepsFoldersSmallAndFindsEach)
{
  const std::size_t young = 100;
  Manifest manifest = planned(young, 10);
  const std::size_t count = 10 * young;
  for (const std::size_t number : { std::size_t{ 0 }, std::size_t{ 1 }, count / 3, count - 1 })
  {
    const PlannedCase one = manifest.at(number);
    EXPECT_EQ(one.number, number);
    EXPECT_EQ(one.values[0], std::to_string(number / 10 + 1) + "kPa");
  }
  EXPECT_THROW((void)manifest.at(count), Error);
  manifest.forEach(
    [&](const PlannedCase& one) { finish(one, "force_N\n" + std::to_string(one.number) + "\n"); });
  const SweepStatus status = statusOf(manifest);
  EXPECT_EQ(status.done, count);
  EXPECT_EQ(status.secondsEach, 2.0);
  const std::string text = merged(manifest, "all.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<std::ptrdiff_t>(count) + 1);
  std::ptrdiff_t largest = 0;
  for (const auto& part : fs::directory_iterator(folder_.path() / "results"))
  {
    largest = std::max(largest, std::distance(fs::directory_iterator(part), {}));
  }
  // of a hash 4096 parts get as many each, within seven standard deviations
  const double each = static_cast<double>(count) / 4096.0;
  EXPECT_LT(static_cast<double>(largest), each + 7.0 * std::sqrt(each) + 4.0);
}

} // namespace
} // namespace palp
