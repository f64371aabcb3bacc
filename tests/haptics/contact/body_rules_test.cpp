#include "haptics/contact/body_rules.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/units.h"
#include "tests/support/csv_table.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
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

const Tip kRoundTip = SphereTip{ .radius = 10.0_mm };

Contact pressed(const Surface& surface, const Vector3d& place, double depth, const Vector3d& way)
{
  return findContact(
    surface, kRoundTip, { .apex = place + depth * way, .axis = way }, ContactRule::Exact);
}

// By finite elements plates of 120 mm that are held at one end are 200, 27 and 7 times softer than
// the law says, of 6, 12 and 20 mm, and a tongue 24 to 30 mm thick twice to four times; on their
// backs they are not, which has to be said.
TEST(LobeRule, SeesPlatesInAnyAttitudeUnlessTheyLieOnSomething)
{
  const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& frame : { Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turned })
  {
    const auto holds = [&](double side, double thickness, Base base = Base::Unset)
    {
      test::Mesh mesh = test::block({ side, side, thickness }, 20);
      for (Vector3d& point : mesh.first)
      {
        point = frame * point;
      }
      const Surface surface = test::makeSurface(std::move(mesh));
      const Contact contact =
        pressed(surface, Vector3d::Zero(), 1.0_mm, frame * -Vector3d::UnitZ());
      EXPECT_TRUE(contact.touching());
      const Rule rule = lobeRule(surface, contact, 3.2_mm, base);
      // how it would give way is never known before its base is
      EXPECT_EQ(rule.fraction() >= Rule::kDoubtful, base == Base::Unset);
      return rule.holds();
    };
    for (const double thickness : { 6.0_mm, 12.0_mm, 20.0_mm, 30.0_mm })
    {
      EXPECT_FALSE(holds(120.0_mm, thickness)) << thickness;
      EXPECT_TRUE(holds(120.0_mm, thickness, Base::Bonded)) << thickness;
      EXPECT_TRUE(holds(120.0_mm, thickness, Base::Slip)) << thickness;
    }
    EXPECT_FALSE(holds(80.0_mm, 30.0_mm));
    EXPECT_TRUE(!frame.isIdentity() || holds(100.0_mm, 50.0_mm));
  }
  const Surface ball = test::makeSurface(test::ball(40.0_mm, 20));
  const Contact contact = pressed(ball, { 0.0, 0.0, 40.0_mm }, 1.0_mm, -Vector3d::UnitZ());
  EXPECT_TRUE(lobeRule(ball, contact, 2.8_mm, Base::Unset).holds());
}

// A block of 100 x 100 x 50 mm, and the press of its top at a place right of its left edge. The
// face below that is slant by an angle to the top from one height below it to another.
std::pair<Surface, Contact> slantBlock(
  double angle, double place, double from = 0.0, double to = 50.0_mm)
{
  const Vector3d size(100.0_mm, 100.0_mm, 50.0_mm);
  test::Mesh mesh = test::block(size, 20);
  for (Vector3d& point : mesh.first)
  {
    const double below = std::clamp(-point.z(), from, to) - from;
    point.x() += below / std::tan(angle) * (0.5 - point.x() / size.x());
  }
  Surface surface = test::makeSurface(std::move(mesh));
  const Contact contact =
    pressed(surface, { place - 0.5 * size.x(), 0.0, 0.0 }, 1.0_mm, -Vector3d::UnitZ());
  return { std::move(surface), contact };
}

// What the law is over finite elements with contact, bonded 50 mm below, 0.5, 1.5 and 3.5 mm deep
// (B-bar, by another program).
TEST(LobeRule, SeesAWedgeWhereItYieldsMoreThanAHandNotices)
{
  struct Case
  {
    double angle;                 // [rad]
    double place;                 // [m]
    std::array<double, 3> excess; // of the law
  };
  for (const Case& one : { Case{ 45.0_deg, 45.0_mm, { 0.128, 0.210, 0.307 } },
         Case{ 45.0_deg, 58.0_mm, { 0.049, 0.075, 0.096 } },
         Case{ 60.0_deg, 28.0_mm, { 0.119, 0.193, 0.279 } },
         Case{ 60.0_deg, 40.0_mm, { 0.050, 0.074, 0.094 } },
         Case{ 75.0_deg, 20.0_mm, { 0.093, 0.144, 0.200 } },
         Case{ 75.0_deg, 32.0_mm, { 0.042, 0.057, 0.067 } },
         Case{ 90.0_deg, 28.0_mm, { 0.034, 0.041, 0.044 } } })
  {
    const auto [surface, contact] = slantBlock(one.angle, one.place);
    for (std::size_t i = 0; i < one.excess.size(); ++i)
    {
      const double radius = std::array{ 2.25_mm, 3.88_mm, 5.78_mm }.at(i);
      const Rule rule = lobeRule(surface, contact, radius, Base::Unset);
      EXPECT_TRUE(rule.holds() || one.excess.at(i) > 0.07) << one.angle << ' ' << i;
      EXPECT_FALSE(rule.holds() && one.excess.at(i) > 0.08) << one.angle << ' ' << i;
      // the slant face may be what lies on something
      const Rule onBase = lobeRule(surface, contact, radius, Base::Bonded);
      EXPECT_TRUE(onBase.holds() && (rule.holds() || onBase.fraction() >= Rule::kDoubtful));
    }
  }
}

// By our elements, 2 mm deep, the law is 26, 25 and 16 % too stiff where a nose of 5 and 3 mm is
// cut off a wedge, and 3 % beside an edge that is undercut for 2 mm.
TEST(LobeRule, SeesAWedgeWithoutItsEdgeAndNoneBesideAnUndercut)
{
  const auto holds = [](double angle, double place, double from, double to)
  {
    const auto [surface, contact] = slantBlock(angle, place, from, to);
    return lobeRule(surface, contact, 4.4_mm, Base::Unset).holds();
  };
  EXPECT_FALSE(holds(45.0_deg, 35.0_mm, 5.0_mm, 50.0_mm));
  EXPECT_FALSE(holds(60.0_deg, 23.3_mm, 3.0_mm, 50.0_mm));
  EXPECT_FALSE(holds(60.0_deg, 28.3_mm, 3.0_mm, 50.0_mm));
  EXPECT_TRUE(holds(60.0_deg, 30.0_mm, 0.0, 2.5_mm));
  EXPECT_TRUE(holds(45.0_deg, 35.0_mm, 0.0, 7.5_mm));
}

// By finite elements (B-bar) a column of 40 mm that stands 120 mm high is 1.33 and 1.44 times
// softer at 0.5 and 1 mm than the law says, and a cube of 60 mm that is held at its side 1.38 times
// at 3.
TEST(LobeRule, SeesWhatIsHighAndSlimWhateverItStandsOn)
{
  struct Case
  {
    Vector3d size; // [m]
    double radius; // of the contact [m]
    bool holds;
  };
  for (const Case& one : { Case{ { 40.0_mm, 40.0_mm, 120.0_mm }, 2.2_mm, false },
         Case{ { 40.0_mm, 40.0_mm, 120.0_mm }, 3.2_mm, false },
         Case{ { 60.0_mm, 60.0_mm, 60.0_mm }, 5.5_mm, false },
         Case{ { 100.0_mm, 100.0_mm, 50.0_mm }, 9.0_mm, true },
         Case{ { 100.0_mm, 100.0_mm, 20.0_mm }, 9.0_mm, true } })
  {
    const Surface surface = test::makeSurface(test::block(one.size, 20));
    const Contact contact = pressed(surface, Vector3d::Zero(), 1.0_mm, -Vector3d::UnitZ());
    EXPECT_EQ(lobeRule(surface, contact, one.radius, Base::Bonded).holds(), one.holds)
      << one.size.transpose();
  }
}

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
