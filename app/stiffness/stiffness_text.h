#pragma once

#include "pipeline/tissue/stiffness_source.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace CLI
{
class App;
}

namespace palp
{

struct LawOptions;
struct MeshSource;

/// Reads where a stiffness is from: `labels:FILE:1=healthy_liver,2=40kPa`, `image:FILE`,
/// `array:FILE:NAME`, `formula:6+0.1*z`, `random:0.3:8mm:7`.
/// @throws Error  BadValue: not of this form, a tissue or modulus that is none; names the word
[[nodiscard]] StiffnessSource parseStiffness(
  std::string_view text, std::string_view what = "--stiffness");

/// The text that reads back as the same.
/// @param file  how the file is named there
[[nodiscard]] std::string describeStiffness(const StiffnessSource& source, const std::string& file);

/// The same wherever its file lies, by the SHA-256 of that; empty: none is given.
/// @throws Error  BadFile: the file cannot be read
[[nodiscard]] std::string identityOf(const StiffnessSource& source);

/// @param organ      an organ file
/// @param described  identity of the map that it was made of
/// @throws Error     BadFile: it was made of another map than is named
void checkStiffness(
  const StiffnessSource& named, const std::filesystem::path& organ, const std::string& described);

/// Why a body with a map, or without one, cannot be pressed so; empty: it can.
[[nodiscard]] std::string mapRefusal(const MeshSource& mesh, const LawOptions& law);

/// @throws Error  BadValue: there is such a reason
void checkMap(const MeshSource& mesh, const LawOptions& law);

/// The option of a body.
void addStiffness(CLI::App& command, StiffnessSource& source);

} // namespace palp
