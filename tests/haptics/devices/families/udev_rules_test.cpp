// The rules that open devices to a user match what the code matches, and nothing else: both are
// read here as text, the way udev reads one.

#include <fnmatch.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace palp
{
namespace
{

const std::string kFolder = std::string(PALP_SOURCE_DIR) + "/haptics/devices/usb/";

std::string textOf(const std::string& name)
{
  std::ifstream file(kFolder + name);
  EXPECT_TRUE(file) << name;
  return { std::istreambuf_iterator<char>(file), {} };
}

struct Rule
{
  std::string subsystem, vendor;
  std::vector<std::string> products; // patterns of a shell
};

std::vector<Rule> rules()
{
  static const std::regex kIds(
    R"re(^SUBSYSTEM=="(\w+)", ATTRS?\{idVendor\}=="(\w+)", ATTRS?\{idProduct\}=="([^"]+)", TAG\+="uaccess"$)re");
  std::istringstream lines(textOf("70-palp.rules"));
  std::vector<Rule> all;
  for (std::string line; std::getline(lines, line);)
  {
    if (std::smatch found; std::regex_match(line, found, kIds))
    {
      Rule rule{ found[1], found[2], {} };
      std::istringstream products(found[3]);
      for (std::string one; std::getline(products, one, '|');)
      {
        rule.products.push_back(one);
      }
      all.push_back(rule);
    }
    else
    {
      EXPECT_TRUE(line.empty() || line[0] == '#' || line.find("KERNELS==") != line.npos) << line;
    }
  }
  return all;
}

bool opens(const std::string& subsystem, const std::string& vendor, const std::string& product)
{
  for (const Rule& rule : rules())
  {
    for (const std::string& pattern : rule.products)
    {
      if (rule.subsystem == subsystem && rule.vendor == vendor &&
        fnmatch(pattern.c_str(), product.c_str(), 0) == 0)
      {
        return true;
      }
    }
  }
  return false;
}

// subsystem, vendor, product; no product where the code goes by usage
using Ids = std::set<std::vector<std::string>>;

Ids idsOfTheCode()
{
  Ids ids;
  const std::string hid = textOf("hid_transport.cpp");
  static const std::regex kKnown(R"re(Known\{ 0x(\w{4}), (?:0|0x(\w{4})),)re");
  for (std::sregex_iterator one(hid.begin(), hid.end(), kKnown), end; one != end; ++one)
  {
    ids.insert({ "hidraw", (*one)[1], (*one)[2] });
  }
  static const std::regex kUsb(R"re(kVendor = 0x(\w{4});[^]*kProduct = 0x(\w{4});)re");
  std::smatch found;
  const std::string usb = textOf("usb_transport.cpp");
  EXPECT_TRUE(std::regex_search(usb, found, kUsb));
  ids.insert({ "usb", found[1], found[2] });
  return ids;
}

TEST(UdevRules, OpenWhatTheCodeMatchesAndNothingElse)
{
  const Ids ids = idsOfTheCode();
  EXPECT_GE(ids.size(), 5U);
  Ids vendors;
  for (const auto& one : ids)
  {
    vendors.insert({ one[0], one[1] });
    if (!one[2].empty())
    {
      EXPECT_TRUE(opens(one[0], one[1], one[2])) << one[1] << ':' << one[2];
    }
  }
  for (const Rule& rule : rules())
  {
    EXPECT_EQ(vendors.erase({ rule.subsystem, rule.vendor }), 1U)
      << rule.vendor << ": in no code, or twice";
    const bool byUsage = ids.contains({ rule.subsystem, rule.vendor, "" });
    for (const std::string& product : rule.products)
    {
      EXPECT_TRUE(byUsage || ids.contains({ rule.subsystem, rule.vendor, product })) << product;
    }
  }
  EXPECT_TRUE(vendors.empty()) << "a vendor of the code has no rule";
}

// products of spacenavd's table of mice, typed again; of what the same vendors make else, none
TEST(UdevRules, OpenEachSixAxisMouseAndNoOtherProductOfItsMaker)
{
  for (const char* product : { "c603", "c605", "c606", "c621", "c623", "c625", "c626", "c627",
         "c628", "c629", "c62b", "c640" })
  {
    EXPECT_TRUE(opens("hidraw", "046d", product)) << product;
  }
  for (const char* product :
    { "c62e", "c62f", "c631", "c632", "c633", "c635", "c636", "c638", "c63a", "c652" })
  {
    EXPECT_TRUE(opens("hidraw", "256f", product)) << product;
  }
  for (const char* product :
    { "c52b", "c31c", "c077", "c62a", "c641" }) // receiver, keyboard, mouse
  {
    EXPECT_FALSE(opens("hidraw", "046d", product)) << product;
  }
  EXPECT_FALSE(opens("hidraw", "0403", "cb48"));
  EXPECT_FALSE(opens("usb", "0403", "6001")); // the same chip in anything else
}

} // namespace
} // namespace palp
