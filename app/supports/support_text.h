#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace palp
{

/// Another region of the image that a body is of.
struct SupportRegion
{
  std::shared_ptr<const Surface> surface; ///< never null
  double reach = 0.0;                     ///< to what it holds [m]
};

/// @param label  value or name
using FindRegion = std::function<SupportRegion(const std::string& label)>;

/// Where a body rests, as text: `KIND:box:X0,Y0,Z0:X1,Y1,Z1` in mm holds it within a box,
/// `KIND:direction:X,Y,Z:ANGLE` where its surface faces a direction within an angle, with nothing
/// of the body before it that way,
/// `KIND:label:N` where it touches another label of its image, and `KIND:points:FILE` where it was
/// painted, see readHeldParts. KIND is `bonded`, or `sliding`, which holds it across the mean of
/// that surface only.
///
/// @param surface  closed; it has to live as long as the result
/// @param find     none: it is of no label map
/// @throws Error   BadValue: names what is wrong, or that it holds nothing of the surface; also as
///                 find and readHeldParts
[[nodiscard]] Support parseSupport(
  const std::string& text, const Surface& surface, const FindRegion& find = {});

/// The file of points of such a text; empty: it has none.
[[nodiscard]] std::filesystem::path pointsOfSupport(const std::string& text);

/// The label of such a text, by value or name; empty: it has none.
[[nodiscard]] std::string labelOfSupport(const std::string& text);

/// The same text with another file of points.
[[nodiscard]] std::string withPoints(const std::string& text, const std::string& file);

/// Supports as an organ file names them, files of points from its folder and by what they hold.
/// @throws Error  BadFile: such a file cannot be read
[[nodiscard]] std::string describeSupports(
  const std::vector<std::string>& supports, const std::filesystem::path& folder);

/// @param described  by an organ file
/// @throws Error     BadFile: it is of others than these; none are given: nothing
void checkSupports(const std::vector<std::string>& supports, const std::filesystem::path& organ,
  const std::string& described);

/// Warns of words as posterior where axes are not known to be those of a patient.
/// @param space  as of spaceOf
void noteAxes(const std::vector<std::string>& supports, const std::string& space,
  std::vector<std::string>& notes);

/// Warns of supports that are given without an organ file.
void noteSupports(const std::vector<std::string>& supports, const std::filesystem::path& organ,
  std::vector<std::string>& notes);

/// The texts again; those files may hold something else by now.
[[nodiscard]] std::vector<std::string> supportsIn(
  const std::string& described, const std::filesystem::path& folder);

} // namespace palp
