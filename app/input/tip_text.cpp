#include "app/input/tip_text.h"

#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/tip/profile.h"

#include <vector>

namespace palp
{
namespace
{

// reads the numbers of one tool in turn
class Reader
{
public:
  Reader(std::string_view text, std::size_t expected, const char* form)
    : text_(text)
    , parts_(split(text, ':'))
  {
    if (parts_.size() != expected + 1)
    {
      throw Error(ErrorCode::BadValue,
        "--tip: " + inQuotes(text) + " has not the form " + form + "; write it like that");
    }
  }

  double length()
  {
    return parseQuantity(next(), Quantity::Length, where());
  }
  double angle()
  {
    return parseQuantity(next(), Quantity::Angle, where());
  }

private:
  std::string_view next()
  {
    return parts_[++index_];
  }
  [[nodiscard]] std::string where() const
  {
    return "--tip " + std::string(text_);
  }

  std::string_view text_;
  std::vector<std::string_view> parts_;
  std::size_t index_ = 0;
};

Tip parseShape(std::string_view text)
{
  const std::string_view kind = text.substr(0, text.find(':'));
  if (kind == "sphere")
  {
    Reader in(text, 1, "sphere:10mm");
    return SphereTip{ .radius = in.length() };
  }
  if (kind == "cone")
  {
    Reader in(text, 2, "cone:45deg:10mm");
    return ConeTip{ .halfAngle = in.angle(), .baseRadius = in.length() };
  }
  if (kind == "punch")
  {
    Reader in(text, 1, "punch:5mm");
    return PunchTip{ .radius = in.length() };
  }
  if (kind == "truncated-cone")
  {
    Reader in(text, 3, "truncated-cone:45deg:2mm:10mm");
    return TruncatedConeTip{
      .halfAngle = in.angle(), .flatRadius = in.length(), .baseRadius = in.length()
    };
  }
  if (kind == "blunt-cone")
  {
    Reader in(text, 3, "blunt-cone:45deg:0.3mm:10mm");
    return BluntConeTip{
      .halfAngle = in.angle(), .tipRadius = in.length(), .baseRadius = in.length()
    };
  }
  if (kind == "paraboloid")
  {
    Reader in(text, 1, "paraboloid:10mm");
    return ParaboloidTip{ .radius = in.length() };
  }
  if (kind == "profile" && text.size() > kind.size() + 1)
  {
    return ProfileTip{ std::make_shared<const Profile>(
      Profile::read(std::string(text.substr(kind.size() + 1)))) };
  }
  throw Error(ErrorCode::BadValue,
    "--tip: unknown tool " + inQuotes(text) +
      "; expected one of sphere:10mm, cone:45deg:10mm, punch:5mm, truncated-cone:45deg:2mm:10mm, "
      "blunt-cone:45deg:0.3mm:10mm, paraboloid:10mm or profile:FILE.csv");
}

std::string length(double meters)
{
  return ':' + quantityText(meters, Quantity::Length);
}

std::string angle(double radians)
{
  return ':' + quantityText(radians, Quantity::Angle);
}

struct Describe
{
  std::string operator()(const SphereTip& tip) const
  {
    return "sphere" + length(tip.radius);
  }
  std::string operator()(const ConeTip& tip) const
  {
    return "cone" + angle(tip.halfAngle) + length(tip.baseRadius);
  }
  std::string operator()(const PunchTip& tip) const
  {
    return "punch" + length(tip.radius);
  }
  std::string operator()(const TruncatedConeTip& tip) const
  {
    return "truncated-cone" + angle(tip.halfAngle) + length(tip.flatRadius) +
      length(tip.baseRadius);
  }
  std::string operator()(const BluntConeTip& tip) const
  {
    return "blunt-cone" + angle(tip.halfAngle) + length(tip.tipRadius) + length(tip.baseRadius);
  }
  std::string operator()(const ParaboloidTip& tip) const
  {
    return "paraboloid" + length(tip.radius);
  }
  std::string operator()(const ProfileTip& tip) const
  {
    return "profile:" + fileOf(tip).filename().string();
  }
};

} // namespace

Tip parseTip(std::string_view text)
{
  return checkedTip(parseShape(text));
}

std::string describeTip(const Tip& tip)
{
  return std::visit(Describe{}, tip);
}

std::filesystem::path fileOf(const Tip& tip)
{
  const auto* own = std::get_if<ProfileTip>(&tip);
  return own ? own->profile->name() : std::string();
}

} // namespace palp
