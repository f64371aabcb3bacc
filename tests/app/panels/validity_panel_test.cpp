#include "app/panels/validity_panel.h"

#include "tests/app/application.h"

#include <array>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(ValidityPanel, TellsEachNoduleInWhatPeopleNotice)
{
  test::application();
  ValidityPanel panel;
  panel.showRules({}, std::array{ 0.14, -0.045, 0.5, -0.5 });
  for (const char* line :
    { "nodule 1: +14.0 % of the force", "2.0 times the 7 %", "0.9 times the 15 %",
      "nodule 2: -4.5 % of the force", "0.1 times the 45 % that people notice of modulus by stylus",
      "1.5 times the 22 % that people notice of compliance",   // a third less
      "4.5 times the 22 % that people notice of compliance" }) // twice as much
  {
    EXPECT_TRUE(panel.text().contains(line)) << line << ": " << panel.text().toStdString();
  }
  panel.showRules({}, std::array{ -0.0003, 0.0004, -0.0 });
  EXPECT_EQ(panel.text().count(": 0.0 % of the force"), 3) << panel.text().toStdString();
  const Rule rule{ "depth", "-", 2.0, 1.0, "too deep" };
  panel.showRules(std::span(&rule, 1));
  EXPECT_FALSE(panel.text().contains("nodule"));
  EXPECT_TRUE(panel.text().contains("depth: 200 % of its limit"));
}

TEST(ValidityPanel, TellsAnErrorOfTheForceInPercentOfIt)
{
  test::application();
  ValidityPanel panel;
  const std::array rules{ Rule{ "force_of_itself", "-", 0.143, 0.07, "more than a hand notices" },
    Rule{ "force_of_maximum", "-", 0.0431, 0.07, "" } };
  panel.showRules(rules);
  EXPECT_TRUE(panel.text().contains("force error: 14 % (limit 7 %)"));
  EXPECT_TRUE(panel.text().contains("error of full scale: 4 % (limit 7 %)"));
}

} // namespace
} // namespace palp
