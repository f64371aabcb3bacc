#pragma once

#include "app/input/law_options.h"
#include "haptics/contact/find_contact.h"
#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_field.h"
#include "pipeline/process/file_surface.h"
#include "pipeline/surface_io/length_unit.h"
#include "pipeline/tissue/stiffness_source.h"

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace palp
{

/// A surface and where it stands.
struct MeshSource
{
  std::string bundled{}; ///< name of a shipped surface, as in liver; empty: file
  std::filesystem::path file{};
  std::filesystem::path haptic{}; ///< of the same with fewer points, to feel; empty: the file
  ImagePart part{};               ///< that is the surface, where the file is an image
  UnitChoice unit{};              ///< of the file's coordinates
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< in the scene [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero(); ///< about its x, then y, then z [rad]
  std::vector<PlacedNodule> nodules{};                ///< in the file's frame [m]
  StiffnessSource stiffness{};                        ///< likewise
  std::filesystem::path organ{};       ///< how it gives way as a whole, by `palp organ`; empty: not
  std::vector<std::string> supports{}; ///< where it rests, as text; those of the organ file

  /// What is looked at, and what is felt: the same, or of fewer points.
  [[nodiscard]] std::filesystem::path shownFile() const;
  [[nodiscard]] std::filesystem::path feltFile() const;

  /// From the file's coordinates to the scene's [m].
  [[nodiscard]] Eigen::Isometry3d frame() const;

  /// FILE and how it is read; without one the bundled liver, unless it is needed.
  void addTo(CLI::App& command, bool isNeeded = false);
};

/// The organ file of a surface, and where it rests.
void addOrganFile(CLI::App& command, MeshSource& mesh);

/// The tool, and the part of the tissue that a modulus is never told without.
/// @param usual  what holds without the option, for the help; empty: not shown
CLI::Option* addTip(CLI::App& command, Tip& tip, const std::string& usual);
CLI::Option* addPoisson(CLI::App& command, double& poisson);

/// What tissue is pressed with what: the options that every command shares.
struct TissueOptions
{
  Tip tip = SphereTip{ .radius = 0.01 };
  double young = 50e3;   ///< E [Pa]; the paper's, a tumor's
  double poisson = 0.33; ///< nu [-]
  LawOptions options;

  void addTo(CLI::App& command);

  /// The same without the options of the law.
  void addMaterialTo(CLI::App& command);

  /// Takes E and nu of a measured tissue.
  /// @throws Error  BadValue: no such name; BadFile: as shippedTissues
  void take(const std::string& name);

  /// @throws Error  as makeMaterial, LawOptions::settings
  [[nodiscard]] ForceLaw law() const;
};

/// The options that a law comes of.
/// @param rated  as in LawOptions
[[nodiscard]] TissueOptions optionsOf(const ForceLaw& law, bool rated);

/// How the surface around the contact is drawn.
enum class DentSurface
{
  Paper,        ///< the ring of Eq. (8), from the contact that a sphere can have
  PaperLiteral, ///< from r = sqrt(R depth), whatever the depth
  Fitted,       ///< curves fitted to finite elements, scaled to the tool
  None,         ///< it does not give way
};

/// How far and in what shape the surface gives way.
struct DentOptions
{
  DentSurface surface = DentSurface::Paper;
  std::filesystem::path table{}; ///< R_d(depth); empty: the bundled one for the tool
  std::optional<double> layer{}; ///< thickness that R_d is taken for [m]; none: five tool radii
  double threshold = 0.5e-3;     ///< displacement at R_d [m]
};

/// The tissue, how contact is measured, and how the surface gives way.
struct PressOptions
{
  TissueOptions tissue;
  ContactRule contact = ContactRule::Exact;
  double damping = 0.0; ///< b [N s/m]
  DentOptions dent{};

  void addTo(CLI::App& command);
};

/// Their text, for options and scenes alike.
/// @throws Error  BadValue: names the option, what is wrong and how to write it
[[nodiscard]] double parseLayer(const std::string& text);     ///< [m]
[[nodiscard]] double parseThreshold(const std::string& text); ///< [m]
[[nodiscard]] double parseDamping(const std::string& text);   ///< b [N s/m]

} // namespace palp
