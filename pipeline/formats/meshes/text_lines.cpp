#include "pipeline/formats/meshes/text_lines.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/whole_file.h"
#include "pipeline/process/child_process.h"

#include <algorithm>

namespace palp
{
namespace
{

constexpr std::string_view kBlanks = " \t\f\v";
constexpr int kTold = 1 << 16; // lines, after each of which it is told how far reading is
constexpr double kRead = 0.6;  // of all the time, about

} // namespace

TextLines::TextLines(const std::filesystem::path& file, char comment)
  : file_(file.string())
  , comment_(comment)
{
  whole_ = wholeFile(file);
  text_ = whole_;
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
  {
    throw Error(
      ErrorCode::BadFile, file_ + ": text in UTF-16; save it as UTF-8 or export the surface again");
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  text_.remove_prefix(text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

bool TextLines::next()
{
  for (rest_ = {}; rest_.empty();)
  {
    if (text_.empty())
    {
      return false;
    }
    if (++line_ % kTold == 0)
    {
      answerProgress(
        kRead * (1.0 - static_cast<double>(text_.size()) / static_cast<double>(whole_.size())));
    }
    const std::size_t end = text_.find_first_of("\r\n");
    ended_ = end != text_.npos;
    rest_ = text_.substr(0, end);
    text_.remove_prefix(std::min(text_.size(), rest_.size() + (ended_ ? 1 : 0)));
    if (ended_ && *(text_.data() - 1) == '\r' && text_.starts_with('\n'))
    {
      text_.remove_prefix(1);
    }
    if (comment_ != 0)
    {
      rest_ = rest_.substr(0, rest_.find(comment_));
    }
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    rest_ = rest_.substr(0, rest_.find_last_not_of(kBlanks) + 1);
  }
  return true;
}

std::string_view TextLines::word() noexcept
{
  const std::string_view text = rest_.substr(0, rest_.find_first_of(kBlanks));
  rest_.remove_prefix(text.size());
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
  return text;
}

void TextLines::refuse(const std::string& what) const
{
  throw Error(
    ErrorCode::BadFile, file_ + ":" + std::to_string(line_) + ": " + what + "; export it again");
}

void TextLines::refuseEnd(const std::string& before) const
{
  throw Error(ErrorCode::BadFile,
    file_ + ": cut off, it ends " + (ended_ ? "after" : "in") + " line " + std::to_string(line_) +
      ", before " + before + "; export or copy it again");
}

void TextLines::refuseWord(std::string_view text, const char* what) const
{
  if (!ended_ && rest_.empty()) // in the last word of the file
  {
    refuseEnd(what);
  }
  refuse(std::string("expected ") + what + (text.empty() ? "" : ", not " + inQuotes(text)));
}

void TextLines::refuseNumber(std::string_view text) const
{
  throw Error(ErrorCode::BadMesh,
    file_ + ":" + std::to_string(line_) + ": " + inQuotes(text) +
      " is not a usable number; repair or export the surface again");
}

} // namespace palp
