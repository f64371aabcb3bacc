#include "pipeline/charts/comparison.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/charts/plot_files.h"
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

const ForceLaw kLaw(SphereTip{ 10.0_mm }, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });

std::vector<double> column(vtkTable& table, vtkIdType index)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < table.GetNumberOfRows(); ++i)
  {
    values.push_back(table.GetValue(i, index).ToDouble());
  }
  return values;
}

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

// a sphere in a plane, as if elements had found a hyperbola outside the contact
class PlaneSection : public ::testing::Test
{
protected:
  PlaneSection()
  {
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(-30.0_mm, -30.0_mm, 0.0);
    source->SetPoint1(30.0_mm, -30.0_mm, 0.0);
    source->SetPoint2(-30.0_mm, 30.0_mm, 0.0);
    source->SetResolution(60, 60);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(source->GetOutputPort());
    filter->SetInputConnection(triangles->GetOutputPort());
    filter->GeneratePatchOn();
    filter->SetPatchLevel(2);
    filter->SetPress(press);
    plot = sectionPlot(*filter, Eigen::Vector3d(1.0, 0.05, 0.0), elements);
  }

  [[nodiscard]] std::vector<double> x(std::size_t curve) const
  {
    return column(*plot->tables().at(curve), 0);
  }
  [[nodiscard]] std::vector<double> height(std::size_t curve) const
  {
    return column(*plot->tables().at(curve), 1);
  }

  const Press press = test::pressAt(
    Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), SphereTip{ 10.0_mm }, 4.0_mm, 18.0_mm);
  const SurfaceProfile elements{ .inner = 7.0_mm,
    .outer = 40.0_mm,
    .sink = 2.0_mm,
    .slope = 0.5,
    .control = { 1.0_mm, 1.0_mm } };
  const double r = press.contactRadius;
  const double sink = 4.0_mm - tipHeight(press.tip, r);
  const double slope = tipSlope(press.tip, r);
  vtkNew<vtkPalpDeformFilter> filter;
  std::unique_ptr<Plot> plot;
};

TEST_F(PlaneSection, CutsAPlaneAlongTheCurveOfEquationEight)
{
  ASSERT_EQ(plot->tables().size(), 8U); // the curve and the elements on either side
  const RingCurve ring = makeRingCurve(r, sink, slope, 18.0_mm);
  const auto along = x(2);
  const auto z = height(2);
  EXPECT_GT(along.size(), 100U);
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    const double radius = std::abs(units::fromMillimeters(along[i]));
    const double expected =
      radius < r ? 4.0_mm - tipHeight(press.tip, radius) : ring.sinkAt(radius);
    EXPECT_NEAR(units::fromMillimeters(z[i]), -expected, 10.0_um) << along[i];
  }
  for (const double atRest : height(1))
  {
    EXPECT_NEAR(atRest, 0.0, 1e-4);
  }
}

// Fig. 5(b): P0 on the tool, P1 where its tangent meets the surface, P2 at R_d
TEST_F(PlaneSection, MarksTheControlPointsOnEitherSide)
{
  const auto controlX = x(5);
  const auto controlZ = height(5);
  const std::vector<std::pair<double, double>> control{ { r, -sink }, { r + sink / slope, 0.0 },
    { 18.0_mm, 0.0 } };
  ASSERT_EQ(controlX.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const double side = i < 3 ? 1.0 : -1.0;
    EXPECT_NEAR(units::fromMillimeters(controlX[i]), side * control[i % 3].first, 10.0_um);
    EXPECT_NEAR(units::fromMillimeters(controlZ[i]), control[i % 3].second, 10.0_um);
  }
}

TEST_F(PlaneSection, LaysElementsBelowTheSurfaceAtRest)
{
  for (const std::size_t side : { 6U, 7U })
  {
    const auto radius = x(side);
    const auto z = height(side);
    EXPECT_GT(radius.size(), 20U);
    for (std::size_t i = 0; i < radius.size(); ++i)
    {
      const double at = std::abs(units::fromMillimeters(radius[i]));
      EXPECT_NEAR(units::fromMillimeters(z[i]), -elements.sinkAt(at), 1.0_um);
    }
  }
}

// Near the rim of a thin lobe the plane meets the body above and below the same place.
TEST(SectionPlot, RunsAroundTheRimOfALobe)
{
  constexpr double kWide = 20.0_mm;
  constexpr double kHalf = 4.0_mm;
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetThetaResolution(121);
  ball->SetPhiResolution(121);
  vtkNew<vtkTransform> flat;
  flat->Scale(kWide, kWide, kHalf);
  vtkNew<vtkTransformPolyDataFilter> lobe;
  lobe->SetTransform(flat);
  lobe->SetInputConnection(ball->GetOutputPort());
  const double side = 15.0_mm;
  const Eigen::Vector3d position(side, 0.0, kHalf * std::sqrt(1.0 - std::pow(side / kWide, 2)));
  const Eigen::Vector3d up =
    Eigen::Vector3d(position.x() / (kWide * kWide), 0.0, position.z() / (kHalf * kHalf))
      .normalized();
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputConnection(lobe->GetOutputPort());
  filter->GeneratePatchOn();
  filter->SetPress(test::pressAt(position, up, SphereTip{ 6.0_mm }, 2.0_mm, 14.0_mm));
  filter->Update();

  const Eigen::Vector3d along = Eigen::Vector3d::UnitY().cross(up);
  const auto plot = sectionPlot(*filter, along);
  vtkTable& rest = *plot->tables()[1];
  const auto x = column(rest, 0);
  const auto z = column(rest, 1);
  ASSERT_GT(x.size(), 50U);
  double least = kWide; // [m]
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const Eigen::Vector3d at =
      position + units::fromMillimeters(x[i]) * along + units::fromMillimeters(z[i]) * up;
    EXPECT_NEAR(std::hypot(at.x() / kWide, at.z() / kHalf), 1.0, 0.01) << at.transpose();
    least = std::min(least, at.z());
    if (i > 0)
    {
      EXPECT_LT(std::hypot(x[i] - x[i - 1], z[i] - z[i - 1]), 2.0) << x[i]; // mm, as its triangles
    }
  }
  EXPECT_LT(least, 0.0); // the lower side is in the cut, too
}

// 3 mm beside the middle of one of 5 mm: a circle of 4
TEST_F(PlaneSection, HasNodulesThatTheCutMeets)
{
  const std::vector<PlacedNodule> nodules{
    { .center = { 0.0, 8.0_mm, -12.0_mm }, .radius = 5.0_mm, .ratio = 10.0 },
    { .center = { 5.0_mm, -3.0_mm, -12.0_mm }, .radius = 5.0_mm, .ratio = 10.0 },
  };
  const auto with = sectionPlot(*filter, Eigen::Vector3d(1.0, 0.05, 0.0), elements, nodules);
  ASSERT_EQ(with->tables().size(), plot->tables().size() + 1);
  vtkTable& circle = *with->tables().back();
  EXPECT_STREQ(circle.GetColumnName(1), "nodule, at rest");
  const auto along = column(circle, 0);
  const auto up = column(circle, 1);
  ASSERT_GT(along.size(), 50U);
  double lowest = 0.0;
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    EXPECT_NEAR(std::hypot(along[i] - 5.0, up[i] + 12.0), 4.0, 1e-3);
    lowest = std::min(lowest, up[i]);
  }
  EXPECT_NEAR(lowest, -16.0, 0.01);
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
