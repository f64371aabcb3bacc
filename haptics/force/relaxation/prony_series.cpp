#include "haptics/force/relaxation/prony_series.h"

#include "haptics/error.h"

#include <string>

namespace palp
{

void PronySeries::add(const PronyTerm& term)
{
  if (count_ == kMost)
  {
    throw Error(ErrorCode::BadValue,
      "more than " + std::to_string(kMost) + " terms; join those of like times");
  }
  if (!(term.fraction > 0.0))
  {
    throw Error(ErrorCode::BadValue,
      "a fraction is not above 0; give the part of the modulus that decays, as in 0.5");
  }
  if (!(term.fraction < lasting()))
  {
    throw Error(ErrorCode::BadValue,
      "the fractions add up to 1 or more, so that nothing of the modulus would last; "
      "give a sum below 1");
  }
  if (!(term.time >= 1e-4 && term.time <= 1e6))
  {
    throw Error(ErrorCode::BadValue, "a time is out of range; give each 0.1ms to 1000000s");
  }
  items_[count_++] = term;
}

double PronySeries::lasting() const noexcept
{
  double lasting = 1.0;
  for (const PronyTerm& term : all())
  {
    lasting -= term.fraction;
  }
  return lasting;
}

} // namespace palp
