#include "app/organs/support_painting.h"

#include "app/organs/support_panel.h"
#include "app/shell/change.h"
#include "app/supports/support_text.h"
#include "haptics/error.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

namespace palp
{
namespace
{

constexpr std::array kKinds{ "bonded", "sliding" };

// the kind of a text, in the order of the colors
std::size_t kindOf(const std::string& support)
{
  return support.starts_with(kKinds[1]) ? 1 : 0;
}

std::filesystem::path pointsBeside(const std::filesystem::path& organ, const char* kind)
{
  return organ.parent_path() / (organ.stem().string() + "_" + kind + ".csv");
}

std::shared_ptr<const Surface> inFile(
  const std::shared_ptr<const Surface>& felt, const Eigen::Isometry3d& frame)
{
  if (frame.isApprox(Eigen::Isometry3d::Identity()))
  {
    return felt;
  }
  std::vector<Eigen::Vector3d> points(felt->points().begin(), felt->points().end());
  for (Eigen::Vector3d& point : points)
  {
    point = frame.inverse() * point;
  }
  return std::make_shared<const Surface>(
    points, std::vector<Triangle>(felt->triangles().begin(), felt->triangles().end()));
}

} // namespace

SupportPainting::SupportPainting(vtkRenderer& renderer, SupportPanel& panel, QUndoStack& undo,
  std::function<void()> changed, ReadBehind behind)
  : panel_(panel)
  , undo_(undo)
  , changed_(std::move(changed))
  , behind_(std::move(behind))
  , patches_(renderer)
{
}

void SupportPainting::open(std::shared_ptr<const Surface> felt, const MeshSource& source)
{
  before_.reset();
  felt_ = std::move(felt);
  source_ = source;
  frame_ = source.frame();
  file_ = inFile(felt_, frame_);
  parts_.emplace(*file_);
  paint_.assign(parts_->all().size(), Held::Free);
  others_ = { {}, paint_ };
  panel_.showOthers({});
  draw();
  use(paintOf(source.supports));
  std::string typed;
  for (const std::string& support : source.supports)
  {
    pointsOfSupport(support).empty() ? typed.append(typed.empty() ? "" : " ").append(support)
                                     : typed;
  }
  panel_.showOthers(QString::fromStdString(typed));
  setOthers(typed);
}

SupportPainting::Paint SupportPainting::paintOf(const std::vector<std::string>& supports) const
{
  Paint paint(parts_->all().size(), Held::Free);
  for (const std::string& support : supports)
  {
    const std::filesystem::path points = pointsOfSupport(support);
    const std::vector<bool> held =
      points.empty() ? std::vector<bool>{} : readHeldParts(*parts_, points);
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      paint[i] = held[i] ? static_cast<Held>(kindOf(support)) : paint[i];
    }
  }
  return paint;
}

// none: the body is another by now
std::optional<SupportPainting::Others> SupportPainting::othersOf(
  const std::vector<std::string>& texts)
{
  const auto felt = felt_;
  const auto read = [source = source_, texts] { return readRegions(source, texts); };
  const bool isOfLabels = std::ranges::any_of(
    texts, [](const std::string& text) { return !labelOfSupport(text).empty(); });
  const std::optional<FindRegion> find = isOfLabels ? behind_(read) : FindRegion{};
  if (felt_ != felt)
  {
    return std::nullopt;
  }
  if (!find)
  {
    throw Error(ErrorCode::BadValue, "canceled: it rests on what it did before; type it again");
  }
  Others others{ texts, Paint(parts_->all().size(), Held::Free) };
  for (const std::string& text : texts)
  {
    const Support support = parseSupport(text, *file_, *find);
    for (std::size_t i = 0; i < others.held.size(); ++i)
    {
      others.held[i] =
        support.holds(parts_->all()[i].middle) ? static_cast<Held>(kindOf(text)) : others.held[i];
    }
  }
  return others;
}

void SupportPainting::setOthers(const std::string& supports)
{
  std::istringstream words(supports);
  const std::vector<std::string> texts{ std::istream_iterator<std::string>(words), {} };
  if (!parts_ || texts == others_.texts)
  {
    return;
  }
  if (std::optional<Others> others = othersOf(texts))
  {
    others_ = *std::move(others);
    draw();
  }
}

void SupportPainting::setVisible(bool shown)
{
  isShown_ = shown;
  draw();
}

void SupportPainting::paint(const std::vector<SurfacePoint>& places)
{
  if (!parts_ || places.empty())
  {
    return;
  }
  before_ = before_ ? before_ : paint_;
  const Eigen::Isometry3d toFile = frame_.inverse();
  Paint painted = paint_;
  for (const SurfacePoint& place : places)
  {
    const SurfacePoint brush{ toFile * place.position, toFile.linear() * place.normal };
    for (const std::size_t part : parts_->below(brush, panel_.radius()))
    {
      painted[part] = static_cast<Held>(panel_.brush());
    }
  }
  use(std::move(painted));
}

void SupportPainting::endStroke()
{
  if (auto before = std::exchange(before_, std::nullopt); before && *before != paint_)
  {
    remember(SupportPanel::tr("painted support"), *std::move(before));
  }
}

void SupportPainting::clear()
{
  if (std::ranges::any_of(paint_, [](Held held) { return held != Held::Free; }))
  {
    const Paint before = paint_;
    use(Paint(paint_.size(), Held::Free));
    remember(SupportPanel::tr("painted supports"), before);
  }
}

void SupportPainting::remember(const QString& what, Paint before)
{
  const auto putBack = [this, body = felt_](const Paint& paint)
  { return [this, body, paint] { body == felt_ ? use(paint) : void(); }; };
  undo_.push(new Change(what, putBack(before), putBack(paint_)));
}

void SupportPainting::use(Paint paint)
{
  paint_ = std::move(paint);
  draw();
}

void SupportPainting::draw()
{
  std::vector<PaintedPatches::Patch> patches;
  std::array<double, kKinds.size()> areas{};
  for (std::size_t i = 0; i < paint_.size(); ++i)
  {
    const Held held = paint_[i] != Held::Free ? paint_[i] : others_.held[i];
    if (held == Held::Free)
    {
      continue;
    }
    const auto kind = static_cast<std::size_t>(held);
    const SupportParts::Part& part = parts_->all()[i];
    areas.at(kind) += part.area.norm();
    PaintedPatches::Patch& patch = patches.emplace_back(part.corners, kSupportColors.at(kind));
    for (Eigen::Vector3d& corner : patch.corners)
    {
      corner = frame_ * corner;
    }
  }
  panel_.showAreas(areas);
  patches_.show(isShown_ ? std::span<const PaintedPatches::Patch>(patches)
                         : std::span<const PaintedPatches::Patch>{});
  changed_();
}

std::vector<std::string> SupportPainting::write(const std::filesystem::path& organ) const
{
  std::vector<std::string> supports = others_.texts;
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
  {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < paint_.size(); ++i)
    {
      paint_[i] == static_cast<Held>(kind) ? points.push_back(parts_->all()[i].middle) : void();
    }
    if (!points.empty())
    {
      const std::filesystem::path file = pointsBeside(organ, kKinds.at(kind));
      writeHeldPoints(file, points, kKinds.at(kind));
      supports.push_back(std::string(kKinds.at(kind)) + ":points:" + file.string());
    }
  }
  if (supports.empty())
  {
    throw Error(ErrorCode::BadValue,
      "it rests on nothing: paint where it is held, or type a support as posterior");
  }
  return supports;
}

} // namespace palp
