#include "tests/app/commands/run_rig.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using test::Finished;
using test::palp;

// A surface with its array: of the block, in its upright frame, in mm.
struct ArrayPoints
{
  std::vector<Eigen::Vector3d> points{};

  // over the faces of a box whose top is the plane z = 0
  static ArrayPoints ofBox(const Eigen::Vector3d& size, int across)
  {
    ArrayPoints made;
    for (int i = 0; i <= across; ++i)
    {
      for (int j = 0; j <= across; ++j)
      {
        for (const double side : { 0.0, 1.0 })
        {
          const double u = static_cast<double>(i) / across;
          const double v = static_cast<double>(j) / across;
          for (const Eigen::Vector3d& at : { Eigen::Vector3d(u, v, side),
                 Eigen::Vector3d(u, side, v), Eigen::Vector3d(side, u, v) })
          {
            made.points.emplace_back((at - Eigen::Vector3d(0.5, 0.5, 1.0)).cwiseProduct(size));
          }
        }
      }
    }
    return made;
  }

  [[nodiscard]] ArrayPoints moved(const Eigen::Affine3d& by) const
  {
    ArrayPoints all = *this;
    std::ranges::transform(
      all.points, all.points.begin(), [&](const Eigen::Vector3d& at) { return by * at; });
    return all;
  }

  void write(const std::filesystem::path& file) const
  {
    std::ofstream out(file);
    out << R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>)"
        << "<Piece NumberOfPoints=\"" << points.size() << "\" NumberOfPolys=\"1\"><PointData>"
        << R"(<DataArray type="Float32" Name="E_kPa" format="ascii">)";
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      out << "20 ";
    }
    out << R"(</DataArray></PointData><Points><DataArray type="Float64" )"
        << R"(NumberOfComponents="3" format="ascii">)";
    for (const Eigen::Vector3d& at : points)
    {
      out << at.transpose() << ' ';
    }
    out << R"(</DataArray></Points><Polys><DataArray type="Int32" Name="connectivity" )"
        << R"(format="ascii">0 1 2</DataArray><DataArray type="Int32" Name="offsets" )"
        << R"(format="ascii">3</DataArray></Polys></Piece></PolyData></VTKFile>)";
  }
};

class StiffnessArray : public test::RunCommand
{
protected:
  [[nodiscard]] Finished pressed(const std::string& file)
  {
    const std::string out = (folder_.path() / ("out" + std::to_string(presses_++))).string();
    return palp("run " + block() + " --at 0,0,0 --depth 2mm --tip sphere:20mm --samples-only" +
      " --poisson 0.45 --law corrected --stiffness array:" + file + ":E_kPa --out " + out);
  }

private:
  int presses_ = 0;
};

TEST_F(StiffnessArray, IsOfTheBodysSurfaceInItsFrameAndUnit)
{
  const Eigen::Vector3d size(100.0, 100.0, 50.0);
  const ArrayPoints whole = ArrayPoints::ofBox(size, 25);
  const std::string file = folder_.path() / "map.vtp";
  const auto shifted = [](double x, double y, double z)
  { return Eigen::Affine3d(Eigen::Translation3d(x, y, z)); };
  ArrayPoints part = whole; // of the top
  std::erase_if(part.points, [](const Eigen::Vector3d& at) { return at.z() < 0.0; });
  const ArrayPoints rounded = ArrayPoints::ofBox(0.97 * size, 25).moved(shifted(0.0, 0.0, -0.75));
  for (const ArrayPoints& copy : { whole, ArrayPoints::ofBox(size, 1), ArrayPoints::ofBox(size, 4),
         rounded, part, whole.moved(shifted(2.0, -2.0, 1.0)) })
  {
    copy.write(file);
    const Finished finished = pressed(file);
    EXPECT_EQ(finished.code, 0) << copy.points.size() << finished.err;
  }
  for (const Eigen::Affine3d& by : { shifted(500.0, 0.0, 0.0), shifted(20.0, 0.0, 0.0),
         shifted(0.0, 0.0, -15.0), Eigen::Affine3d(Eigen::Scaling(0.1)),
         Eigen::Affine3d(Eigen::Scaling(0.001)), Eigen::Affine3d(Eigen::Scaling(10.0)),
         Eigen::Affine3d(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())) })
  {
    whole.moved(by).write(file);
    const Finished finished = pressed(file);
    EXPECT_EQ(finished.code, 2) << by.matrix();
    EXPECT_NE(finished.err.find("map.vtp: its surface is not that of the body: a tenth of its "
                                "points are "),
      std::string::npos)
      << finished.err;
    EXPECT_NE(finished.err.find("in the frame and the unit of the body"), std::string::npos);
    EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
  }
}

} // namespace
} // namespace palp
