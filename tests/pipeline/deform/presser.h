#pragma once

#include "calibration/tables/extent_table.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "pipeline/deform/press_of.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>
#include <vtkPolyData.h>

namespace palp::test
{

using namespace units::literals;

/// Something to press, where, and which way is out.
struct PressedBody
{
  std::string name;
  DentedSurface surface;
  Surface haptic;
  Eigen::Vector3d position;
  Eigen::Vector3d outward;
};

inline PressedBody pressedBody(const std::string& name, const Mesh& mesh,
  const Eigen::Vector3d& position, Eigen::Vector3d outward)
{
  return { name, dented(mesh), Surface(mesh.points, mesh.triangles), position,
    outward.normalized() };
}

inline PressedBody madeBody(const std::string& name)
{
  if (name == "block")
  {
    return pressedBody(
      name, makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 2.0_mm), { 0.3_mm, 0.2_mm, 0.0 }, { 0, 0, 1 });
  }
  if (name == "oblique")
  {
    return pressedBody(name, makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 2.0_mm),
      { 0.3_mm, 0.2_mm, 0.0 }, { 0.3, 0.2, 1.0 });
  }
  if (name == "rough") // as a scan
  {
    Mesh mesh = makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 2.0_mm);
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0.0, 0.25_mm);
    for (Eigen::Vector3d& point : mesh.points)
    {
      point.z() += point.z() > -1.0_um ? noise(random) : 0.0;
    }
    return pressedBody(name, mesh, { 0.3_mm, 0.2_mm, 0.0 }, { 0, 0, 1 });
  }
  if (name == "liver")
  {
    const auto read = readSurface(PALP_SHARE "/meshes/liver.vtp").mesh;
    // where data/paths/liver_press.csv begins
    return pressedBody(name, { pointsOf(*read), trianglesOf(*read) },
      { -45.57_mm, -47.3_mm, 5.2_mm }, { -0.132335, -0.986613, 0.095300 });
  }
  if (name == "ridge") // bent as much as the tools one way, hardly the other
  {
    return pressedBody(name, makeEllipsoid(5, { 120.0_mm, 24.0_mm, 30.0_mm }),
      { 3.0_mm, 0.0, 29.990623_mm }, { 0, 0, 1 });
  }
  const Eigen::Vector3d outward = Eigen::Vector3d(0.3, 0.2, 1.0).normalized();
  return pressedBody(
    name, makeSphere(50.0_mm, name == "coarse" ? 3 : 5), 50.0_mm * outward, outward);
}

/// A body by its name, made once.
inline PressedBody& bodyOf(const std::string& name)
{
  static std::map<std::string, std::unique_ptr<PressedBody>> made;
  std::unique_ptr<PressedBody>& body = made[name];
  if (!body)
  {
    body = std::make_unique<PressedBody>(madeBody(name));
  }
  return *body;
}

/// The worst that a press, or a row of presses, showed.
struct Worst
{
  double value = -1.0;
  std::string where;

  /// @param position  makes the words for it, which takes longer than all else at most places
  void see(double other, const auto& position)
  {
    if (other > value)
    {
      value = other;
      where = position();
    }
  }
};

struct Findings
{
  Worst rise;   ///< of a place outside the contact while the tool goes down [m]
  Worst jump;   ///< of a place from one press to the next, over what the motion explains [m]
  Worst inside; ///< of the drawn surface in the tool [m]
  Worst wall;   ///< slope of the drawn surface over the steepest of the tool in contact [-]
};

/// One tool, law and picture on one body.
class Presser
{
public:
  /// @param tilt  of the tool's axis from the body's normal [rad]
  Presser(PressedBody& body, const Tip& tip, const std::string& law, const std::string& surface,
    double tilt = 0.0)
    : body_(body)
    , law_(tip, { 50.0_kPa, 0.33 },
        { .mode = law == "paper" ? LawMode::Paper
            : law == "exact"     ? LawMode::Exact
                                 : LawMode::Corrected })
    , extents_(ExtentTable::read(tableOf(tip) + ".csv"))
    , base_(baseRadius(tip))
    , axis_(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) * -body.outward)
  {
    if (surface == "fitted")
    {
      style_.fitted = FittedSurfaces::read(
        tableOf(tip) + "_surface.csv", base_ / (base_ < 8.0_mm ? 6.0_mm : 10.0_mm), base_);
    }
  }

  /// Presses along the body's normal, the axis as at the start.
  void press(double depth, double aside, Findings& findings)
  {
    const Eigen::Vector3d tangent = body_.outward.unitOrthogonal();
    const ToolPose pose{ .apex = body_.position + aside * tangent - depth * body_.outward,
      .axis = axis_ };
    press({ pose }, findings,
      "depth " + std::to_string(depth / base_) + " R, aside " + std::to_string(aside / 1.0_mm) +
        " mm");
  }

  [[nodiscard]] const std::optional<Press>& last() const
  {
    return last_;
  }

private:
  // the shipped table that is nearest to the tool
  static std::string tableOf(const Tip& tip)
  {
    const bool isCone =
      std::holds_alternative<ConeTip>(tip) || std::holds_alternative<BluntConeTip>(tip);
    return std::string(PALP_SOURCE_DIR "/data/tables/") + (isCone ? "cone45_" : "sphere_") +
      (baseRadius(tip) < 8.0_mm ? "r6_h30" : "r10_h50");
  }

  void press(const ToolPose& pose, Findings& findings, const std::string& where)
  {
    Sample sample;
    sample.pose = pose;
    sample.contact = findContact(body_.haptic, law_.tip(), pose, ContactRule::Exact);
    sample.response = law_(contactGeometryOf(sample.contact));
    const Press now =
      pressOf(sample, law_.tip(), extents_.extentRadius(sample.contact.depth), style_);
    body_.surface.press(now);
    const auto here = [&where] { return where; };
    std::vector<double> sinks(body_.surface.count());
    for (std::size_t i = 0; i < sinks.size(); ++i)
    {
      sinks[i] = DentedSurface::at(body_.surface.displacement, i).norm();
      findings.inside.see(insideOf(pose, DentedSurface::at(body_.surface.points, i)), here);
    }
    if (last_)
    {
      compare(now, sample.contact.center, sinks, findings, where);
    }
    lookForWalls(now, findings, where);
    last_ = now;
    center_ = sample.contact.center;
    sinks_ = sinks;
    zones_ = body_.surface.zone;
  }

  // by the profile of the tip, not by what the dent uses
  [[nodiscard]] double insideOf(const ToolPose& pose, const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d from = point - pose.apex;
    const double height = -from.dot(pose.axis);
    const double radius = (from + height * pose.axis).norm();
    return std::min(base_ - radius, height - tipHeight(law_.tip(), radius));
  }

  [[nodiscard]] double fromAxis(const ToolPose& pose, const Eigen::Vector3d& point) const
  {
    return (point - pose.apex).cross(pose.axis).norm();
  }

  // how far the contact went: its frame and its depth
  void compare(const Press& now, const Eigen::Vector3d& center, const std::vector<double>& sinks,
    Findings& findings, const std::string& where) const
  {
    const Contact& a = last_->contact;
    const Contact& b = now.contact;
    const double deeper = b.depth - a.depth;
    const double turn = (b.normal - a.normal).norm();
    const auto across = [&](const Eigen::Vector3d& way)
    { return (way - way.dot(b.normal) * b.normal).norm(); };
    const double aside = across(center - center_) + across(now.pose.apex - last_->pose.apex);
    const double flank = b.tilt > kUpright ? std::max(kSteepest, steepest(now)) : kSteepest;
    for (std::size_t i = 0; i < sinks.size(); ++i)
    {
      const Eigen::Vector3d rest = DentedSurface::at(body_.surface.rest, i);
      const double change = sinks[i] - sinks_[i];
      const double lever = turn * std::min((rest - b.center).norm(), 3.0 * base_);
      const double motion = 1.5 * std::abs(deeper) + flank * (aside + lever);
      const auto here = [&]
      { return where + ", " + std::to_string((rest - b.center).norm() / 1.0_mm) + " mm away"; };
      const bool isContact = body_.surface.zone[i] == 2 || zones_[i] == 2;
      const bool isPassed = isShaft(now, rest, aside);
      if (deeper > 0.0 && !isContact && !(isPassed && aside > 0.1 * deeper))
      {
        findings.rise.see(-change - flank * (aside + lever), here);
      }
      if (!isPassed)
      {
        findings.jump.see(std::abs(change) - motion, here);
      }
    }
  }

  // where the wall that a shaft cuts passes over a point, its whole height may come at once
  [[nodiscard]] bool isShaft(const Press& now, const Eigen::Vector3d& rest, double aside) const
  {
    const double beside = fromAxis(now.pose, rest) - base_;
    const double blurred = std::sqrt(std::max(0.0, now.contact.tilt)) * now.contact.depth;
    const bool isCut = now.fitted ? now.contact.depth > tipHeight(law_.tip(), 0.999 * base_)
                                  : now.contactRadius > 0.999 * base_;
    return isCut && beside > -0.2_mm - aside - blurred && beside < 1.0_mm + aside + blurred;
  }

  // slope of the tool over the surface where it leaves it [-], 1 at least
  [[nodiscard]] double steepest(const Press& now) const
  {
    const double inner = now.fitted ? now.fitted->inner : now.contactRadius;
    double leaving = std::min(inner / 0.9, 0.999 * base_);
    while (std::holds_alternative<ProfileTip>(law_.tip()) && leaving < 0.99 * base_ &&
      tipHeight(law_.tip(), leaving) < now.contact.depth)
    {
      leaving += 0.01 * base_; // it may bend anywhere
    }
    const double slope = std::atan(std::max(1.0, tipSlope(law_.tip(), leaving)));
    // over the body, or over the plane in which it is drawn
    const double drawn = std::acos(std::clamp(-now.pose.axis.dot(now.contact.normal), -1.0, 1.0));
    return std::tan(std::min(slope + std::max(now.contact.tilt, drawn), 89.0_deg));
  }

  void lookForWalls(const Press& now, Findings& findings, const std::string& where) const
  {
    const Dent& dent = body_.surface.dent;
    const PressRegion& region = dent.region();
    if (region.points().empty())
    {
      return;
    }
    const double inner = now.fitted ? now.fitted->inner : now.contactRadius;
    const bool isSurface =
      std::abs(dent.field().surface().height(0.0, 0.0)) < 0.1 * now.contact.depth;
    if (inner > 0.999 * base_ || !isSurface || steepest(now) > kUprightWall)
    {
      return; // a shaft or flank cuts, or the mesh is too coarse to know the surface
    }
    const double h = base_ / 400.0;
    for (const double turns : { 0.1, 0.9, 2.3, 3.4 })
    {
      const Eigen::Vector2d to = directionOf(turns);
      std::optional<std::array<double, 2>> before; // height, drawn height
      for (double r = h; r < region.outer() + 5.0 * h; r += h)
      {
        const double height = dent.field().surface().height(r * to.x(), r * to.y());
        const Eigen::Vector3d point = region.toSurface({ r * to.x(), r * to.y(), height });
        const GeodesicCoordinates position = region.geodesicInFront(point);
        const double sink = dent.sinkAt(position, point).depth;
        const double drawn = height - sink;
        const double atRest = fromAxis(now.pose, point) - base_;
        const double sunk = fromAxis(now.pose, point - sink * region.normal()) - base_;
        const bool isByShaft = std::min(atRest, sunk) < 0.03 * base_ &&
          std::max(atRest, sunk) > -0.03 * base_; // on its way
        if (before && !isByShaft)
        {
          const double own = std::abs(height - (*before)[0]) / h;
          findings.wall.see(std::abs(drawn - (*before)[1]) / h / (steepest(now) + own),
            [&] { return where + ", r " + std::to_string(r / 1.0_mm); });
        }
        before = { height, drawn };
      }
    }
  }

  static constexpr double kSteepest = 5.0;     // [-] of a sphere of 2 R depth: 3.9
  static constexpr double kUpright = 0.1;      // [rad]
  static constexpr double kUprightWall = 50.0; // [-] slope of a flank that stands upright

  PressedBody& body_;
  ForceLaw law_;
  ExtentTable extents_;
  DentStyle style_;
  double base_;
  Eigen::Vector3d axis_; // of the tool, unit
  std::optional<Press> last_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero(); // of the last contact [m]
  std::vector<double> sinks_;
  std::vector<unsigned char> zones_;
};

} // namespace palp::test
