#pragma once

#include "app/input/press_options.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "pipeline/model/overlay.h"
#include "pipeline/model/reference_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// A surface and where it stands.
struct MeshSource
{
  std::string bundled{}; ///< name of a shipped surface, as in liver; empty: file
  std::filesystem::path file{};
  ImagePart part{};          ///< that is the surface, where the file is an image
  std::string unit = "auto"; ///< of the file's coordinates
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity(); ///< from the file's to the scene's [m]
};

struct ImageSize
{
  int width = 1280;
  int height = 960;
};

/// Curves that can be drawn while or after a press.
enum class Curve
{
  ForceOverTime,
  ForceOverDepth,
  Section,    ///< through the contact: tool, surface, Bezier curve, elements
  Comparison, ///< forces of laws, elements and others over the depth, and their differences
  Extent,     ///< R_d over the depth
};

/// All that a press can be made of, by name: what `run` and `view` take as options and a scene file
/// as JSON. What is not named here is not built.
struct ScenePlan
{
  std::string name{}; ///< for people
  std::vector<MeshSource> meshes{ { .bundled = "liver" } };
  PressOptions press{};
  std::string device = "mouse";
  bool deadMan = false; ///< force only while the first button of the device is held
  bool window = true;   ///< else: a path in simulated time, without servo thread
  bool dent = true;     ///< the surface gives way; needs a calibration
  bool validity = true; ///< each sample is rated by the ten rules
  std::optional<std::vector<Overlay>> overlays{}; ///< none: those that are shown at first
  std::vector<Curve> curves{ Curve::ForceOverTime, Curve::ForceOverDepth };
  std::vector<std::string> plotFiles{ "png" }; ///< endings: png, svg, pdf, csv
  std::vector<ReferenceCurve> references{};    ///< forces [N] over depth [m] to compare with
  bool samples = true;                         ///< exported: samples.csv
  bool deformed = true;                        ///< exported: deformed.vtp
  bool refined = false;                        ///< its dent as fine as in the picture
  bool picture = true;                         ///< exported: press.png
  ImageSize size{};                            ///< of press.png

  [[nodiscard]] bool has(Curve curve) const noexcept
  {
    return std::find(curves.begin(), curves.end(), curve) != curves.end();
  }

  /// Whether anything is made of the samples of a live press.
  [[nodiscard]] bool records() const noexcept
  {
    return !curves.empty();
  }

  /// Whether pictures are made off screen.
  [[nodiscard]] bool draws() const noexcept
  {
    return !window && (picture || !curves.empty());
  }
};

/// The names of the curves in files and options, in the order of Curve.
extern const std::vector<std::string> kCurveNames;

/// Whether a device follows a file: path:FILE or replay:FILE, a path or an exported samples.csv.
[[nodiscard]] bool isScripted(const std::string& device);

/// The file that a scripted device follows.
[[nodiscard]] std::filesystem::path scriptFile(const std::string& device);

/// @throws Error  BadFile
[[nodiscard]] ScriptedPath readScript(const std::string& device);

/// The surface that the options name.
[[nodiscard]] std::vector<MeshSource> meshesOf(const PressOptions& options);

/// Reads WIDTHxHEIGHT in pixels, each 64 to 8192.
///
/// @param what    stands before the message
/// @throws Error  BadValue
[[nodiscard]] ImageSize parseSize(const std::string& text, const std::string& what);

} // namespace palp
