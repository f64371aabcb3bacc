#include "app/press/press_fit.h"

#include "calibration/fit/loading_rows.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/error.h"

namespace palp
{

fit::ModulusFit fitPress(const KeptPress& press)
{
  if (press.isInBody)
  {
    throw Error(ErrorCode::BadValue,
      "of a press with an organ file no E is told from its curve, as the body gave way, too; "
      "export it, and palp fit takes its local_depth_mm");
  }
  std::vector<double> depths;
  std::vector<double> forces;
  for (const CurvePoint& point : press.curve)
  {
    depths.push_back(point.depth);
    forces.push_back(point.force);
  }
  const fit::Rows rows = fit::loadingRows(depths);
  const auto part = [&rows](const std::vector<double>& values) {
    return Eigen::VectorXd::Map(values.data() + rows.first, static_cast<Eigen::Index>(rows.count));
  };
  return fit::fitModulus({ .depths = part(depths), .forces = part(forces) },
    { .tip = press.law.tip(),
      .poissonRatio = press.law.material().poissonRatio,
      .settings = press.law.settings(),
      .place = contactGeometryOf(press.summary.deepest),
      .contact = 0.0,
      .offset = 0.0 });
}

} // namespace palp
