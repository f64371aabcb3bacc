#pragma once

#include "app/input/press_options.h"
#include "app/supports/support_parts.h"
#include "app/supports/support_region.h"
#include "haptics/surface/surface.h"
#include "pipeline/figure/painted_patches.h"

#include <Eigen/Geometry>
#include <QUndoStack>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

class SupportPanel;

/// The supports of the body that is open: what a brush painted and what is typed beside, drawn on
/// its surface. Main thread only.
class SupportPainting
{
public:
  using ReadBehind = std::function<std::optional<FindRegion>(std::function<FindRegion()> read)>;

  /// @param panel, undo  outlive this object, as the renderer does
  /// @param changed      the picture is another
  /// @param behind       reads while the window lives on; none: it was given up
  SupportPainting(vtkRenderer& renderer, SupportPanel& panel, QUndoStack& undo,
    std::function<void()> changed, ReadBehind behind);

  /// Another body, with its supports; what was painted is gone unless it is the same surface.
  /// @param felt    what is felt of it, in the picture
  /// @param source  its file, in a frame of its own, and its supports
  /// @throws Error  as parseSupport
  void open(std::shared_ptr<const Surface> felt, const MeshSource& source);

  [[nodiscard]] SupportPanel& panel() const noexcept
  {
    return panel_;
  }

  /// Draws them, or not, which leaves them as they are.
  void setVisible(bool shown);

  // A stroke of the brush that the panel shows: places after places, then its end, which can be
  // taken back.
  void paint(const std::vector<SurfacePoint>& places);
  void endStroke();

  void clear();

  /// @param supports  as text, blanks between
  /// @throws Error    as parseSupport; those before stay
  void setOthers(const std::string& supports);

  /// Writes what is painted beside an organ file, and gives all supports.
  /// @throws Error  BadValue: there is none; BadFile: cannot be written
  [[nodiscard]] std::vector<std::string> write(const std::filesystem::path& organ) const;

private:
  enum class Held : std::uint8_t
  {
    Bonded,
    Sliding,
    Free
  };
  using Paint = std::vector<Held>; // of each part

  // as of others, and their text
  struct Others
  {
    std::vector<std::string> texts{};
    Paint held{};
  };

  void use(Paint paint);
  void remember(const QString& what, Paint before);
  [[nodiscard]] std::optional<Others> othersOf(const std::vector<std::string>& texts);
  [[nodiscard]] Paint paintOf(const std::vector<std::string>& supports) const;
  void draw();

  SupportPanel& panel_;
  QUndoStack& undo_;
  std::function<void()> changed_;
  ReadBehind behind_;
  PaintedPatches patches_;
  std::shared_ptr<const Surface> felt_{}; // in the picture
  std::shared_ptr<const Surface> file_{}; // the same in the frame of its file
  MeshSource source_{};
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity(); // of its file in the picture
  std::optional<SupportParts> parts_{};                     // of file_
  Paint paint_;
  Others others_;
  std::optional<Paint> before_{}; // a stroke; none: none goes on
  bool isShown_ = false;
};

} // namespace palp
