#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace palp
{

/// The JSON that a person wrote, in which no key stands twice in an object: else one of the two
/// values would count in silence.
///
/// @param file    stands before each message
/// @throws Error  BadFile: names line and column, or the key
[[nodiscard]] nlohmann::json parseJson(const std::string& text, const std::string& file);

/// A JSON object that a person wrote, read strictly: a key of another type, or one that nobody
/// asked for, is an error that names file, path and key.
///
/// Ask for every key that may stand there, then call finish().
class JsonObject
{
public:
  /// @param value  outlives this object
  /// @param file   stands before each message
  /// @param path   JSON pointer of the value, empty for the whole document
  /// @throws Error  BadFile: not an object
  JsonObject(const nlohmann::json& value, std::string file, std::string path = "");

  [[nodiscard]] bool has(const char* key);

  // Each gives the fallback where the key is absent; BadFile: another type.

  [[nodiscard]] std::string text(const char* key, const std::string& fallback);
  [[nodiscard]] bool flag(const char* key, bool fallback);
  /// A number, or a text that stands for one, as text.
  [[nodiscard]] std::string number(const char* key, const std::string& fallback);
  /// Whether there is a number of this value; a text is none.
  [[nodiscard]] bool isNumber(const char* key, double value);
  [[nodiscard]] std::vector<std::string> texts(
    const char* key, const std::vector<std::string>& fallback);
  [[nodiscard]] std::vector<JsonObject> objects(const char* key); ///< none where absent
  [[nodiscard]] JsonObject object(const char* key);               ///< empty where absent

  /// @throws Error  BadFile: a key that was not asked for; names the ones that may stand here
  void finish() const;

  /// @throws Error  BadFile: "FILE: PATH/KEY: what"
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

  /// One of several words.
  /// @throws Error  BadFile: lists them
  [[nodiscard]] std::size_t choice(
    const std::string& key, const std::string& word, const std::vector<std::string>& words) const;

private:
  [[nodiscard]] const nlohmann::json* find(const char* key);

  const nlohmann::json& value_;
  std::string file_;
  std::string path_;
  std::vector<std::string> known_;
};

} // namespace palp
