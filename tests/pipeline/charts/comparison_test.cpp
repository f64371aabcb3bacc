#include "pipeline/charts/comparison.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/charts/plot_files.h"
#include "tests/pipeline/charts/columns.h"
#include "tests/pipeline/surfaces.h"
#include "tests/support/process.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <span>
#include <vtkCellArray.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkRenderWindow.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::column;

const ForceLaw kLaw(SphereTip{ 10.0_mm }, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });

// a reference that is 10 % stronger at each depth
ReferenceCurve stronger()
{
  ReferenceCurve curve{ "FE", {}, {} };
  for (const double depth : { 1.0_mm, 2.0_mm, 4.0_mm })
  {
    curve.x.push_back(depth);
    curve.y.push_back(1.1 * kLaw({ .depth = depth }).force);
  }
  return curve;
}

TEST(ForcePlot, HasBandLawsAndReferencesInTheirUnits)
{
  const auto plot = forcePlot({ { "paper", kLaw } }, 4.0_mm, { stronger() });
  ASSERT_EQ(plot->tables().size(), 3U);
  const double largest = kLaw({ .depth = 4.0_mm }).force;
  vtkTable& band = *plot->tables()[0];
  EXPECT_NEAR(column(band, 0).back(), 4.0, 1e-12); // mm
  EXPECT_NEAR(column(band, 1).back(), 0.93 * largest, 1e-12);
  EXPECT_NEAR(column(band, 2).back(), 1.07 * largest, 1e-12);
  EXPECT_NEAR(column(*plot->tables()[1], 1).back(), largest, 1e-12);
  EXPECT_NEAR(column(*plot->tables()[2], 1).back(), 1.1 * largest, 1e-12);
}

TEST(ForceErrorPlot, IsEquationNine)
{
  const auto plot = forceErrorPlot({ NamedLaw{ "paper", kLaw } }, 4.0_mm, { stronger() });
  const auto error = column(*plot->tables()[1], 1);
  ASSERT_EQ(error.size(), 3U);
  EXPECT_NEAR(error[2], -100.0 / 11.0, 1e-9);                       // 0.1 / 1.1 of the largest
  EXPECT_NEAR(error[0], -100.0 / 11.0 * std::pow(0.25, 1.5), 1e-9); // Eq. (4): depth^1.5
}

TEST(ExtentPlot, FitsAQuadraticExactly)
{
  std::vector<ExtentTable::Extent> rows;
  for (int i = 1; i <= 10; ++i)
  {
    const double mm = i;
    rows.push_back({ mm * 1.0_mm, (2.0 + 3.0 * mm - 0.1 * mm * mm) * 1.0_mm, 0.0, 0.0 });
  }
  const auto plot = extentPlot(ExtentTable(rows), {});
  vtkTable& fit = *plot->tables()[1];
  const auto depth = column(fit, 0);
  const auto radius = column(fit, 1);
  for (std::size_t i = 0; i < depth.size(); ++i)
  {
    EXPECT_NEAR(radius[i], 2.0 + 3.0 * depth[i] - 0.1 * depth[i] * depth[i], 1e-9);
  }
}

class Files : public ::testing::Test
{
protected:
  Files()
  {
    view->GetRenderWindow()->SetOffScreenRendering(1);
    view->GetRenderWindow()->SetMultiSamples(0);
    view->GetRenderWindow()->SetSize(480, 320);
    plot->addTo(*view->GetScene());
  }

  [[nodiscard]] std::string read(const char* name) const
  {
    std::ifstream in(folder / name);
    return { std::istreambuf_iterator<char>(in), {} };
  }

  std::filesystem::path folder = test::freshFolder();
  std::unique_ptr<Plot> plot = forcePlot({ { "paper", kLaw } }, 4.0_mm, { stronger() });
  vtkNew<vtkContextView> view;
};

TEST_F(Files, CsvReadsBack)
{
  writeCsv(std::span(&plot, 1), folder / "force.csv");
  const std::string text = read("force.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "curve,depth \u03b4 [mm],force [N]");
  EXPECT_NE(text.find("\"FE\",1,"), std::string::npos);
  EXPECT_THROW(writeCsv(std::span(&plot, 1), "/nowhere/force.csv"), Error);
}

TEST_F(Files, SvgHasItsTextAsText)
{
  std::filesystem::remove(folder / "force.svg");
  writeSvg(*view->GetRenderWindow(), folder / "force.svg");
  const std::string text = read("force.svg");
  EXPECT_NE(text.find("<svg"), std::string::npos);
  EXPECT_NE(text.find("force [N]"), std::string::npos);
  EXPECT_NE(text.find("</svg>"), std::string::npos);
}

TEST_F(Files, SvgThatCannotBeWrittenIsAnError)
{
  EXPECT_THROW(writeSvg(*view->GetRenderWindow(), "/nowhere/force.svg"), Error);
  std::filesystem::create_directories(folder / "taken.svg");
  EXPECT_THROW(writeSvg(*view->GetRenderWindow(), folder / "taken.svg"), Error);
  EXPECT_TRUE(std::filesystem::is_directory(folder / "taken.svg"));
}

TEST_F(Files, PdfNeedsNoOtherProgram)
{
  setenv("PATH", "/nowhere", 1);
  writePdf(*view->GetRenderWindow(), folder / "force.pdf");
  const std::string text = read("force.pdf");
  EXPECT_EQ(text.substr(0, 5), "%PDF-");
  EXPECT_NE(text.find("%%EOF"), std::string::npos);
  EXPECT_GT(text.size(), 10'000U); // its letters are outlines
  EXPECT_EQ(text.find("/Subtype /Image"), std::string::npos) << "lines, and no picture behind them";
  plot->chart().GetAxis(vtkAxis::BOTTOM)->SetTitle("depth  [mm]");
  writePdf(*view->GetRenderWindow(), folder / "force.pdf");
  EXPECT_LT(read("force.pdf").size() + 300, text.size()) << "where it was, delta has an outline";
  EXPECT_THROW(writePdf(*view->GetRenderWindow(), "/nowhere/force.pdf"), Error);
}

TEST_F(Files, LinesTellNoDate)
{
  writeSvg(*view->GetRenderWindow(), folder / "force.svg");
  writePdf(*view->GetRenderWindow(), folder / "force.pdf");
  for (const char* name : { "force.svg", "force.pdf" })
  {
    const std::string text = read(name);
    EXPECT_EQ(text.find("CreationDate"), std::string::npos) << name;
    EXPECT_EQ(text.find("VTK GL2PS Export"), std::string::npos) << name;
    const auto year = std::chrono::year_month_day(
      std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()))
                        .year();
    EXPECT_EQ(text.find(' ' + std::to_string(static_cast<int>(year)) + '\n'), std::string::npos);
  }
}

// two charts in one window keep to their own halves: the lower one's curve is below the upper one's
TEST_F(Files, PlotsStandOneBelowTheOther)
{
  std::vector<std::unique_ptr<Plot>> plots;
  plots.push_back(forcePlot({ { "paper", kLaw } }, 4.0_mm, { stronger() }));
  plots.push_back(forceErrorPlot({ NamedLaw{ "paper", kLaw } }, 4.0_mm, { stronger() }));
  showPlots(*view->GetRenderWindow(), plots);
  writeSvg(*view->GetRenderWindow(), folder / "two.svg");
  const std::string text = read("two.svg");
  const auto heightOf = [&](const char* word) // of its text, from above [pixels]
  {
    const std::size_t tag = text.rfind("<text", text.find(word));
    return std::stod(text.substr(text.find(" y=\"", tag) + 4));
  };
  EXPECT_NEAR(heightOf("against the references") - heightOf("force over depth"), 0.6 * 320, 2.0);
}

TEST_F(Files, PngIsAPicture)
{
  std::filesystem::remove(folder / "force.png");
  writePng(*view->GetRenderWindow(), folder / "force.png");
  const std::string text = read("force.png");
  EXPECT_EQ(text.substr(1, 3), "PNG");
  EXPECT_GT(text.size(), 4000U); // an empty one has a few hundred bytes
}

} // namespace
} // namespace palp
