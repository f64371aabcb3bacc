#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace palp::test
{

using Random = std::mt19937_64;

/// A single fault whose cause is known.
struct Fault
{
  const char* name;
  /// @return  the damaged file; nothing where this file has no place for such a fault
  std::function<std::optional<std::string>(const std::string& whole, Random&)> make;
  std::string words;   ///< regular expression; a sentence that names the cause has a match of it
  bool refused = true; ///< whether such a file must be refused
  bool packed = false; ///< done to the file as it is stored, not to what it holds
};

/// A kind of file, how it is read, and what may be wrong with it.
struct Fuzzed
{
  std::string file;               ///< its name, with the ending
  std::vector<std::string> whole; ///< files that are read without complaint
  std::vector<Fault> faults;
  /// Runs where a crash is contained; its result goes to take. Null: take gets the file's name.
  std::function<std::string(const std::filesystem::path&)> read;
  /// Runs where nothing may go wrong.
  std::function<void(const std::string&)> take;
  std::function<std::string(const std::string&)> pack{}; ///< of the content, for storing
};

/// One damaged file.
struct Damaged
{
  std::string text;
  const Fault* fault = nullptr; ///< null: several, or of an unknown cause
};

/// The same one for the same number.
[[nodiscard]] Damaged damagedFile(const Fuzzed& kind, int number);

// Faults that several kinds have.

[[nodiscard]] Fault cutOff(std::string words, std::size_t shortest, bool refused = true);

/// One match of a pattern, chosen by chance, becomes another text.
[[nodiscard]] Fault replaced(const char* name, const std::string& pattern, const std::string& by,
  std::string words, bool refused = true);

/// Bytes at a place, chosen by chance among count of them that are a step apart, are overwritten.
[[nodiscard]] Fault overwritten(const char* name, std::size_t at, std::size_t step,
  std::size_t count, const std::string& by, std::string words, bool refused = true);

/// The content of another kind of file under this name.
[[nodiscard]] Fault foreign(const std::string& content, std::string words);

/// As they stand in a file.
inline std::string bytesOf(auto value)
{
  return { reinterpret_cast<const char*>(&value), sizeof value };
}

} // namespace palp::test
