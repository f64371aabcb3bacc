#pragma once

#include "app/input/law_options.h"
#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"
#include "pipeline/process/file_surface.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// What tissue is pressed with what: the options that every command shares, as text with units.
struct TissueOptions
{
  std::string tip = "sphere:10mm";
  std::string young = "50kPa";
  std::string poisson = "0.33";
  LawOptions options;

  void addTo(CLI::App& command);

  /// @throws Error  BadValue: names the option, what is wrong and how to write it
  [[nodiscard]] ForceLaw law() const;
};

/// A body, the tissue, and how contact is measured.
struct PressOptions
{
  std::filesystem::path file; ///< empty: the bundled liver
  std::string unit = "auto";
  std::string level;               ///< value of an image on the surface; empty: none
  std::vector<std::string> labels; ///< or of the regions of a label map
  TissueOptions tissue;
  std::string contact = "exact";
  std::string damping = "0N*s/m";
  std::filesystem::path table;     ///< R_d(depth); empty: the bundled one for the tool
  std::string layer;               ///< thickness that R_d is taken for; empty: five tool radii
  std::string threshold = "0.5mm"; ///< sink at R_d
  std::string surface = "paper";

  void addTo(CLI::App& command);

  /// @throws Error  BadValue
  [[nodiscard]] ImagePart part() const;
  [[nodiscard]] ContactRule rule() const;
  [[nodiscard]] double dampingSi() const;   ///< b [N s/m]
  [[nodiscard]] double layerSi() const;     ///< [m]; where one is given
  [[nodiscard]] double thresholdSi() const; ///< [m]
};

} // namespace palp
