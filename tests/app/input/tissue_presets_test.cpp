#include "app/input/tissue_presets.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

using namespace units::literals;
using test::Finished;

std::vector<TissuePreset> shipped()
{
  setenv("PALP_DATA", PALP_SHARE, 1); // NOLINT(concurrency-mt-unsafe): before any thread
  return shippedTissues();
}

Finished runPalp(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " " + arguments);
}

double forceOf(const std::string& options)
{
  const Finished finished = runPalp("force --depth 4:4:1mm " + options);
  EXPECT_EQ(finished.code, 0) << finished.err;
  std::istringstream in(finished.out);
  return test::parseCsv(in)["force_N"].at(0);
}

TEST(TissuePresets, EachHasANameARangeAndASource)
{
  std::set<std::string> names;
  std::set<std::pair<double, double>> materials; // by which the window knows them
  for (const TissuePreset& tissue : shipped())
  {
    EXPECT_TRUE(names.insert(tissue.name).second) << tissue.name;
    EXPECT_TRUE(
      materials.insert({ tissue.material.youngModulus, tissue.material.poissonRatio }).second)
      << tissue.name;
    EXPECT_EQ(
      tissue.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
      << tissue.name;
    EXPECT_GT(tissue.material.youngModulus, 1.0_kPa) << tissue.name; // softer would be Pa for kPa
    EXPECT_LT(tissue.material.youngModulus, 100.0_kPa) << tissue.name;
    EXPECT_LE(tissue.low.value_or(1.0_kPa), tissue.material.youngModulus) << tissue.name;
    EXPECT_GE(tissue.high.value_or(100.0_kPa), tissue.material.youngModulus) << tissue.name;
    EXPECT_TRUE(tissue.low || tissue.spread == "made to this value") << tissue.name;
    EXPECT_NE(tissue.source.find("20"), std::string::npos) << "no year: " << tissue.name;
    EXPECT_FALSE(tissue.title.empty() || tissue.method.empty()) << tissue.name;
  }
  EXPECT_GE(names.size(), 12U);
}

// typed from the publications: mean and standard deviation of E, or thresholds of the shear modulus
TEST(TissuePresets, NumbersAreThoseOfThePublications)
{
  struct Published
  {
    const char* name;
    double mean;      // [kPa]
    double deviation; // [kPa]
  };
  const std::vector<TissuePreset> tissues = shipped();
  for (const Published& one :
    { Published{ "healthy_liver", 6.63, 1.65 }, { "fibrosis_f0", 6.27, 0.66 },
      { "hcc", 51.45, 14.96 }, { "metastasis", 49.89, 13.82 }, { "hemangioma", 13.8, 5.5 },
      { "cholangiocarcinoma", 56.9, 25.6 }, { "nodular_hyperplasia", 33.0, 14.7 },
      { "adenoma", 9.4, 4.3 }, { "fat", 3.25, 0.91 }, { "skin", 56.3, 16.4 } })
  {
    const TissuePreset& tissue = tissueNamed(one.name, tissues, "test");
    EXPECT_NEAR(tissue.material.youngModulus, 1e3 * one.mean, 1e-6) << one.name;
    EXPECT_NEAR(tissue.low.value(), 1e3 * (one.mean - one.deviation), 1e-6) << one.name;
    EXPECT_NEAR(tissue.high.value(), 1e3 * (one.mean + one.deviation), 1e-6) << one.name;
  }
  const double thresholds[]{ 3.45, 3.66, 4.11, 4.71 }; // of F1 to F4, shear
  for (int stage = 1; stage <= 4; ++stage)
  {
    const TissuePreset& tissue = tissueNamed("fibrosis_f" + std::to_string(stage), tissues, "test");
    EXPECT_NEAR(tissue.material.youngModulus, 3e3 * thresholds[stage - 1], 1e-6) << stage;
    EXPECT_EQ(tissue.high.has_value(), stage < 4);
    EXPECT_NEAR(tissue.high.value_or(3e3 * 4.71), 3e3 * thresholds[std::min(stage, 3)], 1e-6);
  }
  EXPECT_EQ(tissueNamed("cirrhosis", tissues, "test").material.youngModulus, 12.5_kPa);
  EXPECT_EQ(tissueNamed("soft_phantom", tissues, "test").material.youngModulus, 21.0_kPa);
  EXPECT_EQ(tissueNamed("firm_phantom", tissues, "test").material.youngModulus, 82.0_kPa);
}

TEST(TissuePresets, AreTakenByNameAndGivenValuesWin)
{
  EXPECT_EQ(forceOf("--tissue hcc"), forceOf("--young 51.45kPa --poisson 0.49"));
  for (const char* both : { "--tissue hcc --young 5kPa", "--young 5kPa --tissue hcc" })
  {
    EXPECT_EQ(forceOf(both), forceOf("--young 5kPa --poisson 0.49")) << both;
  }
  EXPECT_EQ(forceOf("--poisson 0.3 --tissue hcc"), forceOf("--young 51.45kPa --poisson 0.3"));
}

TEST(TissuePresets, AnUnknownNameIsToldTheNearest)
{
  const Finished wrong = runPalp("force --tissue hemangoma");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.out, "");
  EXPECT_TRUE(wrong.err.starts_with(
    "palp: --tissue: 'hemangoma' is not known; the nearest are hemangioma, adenoma, "))
    << wrong.err;
  EXPECT_EQ(test::sentences(wrong).size(), 1U) << wrong.err;
}

TEST(TissuePresets, TheCommandPrintsAllOfThemWithTheirSources)
{
  const Finished finished = runPalp("tissues");
  ASSERT_EQ(finished.code, 0) << finished.err;
  for (const TissuePreset& tissue : shipped())
  {
    EXPECT_NE(finished.out.find('\n' + tissue.name + ','), std::string::npos) << tissue.name;
    EXPECT_NE(finished.out.find(tissue.source), std::string::npos) << tissue.name;
  }
  EXPECT_NE(finished.out.find("50 kPa where no tissue is named"), std::string::npos);
  EXPECT_NE(finished.out.find("7.5 times that of healthy liver"), std::string::npos);
  EXPECT_NE(finished.out.find("\nfibrosis_f1,10.35,10.35,10.98,"), std::string::npos);
}

std::string entry(const std::string& name, const std::string& more)
{
  return R"({"name": ")" + name + R"(", "title": "T", "spread": "s", "method": "m", )" + more + "}";
}

std::string document(const std::string& entries)
{
  return R"({"palp_tissues": 1, "tissues": [)" + entries + "]}";
}

TEST(TissuePresets, AWrongFileIsRefusedInOneSentence)
{
  const std::string good = R"("young": "5kPa", "poisson": 0.49, "source": "S")";
  EXPECT_EQ(parseTissues(document(entry("a", good)), "t.json").size(), 1U);
  const std::pair<std::string, const char*> wrongs[] = { { "{}", "palp_tissues" },
    { document(entry("a", good) + "," + entry("a", good)), "/tissues/1/name: 'a' stands twice" },
    { document(entry("", good)), "/name: is missing" },
    { document(entry("a", R"("young": "5kPa", "poisson": 0.49)")), "/source: is missing" },
    { document(entry("a", R"("poisson": 0.49, "source": "S")")), "/young: is missing" },
    { document(entry("a", R"("young": "5", "poisson": 0.49, "source": "S")")), "has no unit" },
    { document(entry("a", R"("young": 5, "poisson": 0.49, "source": "S")")), "must be a text" },
    { document(entry("a", R"("young": "5kPa", "source": "S")")), "/poisson: " },
    { document(entry("a", R"("young": "5kPa", "poisson": 0.7, "source": "S")")), "/poisson: " },
    { document(entry("a", good + R"(, "low": "6kPa")")), "not from low to high" },
    { document(entry("a", good + R"(, "high": "4kPa")")), "not from low to high" },
    { document(entry("a", good + R"(, "shear": "5kPa")")), "unknown key" },
    { document(entry("a", good + R"(, "color": "red")")), "unknown key" } };
  for (const auto& [text, sentence] : wrongs)
  {
    try
    {
      (void)parseTissues(text, "t.json");
      ADD_FAILURE() << text;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << text;
      EXPECT_TRUE(std::string(error.what()).starts_with("t.json: ")) << error.what();
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace palp
