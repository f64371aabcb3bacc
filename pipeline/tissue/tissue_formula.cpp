#include "pipeline/tissue/tissue_formula.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>
#include <vtkFunctionParser.h>
#include <vtkObject.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr std::array kNames{ "x", "y", "z", "r" };
constexpr double kSoftest = 1.0; // [Pa], as makeMaterial takes it
constexpr double kStiffest = 1e10;

} // namespace

TissueFormula::TissueFormula(const std::string& text)
  : text_(text)
  , parser_(vtkFunctionParser::New(), [](vtkFunctionParser* parser) { parser->Delete(); })
{
  if (text.find("log(") != std::string::npos) // of which VTK prints that it will go
  {
    throw Error(ErrorCode::BadValue,
      "stiffness: '" + text + "': log is the natural or the decimal logarithm; write ln or log10");
  }
  // those alone that it has: of each that is set VTK counts a global time on, which threads contend
  // for
  for (std::size_t i = 0; i < kNames.size(); ++i)
  {
    const std::string alone = std::string("(^|[^a-zA-Z_])") + kNames[i] + "($|[^a-zA-Z0-9_])";
    if (std::regex_search(text, std::regex(alone)))
    {
      parser_->SetScalarVariableValue(kNames[i], 1.0);
      places_.push_back(i);
    }
  }
  parser_->ReplaceInvalidValuesOn(); // else VTK prints what it finds, in terms that are no number
  // beyond what any term can mend, so that the value is refused and not a term of it made up
  parser_->SetReplacementValue(std::numeric_limits<double>::quiet_NaN());
  parser_->SetFunction(text.c_str());
  int place = -1;
  char* what = nullptr;
  parser_->CheckExpression(place, &what);
  if (text.empty() || what != nullptr)
  {
    throw Error(ErrorCode::BadValue,
      "stiffness: '" + text + "' is no formula" +
        (what != nullptr
            ? " (" + std::string(what) + " at character " + std::to_string(place + 1) + ")"
            : "") +
        "; write one in x, y, z and r in mm whose value is in kPa, as in 6+0.1*z");
  }
}

double TissueFormula::operator()(const Eigen::Vector3d& position) const
{
  const Eigen::Vector3d place = units::toMillimeters(1.0) * position;
  const std::array values{ place.x(), place.y(), place.z(), place.head<2>().norm() };
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    parser_->SetScalarVariableValue(static_cast<int>(i), values[places_[i]]);
  }
  const double value = parser_->GetScalarResult() * 1.0_kPa;
  if (!(value >= kSoftest && value <= kStiffest))
  {
    std::ostringstream what;
    std::isnan(value) ? what << "' is no number"
      : value > 0.0   ? what << "' gives " << units::toKilopascals(value) << " kPa"
                      : what << "' is not above 0 kPa";
    throw Error(ErrorCode::BadValue,
      "stiffness: '" + text_ + what.str() + " at " + units::inMillimeters(position.x()) + ", " +
        units::inMillimeters(position.y()) + ", " + units::inMillimeters(position.z()) +
        "; mend the formula, so that it gives 1 Pa to 10 GPa; its numbers are kPa");
  }
  return value;
}

} // namespace palp
