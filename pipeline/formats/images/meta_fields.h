#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace palp
{

/// The lines that a MetaImage begins with, "key = value" with or without blanks.
using MetaFields = std::map<std::string, std::string>;

/// All lines to the one that names the data.
///
/// @param end     gets where that line ends [bytes]
/// @throws Error  BadFile: not such lines, cut off, or a key given twice
[[nodiscard]] MetaFields readMetaFields(const std::filesystem::path& file, std::uintmax_t& end);

/// @return        none where the key is missing
/// @throws Error  BadFile: what is no finite number
[[nodiscard]] std::vector<double> numbersOf(
  const std::filesystem::path& file, const MetaFields& fields, const std::string& key);

/// The first of these keys that is there, of three numbers.
///
/// @param values  stay as they are where there is none
/// @return        whether one is there
/// @throws Error  BadFile: not three finite numbers
bool readThree(const std::filesystem::path& file, const MetaFields& fields,
  std::initializer_list<const char*> keys, std::array<double, 3>& values);

[[nodiscard]] bool isTrue(const MetaFields& fields, const char* key);

} // namespace palp
