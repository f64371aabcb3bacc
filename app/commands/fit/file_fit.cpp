#include "app/commands/fit/file_fit.h"

#include "calibration/fit/modulus_fit.h"
#include "haptics/units.h"

#include <cmath>
#include <iostream>

namespace palp
{
namespace
{

using fit::Estimate;
using Json = nlohmann::ordered_json;
using units::toMillimeters;

// [Pa] from brain to cartilage and silicones; depths in m or forces in mN end far beyond
constexpr double kSoftest = 50.0;
constexpr double kStiffest = 3e6;

void add(Json& json, const std::string& name, const Estimate& estimate, double unit = 1.0)
{
  json[name] = estimate.value / unit;
  json[name + "_low"] = estimate.low / unit; // null where it is not known
  json[name + "_high"] = estimate.high / unit;
}

Json lawsJson(const fit::ModulusFit& fitted)
{
  Json laws = Json::array();
  for (const fit::LawFit& law : fitted.laws)
  {
    const bool hasModulus = &law.curve.extra != fitted.exponent();
    Json& json = laws.emplace_back();
    json["law"] = law.name;
    json["young_Pa"] = hasModulus ? Json(law.curve.scale.value) : Json();
    json["contact_mm"] = toMillimeters(law.curve.contact.value);
    json["parameters"] = law.parameters;
    json["sum_of_squares_N2"] = law.curve.sumOfSquares;
    json["aic"] = law.aic;
    json["aic_weight"] = law.weight;
  }
  return laws;
}

std::string inWords(const Estimate& estimate, double unit = 1.0)
{
  const auto end = [unit](double value)
  { return std::isinf(value) ? std::string("unknown") : figures::shown(value / unit); };
  return figures::shown(estimate.value / unit) + " (" + end(estimate.low) + " to " +
    end(estimate.high) + ")";
}

} // namespace

Json fitJson(const FileFit& file, const std::filesystem::path& path)
{
  const double mm = units::fromMillimeters(1.0);
  const fit::ModulusFit& fitted = file.curve.fit;
  const fit::LawFit& asked = fitted.asked();
  Json json{ { "curve", path.string() } };
  add(json, "young_Pa", asked.curve.scale);
  add(json, "contact_mm", asked.curve.contact, mm);
  json["exponent"] = nullptr; // of too few rows
  if (const Estimate* exponent = fitted.exponent())
  {
    add(json, "exponent", *exponent);
  }
  if (const auto thickness = fitted.thickness())
  {
    add(json, "thickness_mm", *thickness, mm);
  }
  json["offset_N"] = asked.curve.offset;
  json["noise_N"] = fitted.noise;
  json["durbin_watson"] = fitted.durbinWatson;
  json["rows"] = { { "in_file", file.rowsInFile }, { "first", file.rows.first + 1 },
    { "last", file.rows.first + file.rows.count } };
  json["law"] = asked.name;
  json["best_law"] = fitted.laws[fitted.best].name;
  json["laws"] = lawsJson(fitted);
  json["outside_limits"] = file.outside;
  return json;
}

void tellResult(const FileFit& file)
{
  const double mm = units::fromMillimeters(1.0);
  const fit::ModulusFit& fitted = file.curve.fit;
  std::cout << file.curve.name << ": E " << inWords(fitted.asked().curve.scale, 1e3) << " kPa";
  std::cout << ", contact at " << inWords(fitted.asked().curve.contact, mm) << " mm";
  if (const Estimate* exponent = fitted.exponent())
  {
    std::cout << ", exponent " << inWords(*exponent);
  }
  if (const auto thickness = fitted.thickness())
  {
    std::cout << ", thickness " << inWords(*thickness, mm) << " mm";
  }
  std::cout << "; best explained by the law '" << fitted.laws[fitted.best].name << "'\n";
}

void tellLimits(const FileFit& file, bool searchesOffset)
{
  const auto tell = [&](const std::string& what)
  { std::cerr << "palp: " << file.curve.name << ": " << what << '\n'; };
  const fit::ModulusFit& fitted = file.curve.fit;
  file.note.empty() ? void() : tell(file.note);
  if (file.rows.count < file.rowsInFile)
  {
    tell("rows " + std::to_string(file.rows.first + 1) + " to " +
      std::to_string(file.rows.first + file.rows.count) + " of " + std::to_string(file.rowsInFile) +
      " are the loading; the others are left out");
  }
  const Eigen::VectorXd& depths = file.curve.loading.depths;
  const double contact = fitted.asked().curve.contact.value;
  if (searchesOffset && (depths.array() <= contact).count() < 2)
  {
    tell("no rows before the contact tell the force of no contact, which widens the interval; "
         "--offset 0N where the sensor was set to zero");
  }
  if (depths.minCoeff() - contact > depths.maxCoeff() - depths.minCoeff())
  {
    tell("warning: the contact is far before the first row, so E means nothing; see fit.png");
  }
  if (const double young = fitted.asked().curve.scale.value; young < kSoftest || young > kStiffest)
  {
    tell("warning: no soft tissue has such an E; is depth_mm in mm, and force_N in N?");
  }
  if (fitted.isSystematic)
  {
    tell("what the law '" + fitted.asked().name +
      "' leaves is not noise, so the interval is too narrow; see residuals.png");
  }
  file.outside.empty()
    ? void()
    : tell("at the largest depth the law is outside its limits (" + file.outside + ")");
}

} // namespace palp
