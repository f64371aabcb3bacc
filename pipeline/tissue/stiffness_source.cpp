#include "pipeline/tissue/stiffness_source.h"

#include "haptics/error.h"

namespace palp
{

TissueMap tissueMapOf(const StiffnessSource& source, UnitChoice unit,
  const Eigen::AlignedBox3d& box, const SurfaceDistance& off)
{
  using Kind = StiffnessSource::Kind;
  try
  {
    switch (source.kind)
    {
      case Kind::Labels:
        return mapOfLabels(source.file, unit, source.labels);
      case Kind::Image:
        return mapOfImage(source.file, unit);
      case Kind::Array:
        return mapOfArray(source.file, unit, source.text, box, off);
      case Kind::Formula:
        return mapOfFormula(source.text, box);
      case Kind::Random:
        return mapOfRandom(source.random, box);
      case Kind::None:
        break;
    }
  }
  catch (const Error& error)
  {
    const std::string what = error.what();
    throw Error(error.code(), (what.starts_with("stiffness: ") ? "" : "stiffness: ") + what);
  }
  return {};
}

} // namespace palp
