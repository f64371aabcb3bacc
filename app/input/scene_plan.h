#pragma once

#include "app/input/organ_plan.h"
#include "app/input/press_options.h"
#include "app/input/press_places.h"
#include "haptics/devices/device.h"
#include "pipeline/model/overlay.h"
#include "pipeline/model/reference_curve.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

struct ImageSize
{
  int width = 1280;
  int height = 960;
};

/// Plots that can be drawn while or after a press.
enum class PlotKind
{
  ForceOverTime,
  ForceOverDepth,
  Section,    ///< through the contact: tool, surface, Bezier curve, elements
  Comparison, ///< forces of laws, elements and others over the depth, and their differences
  Extent,     ///< R_d over the depth
};

/// What a movie shows.
enum class MovieKind
{
  Replay,    ///< the recording, from just before the first contact to just after the last
  Turntable, ///< the deepest moment, seen from all around
};

/// What moves the tool.
struct DeviceChoice
{
  enum class Kind
  {
    Mouse,
    Hand,   ///< a simulated arm that follows the mouse and yields to the force
    Script, ///< a path, or an exported samples.csv
    Driver, ///< whatever openDriver knows by the name
  };

  Kind kind = Kind::Mouse;
  std::string name = "mouse";   ///< as parseDevice takes it
  std::filesystem::path file{}; ///< of a script

  [[nodiscard]] bool isScript() const noexcept
  {
    return kind == Kind::Script;
  }
};

/// mouse, hand, path:FILE, replay:FILE, or the name of a driver's device.
[[nodiscard]] DeviceChoice parseDevice(const std::string& name);

/// Whether two hands can have these at once.
/// @throws Error  BadValue: the same hardware, or a second that follows the pointer
void checkHands(const DeviceChoice& first, const DeviceChoice& second);

/// A press of before, which is repeated sample by sample.
struct RecordedPress
{
  std::filesystem::path file{};     ///< samples.csv
  std::string device = "mouse";     ///< that held the tool
  std::vector<std::string> names{}; ///< of its presses, in their order, as far as they have one

  bool operator==(const RecordedPress&) const = default;
};

/// Nodules that a seed hides in a body, to be found by touch.
struct TrainingPlan
{
  std::string level = "easy"; ///< of the curriculum
  std::uint32_t seed = 1;     ///< from which their places follow
  int nodules = 0;            ///< 0: as many as the level has
  /// Outward, of the part that is searched; at first that which a window shows, see PressView.
  Eigen::Vector3d side{ -0.35, -1.0, 0.75 };
  /// Times at which the place that was touched last was marked [s]; none: the search goes on.
  std::optional<std::vector<double>> marks{};

  bool operator==(const TrainingPlan&) const = default;
};

/// From where the body is looked at.
struct CameraPlace
{
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ(); ///< [m]
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();     ///< that it looks at [m]
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();       ///< of the picture, any length

  bool operator==(const CameraPlace&) const = default;
};

/// All that a press can be made of: what `run` and `view` take as options and a scene file as JSON,
/// parsed. What is not named here is not built.
struct ScenePlan
{
  std::string name{};                           ///< for people
  std::vector<std::filesystem::path> sources{}; ///< that it was read from: scene, list of points
  std::vector<MeshSource> meshes{ { .bundled = "liver" } };
  std::vector<OrganPlan> organs{}; ///< one for each mesh, each pressed by itself; none: one body
  PressOptions press{};
  DeviceChoice device{};
  std::optional<DeviceChoice> second{};     ///< of another hand, in a window; none: one hand
  std::optional<PlacedPresses> presses{};   ///< instead of a device
  std::optional<RecordedPress> recording{}; ///< instead of a device
  std::optional<TrainingPlan> training{};   ///< nodules to be found in the only body
  bool chain = false;   ///< through the safety chain of the paper's device, armed; simulated time
  bool deadMan = false; ///< force only while the first button of the device is held
  DevicePlacement placement{ .clutch = 2 }; ///< of this run: its scale and clutch
  double servoPeriod = 0.001; ///< of this run, 250 us to 1 ms; no part of the scene [s]
  bool window = true;         ///< else: a path in simulated time, without servo thread
  bool validity = true;       ///< each sample is rated by the rules of validity
  std::optional<std::vector<Overlay>> overlays{}; ///< none: those that are shown at first
  std::vector<PlotKind> plots{ PlotKind::ForceOverTime, PlotKind::ForceOverDepth };
  std::vector<std::string> plotFiles{ "png" }; ///< endings: png, svg, pdf, csv
  std::vector<ReferenceCurve> references{};    ///< forces [N] over depth [m] to compare with
  std::vector<std::filesystem::path> referenceFiles{}; ///< that they were read from
  bool samples = true;                                 ///< exported: samples.csv
  bool allSamples = false;                             ///< of them also those without contact
  bool deformed = true;                                ///< exported: deformed.vtp
  bool refined = false;                                ///< its dent followed to 0.01 mm
  bool picture = true;                                 ///< exported: press.png
  std::vector<MovieKind> movies{};     ///< exported: those, where a run asks for them
  ImageSize size{};                    ///< of press.png
  std::optional<CameraPlace> camera{}; ///< of the window; none: all of the body is seen

  [[nodiscard]] bool has(PlotKind plot) const noexcept
  {
    return std::find(plots.begin(), plots.end(), plot) != plots.end();
  }

  /// Whether all that moves the tool is known, so that no window is needed.
  [[nodiscard]] bool isKnown() const noexcept
  {
    return device.isScript() || presses || recording;
  }

  /// Whether the surface gives way, which needs a calibration.
  [[nodiscard]] bool dents() const noexcept
  {
    return press.dent.surface != DentSurface::None;
  }

  /// Whether anything is made of the samples of a live press.
  [[nodiscard]] bool records() const noexcept
  {
    return !plots.empty();
  }

  /// Whether pictures are made off screen.
  [[nodiscard]] bool draws() const noexcept
  {
    return !window && (picture || !plots.empty() || !movies.empty());
  }
};

/// The names of the plots in files and options, in the order of PlotKind.
extern const std::vector<std::string> kPlotNames;

extern const std::vector<std::string> kMovieNames; ///< likewise

extern const std::vector<std::string> kOrganRoles; ///< likewise

extern const std::vector<std::string> kPlotEndings; ///< of plotFiles

/// @throws Error  BadFile: there is no such file
void checkExists(const MeshSource& mesh);

/// Reads WIDTHxHEIGHT in pixels, each 64 to 8192.
///
/// @param what    stands before the message
/// @throws Error  BadValue
[[nodiscard]] ImageSize parseSize(const std::string& text, const std::string& what);

} // namespace palp
