#include "haptics/force/linear/coating.h"

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
    throw Error(
      ErrorCode::BadValue, "coatings: a thickness is out of range; give each 0.01 mm to 1 m");
  }
  try
  {
    (void)makeMaterial(coating.material.youngModulus, coating.material.poissonRatio);
  }
  catch (const Error& error)
  {
    throw Error(error.code(), std::string("coatings: ") + error.what());
  }
  items_[count_++] = coating;
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
