#include "haptics/force/coating.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <string>

namespace palp
{

using namespace units::literals;

void Coatings::add(const Coating& coating)
{
  if (count_ == kMost)
  {
    throw Error(ErrorCode::BadValue,
      "coatings: more than " + std::to_string(kMost) + "; join those of like stiffness");
  }
  if (!(coating.thickness >= 0.01_mm && coating.thickness <= 1.0))
  {
    throw Error(ErrorCode::BadValue,
      "coatings: a thickness of " + std::to_string(units::toMillimetres(coating.thickness)) +
        " mm is out of range; give 0.01 mm to 1 m");
  }
  items_[count_] = { coating.thickness,
    makeMaterial(coating.material.youngModulus, coating.material.poissonRatio) };
  ++count_;
}

double Coatings::thickness() const noexcept
{
  double sum = 0.0;
  for (const Coating& coating : all())
  {
    sum += coating.thickness;
  }
  return sum;
}

} // namespace palp
