#include "haptics/material.h"

#include "haptics/error.h"

#include <sstream>

namespace palp
{

Material makeMaterial(double youngModulus, double poissonRatio)
{
  // written so that NaN, too, is refused
  if (!(youngModulus >= 1.0 && youngModulus <= 1e10))
  {
    std::ostringstream text;
    text << "Young's modulus: " << youngModulus << " Pa; give 1 Pa to 10 GPa";
    throw Error(ErrorCode::BadValue, text.str());
  }
  if (!(poissonRatio >= 0.0 && poissonRatio <= 0.5))
  {
    std::ostringstream text;
    text.precision(12);
    text << "Poisson's ratio: " << poissonRatio << "; give 0 to 0.5";
    throw Error(ErrorCode::BadValue, text.str());
  }
  return { .youngModulus = youngModulus, .poissonRatio = poissonRatio };
}

} // namespace palp
