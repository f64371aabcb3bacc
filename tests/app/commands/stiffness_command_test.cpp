#include "tests/app/commands/run_rig.h"
#include "tests/haptics/force/reference_table.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace palp
{
namespace
{

using test::Finished;
using test::palp;

const std::string kSoft = " --young 50kPa --poisson 0.45 --law corrected --material linear ";

// rows A, B and C of data/reference/maps_axisym.csv: linear finite elements
TEST(StiffnessCommand, ForceFollowsFiniteElementsOverFormulas)
{
  struct Case
  {
    const char* formula;
    std::vector<double> forces; // at 2, 4 and 6 mm
  };
  for (const Case& one : { Case{ "if(z>10,150,50)", { 1.0588, 3.36806, 6.5971 } },
         Case{ "if(z<2,150,50)", { 0.937734, 2.60541, 4.77326 } },
         Case{ "50*(1+z/20)", { 1.11988, 3.43424, 6.57106 } },
         Case{ "if(r<6,100,50)", { 1.22661, 3.20861, 5.61812 } } })
  {
    const test::CsvTable felt = test::printedTable(palp("force --tip sphere:10mm --depth 2:6:2mm" +
      kSoft + "--thickness 40mm --stiffness 'formula:" + one.formula + "'"));
    for (std::size_t i = 0; i < one.forces.size(); ++i)
    {
      EXPECT_NEAR(felt["force_N"][i], one.forces[i], 0.05 * one.forces[i]) << one.formula;
    }
    EXPECT_GT(felt["factor_stiffness"][0], 1.0);
  }
}

// of a press of 4 mm, at a step beside the origin of a map [N mm]
double workBeside(const std::string& tip, std::string formula, double step)
{
  for (std::size_t at = 0; (at = formula.find('X')) != std::string::npos;)
  {
    formula.replace(at, 1, "(x+" + std::to_string(step) + ")");
  }
  const test::CsvTable felt =
    test::printedTable(palp("force --depth 0:4:0.1mm --base bonded --thickness 40mm --tip " + tip +
      kSoft + "--stiffness 'formula:" + formula + "'"));
  double work = 0.0;
  for (std::size_t i = 1; i < felt["force_N"].size(); ++i)
  {
    work += 0.5 * (felt["force_N"][i] + felt["force_N"][i - 1]) * 0.1;
  }
  return work;
}

// the lateral force is the slope of the work that is done at places beside each other
TEST(StiffnessCommand, PushesTheToolAsideByTheSlopeOfTheWork)
{
  constexpr double kStep = 0.5; // [mm]
  for (const std::string tip : { "sphere:8mm", "cone:45deg:10mm", "punch:4mm" })
  {
    for (const std::string formula : { "40+30*tanh(X/8)", "30+X*X/20+5*tanh((X+y)/9)",
           "if(X>0,60,25)", "25+40*exp(-((X-6)^2+y^2+(z-8)^2)/50)" })
    {
      const double expected =
        -(workBeside(tip, formula, kStep) - workBeside(tip, formula, -kStep)) / (2.0 * kStep);
      std::string here = formula;
      std::ranges::replace(here, 'X', 'x');
      const test::CsvTable felt =
        test::printedTable(palp("force --depth 4:4:1mm --base bonded --thickness 40mm --tip " +
          tip + kSoft + "--stiffness 'formula:" + here + "'"));
      EXPECT_NEAR(
        felt["lateral_force_N"][0], expected, 0.02 * std::abs(expected) + 1e-3 * felt["force_N"][0])
        << tip << ' ' << formula;
    }
  }
}

TEST(StiffnessCommand, TellsThePushAcrossItsColumn)
{
  const std::string options = "force --depth 4:4:1mm --thickness 40mm" + kSoft + "--stiffness ";
  const Finished both = palp(options + "'formula:if(x+y>0,60,25)'");
  EXPECT_NE(both.err.find("lateral_force_N is along x; at the largest depth the map pushes by -"),
    std::string::npos)
    << both.err;
  for (const char* even : { "if(x>0,60,25)", "if(z>3,60,25)", "if(r<4,60,25)" })
  {
    const Finished along = palp(options + "'formula:" + even + "'");
    EXPECT_EQ(along.err.find("along y"), std::string::npos) << along.err;
  }
}

// linear finite elements over maps about the axis, beside what they are off over an even body
TEST(StiffnessCommand, FlagsWhereMapsAreMoreThanFivePercentOff)
{
  std::map<std::string, test::CsvTable> felt; // at 2 to 5 mm
  std::map<std::string, double> even;         // 0 but for the cone, whose tip they round
  std::size_t flagged = 0;
  std::size_t kept = 0;
  for (const test::ReferenceRow& row : test::referenceTable("maps_tools"))
  {
    const std::string tip = row.text("tip");
    std::string map = row.text("map");
    std::ranges::replace(map, ';', ',');
    const std::string options = tip + " --stiffness 'formula:" + map + "'";
    if (!felt.contains(options))
    {
      felt[options] = test::printedTable(
        palp("force --law corrected --material linear --base bonded --poisson .45 --young 30kPa "
             "--thickness 40mm --validity --depth 2:5:1mm --tip " +
          options));
    }
    test::CsvTable& law = felt[options];
    const auto at = static_cast<std::size_t>(row.number("depth_mm")) - 2;
    const std::string press = tip + row.text("depth_mm");
    const double error = law["force_N"][at] / row.number("force_N") - 1.0;
    if (map == "30")
    {
      even[press] = error;
      continue;
    }
    const bool isFlagged = law["stiffness_spread_of_limit"][at] > 1.0;
    EXPECT_LT(std::abs(error - even[press]), isFlagged ? 0.13 : 0.05) << options << press;
    (isFlagged ? flagged : kept) += 1;
  }
  EXPECT_GT(kept, 80u);
  EXPECT_GT(flagged, 60u);
}

// A block of 100 x 100 x 50 mm in voxels of 1 mm, with a sheet of 2 mm on top.
class StiffnessFiles : public test::RunCommand
{
protected:
  [[nodiscard]] std::string image(const std::string& name, const std::string& type,
    const std::function<std::string(int)>& voxel, double offset = -49.5)
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream out(file, std::ios::binary);
    out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        << "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = " << offset << ' ' << offset
        << " -49.5\nElementSpacing = 1 1 1\nDimSize = 100 100 50\nElementType = " << type
        << "\nElementDataFile = LOCAL\n";
    for (int k = 0; k < 50; ++k)
    {
      for (int i = 0; i < 100 * 100; ++i)
      {
        out << voxel(k);
      }
    }
    return file.string();
  }

  [[nodiscard]] std::string labels(double offset = -49.5)
  {
    return image(
      "labels.mha", "MET_UCHAR", [](int k) { return std::string(1, k >= 48 ? '\2' : '\1'); },
      offset);
  }

  [[nodiscard]] Finished pressed(const std::string& stiffness, const std::string& law = kSoft)
  {
    return palp("run " + block() + " --at 0,0,0 --depth 6mm --samples-only --overwrite --out " +
      (folder_.path() / "out").string() + law + "--stiffness '" + stiffness + "'");
  }

  [[nodiscard]] double deepestForce()
  {
    std::ifstream in(folder_.path() / "out/samples.csv");
    const test::CsvTable table = test::parseCsv(in);
    return *std::max_element(table["force_N"].begin(), table["force_N"].end());
  }
};

// all but the sheet on top
TEST_F(StiffnessFiles, NamesTheLabelThatHasNoTissue)
{
  const Finished refused = pressed("labels:" + labels() + ":2=150kPa");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("; in labels.mha no tissue is given to label 1\n"), std::string::npos)
    << refused.err;
}

TEST_F(StiffnessFiles, LabelsImagesAndFormulasSayTheSame)
{
  const double expected = test::printedTable(palp("force --tip sphere:10mm --depth 6:6:1mm" +
    kSoft + "--thickness 50mm --stiffness 'formula:if(z<2,150,50)'"))["force_N"][0];
  Finished finished = pressed("labels:" + labels() + ":1=50kPa,2=150kPa");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NEAR(deepestForce(), expected, 0.02 * expected);

  const std::string kilopascals = image("kpa.mha", "MET_FLOAT",
    [](int k)
    {
      const float value = k >= 48 ? 150.0F : 50.0F;
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    });
  finished = pressed("image:" + kilopascals);
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NEAR(deepestForce(), expected, 0.02 * expected);

  finished = pressed("formula:if(z>-2,150,50)");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NEAR(deepestForce(), expected, 0.02 * expected);
  // and again to the byte, from the folder alone
  const Finished again = palp(
    "run " + (folder_.path() / "out").string() + " --out " + (folder_.path() / "again").string());
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
}

TEST_F(StiffnessFiles, AnArrayCountsInward)
{
  const std::string file = folder_.path() / "map.vtp";
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(block().c_str());
  reader->Update();
  std::ofstream(file)
    << R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">)"
    << R"(<PolyData><Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="0")"
    << R"( NumberOfStrips="0" NumberOfPolys="1"><PointData>)"
    << R"(<DataArray type="Float32" Name="E_kPa" format="ascii">20 20 20</DataArray>)"
    << R"(</PointData><Points><DataArray type="Float32" NumberOfComponents="3")"
    << R"( format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>)"
    << R"(<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2)"
    << R"(</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3)"
    << R"(</DataArray></Polys></Piece></PolyData></VTKFile>)";
  const Finished finished = pressed("array:" + file + ":E_kPa");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const double expected = test::printedTable(
    palp("force --tip sphere:10mm --depth 6:6:1mm --young 20kPa --poisson 0.45 --law "
         "corrected --material linear --thickness 50mm"))["force_N"][0];
  EXPECT_NEAR(deepestForce(), expected, 0.01 * expected);
  const Finished missing = pressed("array:" + file + ":young");
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("E_kPa"), std::string::npos) << missing.err;
}

TEST_F(StiffnessFiles, ARandomTissueFollowsItsSeed)
{
  std::vector<double> forces;
  for (const char* seed : { "7", "8" })
  {
    const Finished finished = pressed(std::string("random:0.3:8mm:") + seed);
    ASSERT_EQ(finished.code, 0) << finished.err;
    forces.push_back(deepestForce());
  }
  EXPECT_GT(std::abs(forces[1] / forces[0] - 1.0), 0.005);
  EXPECT_NEAR(forces[0], forces[1], 0.4 * forces[0]);
}

TEST_F(StiffnessFiles, RefusesInASentence)
{
  const std::string nan = image("nan.mha", "MET_FLOAT",
    [](int k)
    {
      const float value = k == 7 ? std::nanf("") : 5.0F;
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    });
  const std::string pascals = image("pa.mha", "MET_FLOAT",
    [](int)
    {
      const float value = 6630.0F;
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    });
  struct Case
  {
    std::string stiffness;
    const char* says;
    std::string law = kSoft;
  };
  const std::string there = labels();
  for (const Case& one :
    { Case{ "labels:" + there + ":1=50kPa,7=9kPa", "label '7'; there are 1, 2" },
      Case{ "labels:" + there + ":1=liverr", "liverr" }, Case{ "labels:" + there, "labels:FILE" },
      Case{ "labels:" + there + ":1=50kPa,2=9kPa,1=6kPa", "'1' is given twice" },
      Case{ "image:" + nan, "voxel 0,0,7 of it, counted from 0, is no number" },
      // a term that is no number, whatever its sum with others would be
      Case{ "formula:60+sqrt(z)", "stiffness: '60+sqrt(z)' is no number at" },
      Case{ "formula:60+asin(x)", "is no number at" },
      Case{ "formula:log(x)", "write ln or log10" }, Case{ "image:none.nii", "not found" },
      Case{ "image:" + pascals, "divide those in Pa by 1000" },
      Case{ "formula:6+", "is no formula" }, Case{ "formula:z", "not above 0 kPa" },
      Case{ "formula:1e12", "gives 1e+12 kPa at" }, Case{ "formula:1e-4", "1 Pa to 10 GPa" },
      Case{ "random:0.3:8", "has no unit" }, Case{ "random:2:8mm", "out of range" },
      Case{ "elastic", "labels:FILE" }, Case{ "formula:6", "law 'corrected'", " --law paper " } })
  {
    const Finished refused = pressed(one.stiffness, one.law);
    EXPECT_EQ(refused.code, 2) << one.stiffness;
    EXPECT_NE(refused.err.find(one.says), std::string::npos) << one.stiffness << refused.err;
    EXPECT_NE(refused.err.find("stiffness"), std::string::npos) << refused.err;
    EXPECT_EQ(refused.err.find("stiffness: stiffness"), std::string::npos) << refused.err;
    EXPECT_EQ(test::sentences(refused).size(), 1U) << refused.err;
  }
  const Finished elsewhere = pressed("labels:" + labels(400.0) + ":1=50kPa,2=150kPa");
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_NE(elsewhere.err.find("in the frame of the body"), std::string::npos) << elsewhere.err;
  EXPECT_EQ(elsewhere.err.find("no tissue is given"), std::string::npos) << elsewhere.err;
}

} // namespace
} // namespace palp
