#include "app/input/coating_text.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <algorithm>

namespace palp
{
namespace
{

// what stands before the separator, which is taken away with it
std::string_view cut(std::string_view& text, char separator)
{
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

} // namespace

Coatings parseCoatings(std::string_view text, std::string_view what)
{
  Coatings coatings;
  for (bool more = !text.empty(); more;)
  {
    more = text.find(',') != text.npos;
    std::string_view one = cut(text, ',');
    if (std::count(one.begin(), one.end(), ':') != 2)
    {
      throw Error(ErrorCode::BadValue,
        std::string(what) + ": " + inQuotes(one) +
          " has not the form 2mm:200kPa:0.45 (thickness, Young's modulus, Poisson's ratio); write "
          "it like that");
    }
    const double thickness = parseQuantity(cut(one, ':'), Quantity::Length, what);
    const double young = parseQuantity(cut(one, ':'), Quantity::Pressure, what);
    coatings.add({ thickness, { young, parseNumber(one, what) } });
  }
  return coatings;
}

std::string describeCoatings(const Coatings& coatings)
{
  std::string text;
  for (const Coating& coating : coatings.all())
  {
    text += text.empty() ? "" : ",";
    text += quantityText(coating.thickness, Quantity::Length) + ':' +
      quantityText(coating.material.youngModulus, Quantity::Pressure) + ':' +
      shortest(coating.material.poissonRatio);
  }
  return text;
}

} // namespace palp
