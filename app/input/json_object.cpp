#include "app/input/json_object.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace palp
{
namespace
{

const nlohmann::json kEmpty = nlohmann::json::object();

// "[code] parse error at line 3, column 1: syntax error while parsing object key - unexpected '}'"
std::string wordsOf(const std::string& what)
{
  const std::size_t at = what.find(" at line ");
  const std::size_t colon = what.find(": ", std::min(at, what.size()));
  const std::size_t dash = what.find(" - ", std::min(colon, what.size()));
  return shortened(dash == what.npos
      ? what.substr(what.find("] ") + 2)
      : "is no JSON, " + what.substr(at + 4, colon - at - 4) + ": " + what.substr(dash + 3));
}

} // namespace

nlohmann::json parseJson(const std::string& text, const std::string& file)
{
  using Event = nlohmann::json::parse_event_t;
  std::vector<std::set<std::string>> keys; // of the objects that are open
  const auto watch = [&](int, Event event, nlohmann::json& value)
  {
    if (event == Event::object_start)
    {
      keys.emplace_back();
    }
    else if (event == Event::object_end)
    {
      keys.pop_back();
    }
    else if (event == Event::key && !keys.back().insert(value.get<std::string>()).second)
    {
      throw Error(ErrorCode::BadFile,
        file + ": the key " + inQuotes(value.get<std::string>()) +
          " stands twice in one object; keep one");
    }
    return true;
  };
  try
  {
    return nlohmann::json::parse(text, watch);
  }
  catch (const nlohmann::json::exception& error)
  {
    throw Error(ErrorCode::BadFile, file + ": " + wordsOf(error.what()));
  }
}

JsonObject::JsonObject(const nlohmann::json& value, std::string file, std::string path)
  : value_(value)
  , file_(std::move(file))
  , path_(std::move(path))
{
  if (!value_.is_object())
  {
    throw Error(ErrorCode::BadFile,
      file_ + ": " + (path_.empty() ? "/" : path_) + ": must be an object, { ... }");
  }
}

void JsonObject::refuse(const std::string& key, const std::string& what) const
{
  throw Error(ErrorCode::BadFile, file_ + ": " + path_ + "/" + shortened(key) + ": " + what);
}

const nlohmann::json* JsonObject::find(const char* key)
{
  if (std::find(known_.begin(), known_.end(), key) == known_.end())
  {
    known_.emplace_back(key);
  }
  const auto found = value_.find(key);
  return found == value_.end() ? nullptr : &*found;
}

bool JsonObject::has(const char* key)
{
  return find(key) != nullptr;
}

std::string JsonObject::text(const char* key, const std::string& fallback)
{
  const nlohmann::json* value = find(key);
  if (value && !value->is_string())
  {
    refuse(key, "must be a text, \"...\"");
  }
  return value ? value->get<std::string>() : fallback;
}

bool JsonObject::flag(const char* key, bool fallback)
{
  const nlohmann::json* value = find(key);
  if (value && !value->is_boolean())
  {
    refuse(key, "must be true or false");
  }
  return value ? value->get<bool>() : fallback;
}

std::string JsonObject::number(const char* key, const std::string& fallback)
{
  const nlohmann::json* value = find(key);
  if (value && value->is_number())
  {
    return shortest(value->get<double>());
  }
  return text(key, fallback);
}

bool JsonObject::isNumber(const char* key, double value)
{
  const nlohmann::json* found = find(key);
  return found && found->is_number() && found->get<double>() == value;
}

std::vector<std::string> JsonObject::texts(
  const char* key, const std::vector<std::string>& fallback)
{
  const nlohmann::json* value = find(key);
  if (!value)
  {
    return fallback;
  }
  const auto isText = [](const nlohmann::json& entry) { return entry.is_string(); };
  if (!value->is_array() || !std::all_of(value->begin(), value->end(), isText))
  {
    refuse(key, "must be a list of texts, [\"...\", ...]");
  }
  return value->get<std::vector<std::string>>();
}

std::vector<JsonObject> JsonObject::objects(const char* key)
{
  const nlohmann::json* value = find(key);
  std::vector<JsonObject> list;
  if (value && !value->is_array())
  {
    refuse(key, "must be a list of objects, [{ ... }, ...]");
  }
  for (std::size_t i = 0; value && i < value->size(); ++i)
  {
    list.emplace_back((*value)[i], file_, path_ + "/" + key + "/" + std::to_string(i));
  }
  return list;
}

JsonObject JsonObject::object(const char* key)
{
  const nlohmann::json* value = find(key);
  return { value ? *value : kEmpty, file_, path_ + "/" + key };
}

void JsonObject::finish() const
{
  for (const auto& [key, value] : value_.items())
  {
    if (std::find(known_.begin(), known_.end(), key) == known_.end())
    {
      refuse(key, "unknown key; known here: " + listed(known_));
    }
  }
}

std::size_t JsonObject::choice(
  const std::string& key, const std::string& word, const std::vector<std::string>& words) const
{
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
  {
    refuse(key,
      (word.empty() ? "is missing" : inQuotes(word) + " is not known") + "; give " + listed(words));
  }
  return static_cast<std::size_t>(found - words.begin());
}

} // namespace palp
