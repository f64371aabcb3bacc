#include "app/report/document.h"

#include "calibration/figures/figure_json.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>

namespace palp::report
{

using Json = nlohmann::ordered_json;

std::string fileWord(const std::string& name)
{
  std::string word;
  for (const char c : name)
  {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
    {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    else if (!word.empty() && word.back() != '_')
    {
      word += '_';
    }
  }
  return word;
}

Json toJson(const Section& section)
{
  Json tables = Json::array();
  for (const Table& table : section.tables)
  {
    tables.push_back(figures::toJson(table));
  }
  Json charts = Json::array();
  for (const Figure& figure : section.figures)
  {
    charts.push_back(figures::toJson(figure));
  }
  Json claims = Json::array();
  for (const Claim& claim : section.claims)
  {
    claims.push_back({ claim.of, claim.paper, claim.here, claim.verdict });
  }
  Json pictures = Json::array();
  for (const Picture& picture : section.pictures)
  {
    pictures.push_back({ picture.name, picture.caption, picture.svg });
  }
  return { { "name", section.name }, { "title", section.title }, { "text", section.text },
    { "claims", std::move(claims) }, { "tables", std::move(tables) },
    { "charts", std::move(charts) }, { "pictures", std::move(pictures) } };
}

Section sectionOf(const Json& json)
{
  Section section{ .name = json.at("name"), .title = json.at("title"), .text = json.at("text") };
  for (const Json& picture : json.at("pictures"))
  {
    section.pictures.push_back({ picture.at(0), picture.at(1), picture.at(2) });
  }
  for (const Json& claim : json.at("claims"))
  {
    section.claims.push_back({ claim.at(0), claim.at(1), claim.at(2), claim.at(3) });
  }
  std::ranges::transform(json.at("tables"), std::back_inserter(section.tables), figures::tableOf);
  std::ranges::transform(json.at("charts"), std::back_inserter(section.figures), figures::figureOf);
  return section;
}

} // namespace palp::report
