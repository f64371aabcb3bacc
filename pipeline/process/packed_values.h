#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace palp
{

// Values as bytes for another process on this machine, and back: false where the bytes end before.

template <typename Value>
void packOne(std::string& bytes, const Value& value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
[[nodiscard]] bool unpackOne(std::string_view& bytes, Value& value)
{
  if (bytes.size() < sizeof value)
  {
    return false;
  }
  std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return true;
}

/// @param values  a vector or a string
template <typename Values>
void packValues(std::string& bytes, const Values& values)
{
  packOne(bytes, values.size());
  bytes.append(reinterpret_cast<const char*>(values.data()),
    values.size() * sizeof(typename Values::value_type));
}

template <typename Values>
[[nodiscard]] bool unpackValues(std::string_view& bytes, Values& values)
{
  constexpr std::size_t size = sizeof(typename Values::value_type);
  std::size_t count = 0;
  if (!unpackOne(bytes, count) || count > bytes.size() / size)
  {
    return false;
  }
  values.resize(count);
  if (count > 0) // an empty vector has no address to copy to
  {
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * size);
  }
  bytes.remove_prefix(count * size);
  return true;
}

/// @param pack  writes one: pack(bytes, item)
template <typename Items, typename Pack>
void packEach(std::string& bytes, const Items& items, Pack pack)
{
  packOne(bytes, items.size());
  for (const auto& item : items)
  {
    pack(bytes, item);
  }
}

/// @param unpack  reads one: unpack(bytes, item)
template <typename Items, typename Unpack>
[[nodiscard]] bool unpackEach(std::string_view& bytes, Items& items, Unpack unpack)
{
  std::size_t count = 0;
  bool read = unpackOne(bytes, count);
  while (read && count-- > 0)
  {
    read = unpack(bytes, items.emplace_back());
  }
  return read;
}

} // namespace palp
