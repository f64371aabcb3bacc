#pragma once

#include <stdexcept>
#include <string>

namespace palp
{

/// What went wrong, for callers that must choose; the text is for people.
enum class ErrorCode
{
  BadFile,    ///< missing, unreadable, or not of the stated format
  BadMesh,    ///< readable, but not a surface the contact search can use
  BadValue,   ///< outside its documented range
  NoDevice,   ///< absent, busy, or not permitted
  NoPicture,  ///< no way to draw here: no display server and no off-screen context
  NoSolution, ///< a computation that could not reach an answer
};

/// The one exception of this project. Thrown while setting up, never while servoing.
///
/// The message is one sentence, "where: what; what to do":
///   "liver.stl: 12 boundary edges; close the surface, or go on with --open"
class Error : public std::runtime_error
{
public:
  Error(ErrorCode code, const std::string& message)
    : std::runtime_error(message)
    , code_(code)
  {
  }

  [[nodiscard]] ErrorCode code() const noexcept
  {
    return code_;
  }

private:
  ErrorCode code_;
};

} // namespace palp
