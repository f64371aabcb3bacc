#include "haptics/contact/body_rules.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/units.h"
#include "tests/haptics/contact/round_press.h"
#include "tests/support/csv_table.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

using test::kRoundTip;
using test::pressed;

// the same block with faces that are flat, and a little round by triangles of 4 mm
TEST(FacetRule, SeesRoundMeshesBesideAnEdge)
{
  const Vector3d size(100.0_mm, 100.0_mm, 50.0_mm);
  const auto holds = [&](int cells, double rounded, double place)
  {
    test::Mesh mesh = test::block(size, cells);
    for (Vector3d& point : mesh.first)
    {
      point.z() -= rounded * (point.x() * point.x() + point.y() * point.y());
    }
    const Surface surface = test::makeSurface(std::move(mesh));
    const double x = 0.5 * size.x() - place;
    const Contact contact =
      pressed(surface, { x, 0.0, -rounded * x * x }, 2.0_mm, -Vector3d::UnitZ());
    EXPECT_TRUE(contact.touching());
    return facetRule(surface, kRoundTip, contact).holds();
  };
  EXPECT_TRUE(holds(25, 0.0, 2.0_mm));
  EXPECT_FALSE(holds(25, 2.0, 2.0_mm));
  EXPECT_FALSE(holds(25, 2.0, 4.0_mm));
  EXPECT_TRUE(holds(25, 2.0, 20.0_mm));
  EXPECT_TRUE(holds(100, 2.0, 4.0_mm));
}

TEST(OpenRule, SeesThatNothingIsKnownBehindASurface)
{
  test::Mesh block = test::block({ 60.0_mm, 60.0_mm, 30.0_mm }, 12);
  const Surface whole = test::makeSurface(block);
  std::erase_if(block.second, // all but its upper face
    [&](const auto& corners)
    {
      return std::ranges::any_of(corners,
        [&](int point) { return block.first[static_cast<std::size_t>(point)].z() < -1.0_um; });
    });
  const Surface sheet = test::makeSurface(std::move(block));
  const auto holds = [](const Surface& surface, double depth)
  {
    return openRule(surface, pressed(surface, { 3.0_mm, 5.0_mm, 0.0 }, depth, -Vector3d::UnitZ()))
      .holds();
  };
  EXPECT_TRUE(holds(whole, 1.0_mm));
  EXPECT_FALSE(holds(sheet, 1.0_mm));
  EXPECT_FALSE(holds(sheet, 12.0_mm));
  EXPECT_TRUE(holds(sheet, -1.0_mm)) << "nothing is touched";
  // by the points in the tool alone, which measures no thickness
  const ToolPose pose{ { 3.0_mm, 5.0_mm, -1.0_mm }, -Vector3d::UnitZ(), Vector3d::Zero() };
  EXPECT_TRUE(
    openRule(whole, findContact(whole, SphereTip{ 10.0_mm }, pose, ContactRule::Paper)).holds());
}

// A block whose top turns at x = 0 over a fillet, in triangles that are small there.
class TurningBlock
{
public:
  TurningBlock(double turn, double fillet)
    : slope_(std::tan(0.5 * turn))
    , fillet_(fillet)
    , width_(fillet * std::sin(0.5 * std::abs(turn)))
  {
  }

  // of the top at a place beside its middle, of a face there [m]
  [[nodiscard]] double heightAt(double x) const
  {
    const double beyond = std::abs(x) - width_;
    const double arc =
      fillet_ - std::sqrt(fillet_ * fillet_ - std::pow(std::min(width_, std::abs(x)), 2));
    return std::copysign(arc, -slope_) - slope_ * std::max(0.0, beyond);
  }

  [[nodiscard]] Vector3d inwardAt(double x) const
  {
    return x == 0.0 ? -Vector3d::UnitZ()
                    : Vector3d(std::copysign(slope_, -x * slope_), 0.0, -1.0).normalized();
  }

  [[nodiscard]] Surface surface() const
  {
    const Vector3d half(60.0_mm, 40.0_mm, 20.0_mm);
    return test::makeSurface(test::cubeMap(40,
      [&](const Vector3d& p)
      {
        const double x = half.x() * p.x() * std::abs(p.x());
        const double base = -2.0 * half.z();
        return Vector3d(x, half.y() * p.y(), base + 0.5 * (p.z() + 1.0) * (heightAt(x) - base));
      }));
  }

private:
  double slope_;
  double fillet_;
  double width_;
};

ForceLaw linearLaw()
{
  LawSettings settings;
  settings.mode = LawMode::Corrected;
  settings.constitution = ConstitutiveModel::Linear;
  return { kRoundTip, makeMaterial(50.0_kPa, 0.45), settings };
}

// along the way of the tool [N]
double forceAlong(const Vector3d& way, const ForceLaw& law, const Contact& contact)
{
  return contact.slope * law(contactGeometryOf(contact)).force * -contact.normal.dot(way);
}

// makes each but once
template <typename Key, typename Make>
const Surface& surfaceOf(std::map<Key, Surface>& known, const Key& key, Make make)
{
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, make()).first->second;
}

TEST(UnevenRule, TellsWhereFiniteElementsDifferByATenth)
{
  const test::CsvTable table = test::readCsv(PALP_SOURCE_DIR "/data/reference/uneven_surface.csv");
  const ForceLaw law = linearLaw();
  const Validity validity(law);
  std::map<std::pair<double, double>, Surface> surfaces;
  int told = 0;
  int believed = 0;
  for (std::size_t i = 0; i < table["force_N"].size(); ++i)
  {
    const double turn = table["turn_deg"][i] * 1.0_deg;
    const double fillet = table["fillet_m"][i];
    const double place = table["place_m"][i];
    const TurningBlock block(turn, fillet);
    const Surface& surface = surfaceOf(surfaces, { turn, fillet }, [&] { return block.surface(); });
    const Contact contact = pressed(
      surface, { place, 0.0, block.heightAt(place) }, table["depth_m"][i], block.inwardAt(place));
    const double error =
      forceAlong(block.inwardAt(place), law, contact) / table["force_N"][i] - 1.0;
    const bool isUneven = !unevenRule(kRoundTip, contact).holds();
    const bool isEdge =
      (brokenRules(validity(contactGeometryOf(contact), contact.edgeDistance)) >> 7U & 1U) != 0;
    told += isUneven ? 1 : 0;
    believed += isUneven || isEdge ? 0 : 1;
    EXPECT_TRUE(isUneven || isEdge || std::abs(error) < 0.1)
      << table["turn_deg"][i] << ' ' << fillet << ' ' << place << ' ' << table["depth_m"][i] << ' '
      << error;
  }
  EXPECT_GT(told, 20);
  EXPECT_GT(believed, 60);
}

// waves as long as a contact is wide, and longer
TEST(UnevenRule, HoldsWhereALawOfAWavySurfaceIsThatOfFiniteElements)
{
  const test::CsvTable table = test::readCsv(PALP_SOURCE_DIR "/data/reference/wave_surface.csv");
  const ForceLaw law = linearLaw();
  std::map<double, Surface> surfaces;
  int told = 0;
  for (std::size_t i = 0; i < table["force_N"].size(); ++i)
  {
    const double number = 2.0 * std::numbers::pi / table["length_m"][i];
    const double amplitude = table["amplitude_m"][i];
    const double place = table["place_m"][i];
    const auto heightAt = [&](double x) { return amplitude * std::cos(number * x); };
    const auto block = [&](const Vector3d& p)
    {
      const double x = 60.0_mm * p.x();
      const double base = -40.0_mm;
      return Vector3d(x, 40.0_mm * p.y(), base + 0.5 * (p.z() + 1.0) * (heightAt(x) - base));
    };
    const Surface& surface =
      surfaceOf(surfaces, number, [&] { return test::makeSurface(test::cubeMap(100, block)); });
    const Vector3d way =
      Vector3d(-amplitude * number * std::sin(number * place), 0.0, -1.0).normalized();
    const Contact contact =
      pressed(surface, { place, 0.0, heightAt(place) }, table["depth_m"][i], way);
    const bool isEven = unevenRule(kRoundTip, contact).holds();
    told += isEven ? 0 : 1;
    EXPECT_NEAR(forceAlong(way, law, contact) / table["force_N"][i], 1.0, isEven ? 0.03 : 0.1)
      << table["length_m"][i] << ' ' << place << ' ' << table["depth_m"][i];
  }
  EXPECT_GT(told, 5);
  EXPECT_LT(told, 24);
}

} // namespace
} // namespace palp
