#include "pipeline/formats/dicom/dicom_elements.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/meshes/whole_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <gdcmTransferSyntax.h>
#include <string>
#include <string_view>

namespace palp
{
namespace
{

constexpr std::size_t kPreamble = 128; // [bytes], before the mark
constexpr std::string_view kMark = "DICM";
constexpr std::uint32_t kOpen = 0xffffffff; // length of what a delimiter ends
constexpr std::uint32_t kNoDelimiter = 0xffffffff;
constexpr std::uint32_t kItem = 0xfffee000;
constexpr std::uint32_t kEndOfItem = 0xfffee00d;
constexpr std::uint32_t kEndOfSequence = 0xfffee0dd;
constexpr std::uint32_t kRows = 0x00280010;
constexpr std::uint32_t kPixelData = 0x7fe00010;
constexpr std::uint32_t kSyntax = 0x00020010;
constexpr std::uint32_t kFirstGroup = 0x0004; // of a data set, that of a directory

// kinds of values, those with lengths of four bytes first
constexpr std::array<std::string_view, 34> kKinds{ "OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV",
  "UC", "UN", "UR", "UT", "UV", "AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO",
  "LT", "PN", "SH", "SL", "SS", "ST", "TM", "UI", "UL", "US" };
constexpr std::ptrdiff_t kLongKinds = 13;

constexpr int kDeepest = 32; // sequences in sequences

struct Syntax
{
  bool isExplicit = true;
  bool isBig = false;
};

struct Element
{
  std::uint32_t tag = 0;
  std::string_view kind; // empty: not told
  std::uint32_t length = 0;
  std::size_t begin = 0; // in the file
};

class ElementWalk
{
public:
  explicit ElementWalk(const std::filesystem::path& file)
    : file_(file)
    , bytes_(wholeFile(file))
  {
  }

  bool check()
  {
    if (bytes_.compare(std::min(kPreamble, bytes_.size()), kMark.size(), kMark) != 0)
    {
      return isBare();
    }
    at_ = kPreamble + kMark.size();
    std::string name;
    while (at_ < bytes_.size() && number<std::uint16_t>(at_, {}) == kSyntax >> 16)
    {
      const Element element = readHead(bytes_.size(), {});
      skip(element, bytes_.size());
      name = element.tag == kSyntax ? bytes_.substr(at_ - element.length, element.length) : name;
    }
    if (at_ == bytes_.size())
    {
      refuse(file_, "cut off, nothing follows its first group; export or copy it again");
    }
    const auto end = name.find_last_not_of(std::string_view("\0 ", 2));
    name.resize(end == name.npos ? 0 : end + 1);
    const auto type = gdcm::TransferSyntax::GetTSType(name.c_str());
    if (type == gdcm::TransferSyntax::TS_END)
    {
      refuse(file_,
        name.empty() ? "cut off or damaged, it names no transfer syntax; export or copy it again"
                     : "its transfer syntax " + inQuotes(name) +
            " is none of DICOM's; export it again, uncompressed");
    }
    using gdcm::TransferSyntax;
    const TransferSyntax syntax(type);
    if (type != TransferSyntax::DeflatedExplicitVRLittleEndian)
    {
      walk(bytes_.size(), kNoDelimiter,
        { syntax.GetNegociatedType() == TransferSyntax::Explicit,
          type == TransferSyntax::ExplicitVRBigEndian });
      if (hasRows_ != hasVoxels_)
      {
        refuse(file_,
          std::string(hasRows_ ? "cut off, it has Rows, but no voxels"
                               : "damaged, it has voxels, but no Rows") +
            "; export or copy it again");
      }
    }
    return true;
  }

private:
  // as files were before there was a preamble
  bool isBare()
  {
    try
    {
      walk(bytes_.size(), kNoDelimiter, { .isExplicit = kindAt(4) != kKinds.end() });
      return true;
    }
    catch (const Error&)
    {
      return false;
    }
  }

  [[nodiscard]] decltype(kKinds)::const_iterator kindAt(std::size_t at) const
  {
    return std::ranges::find(kKinds, std::string_view(bytes_).substr(at, 2));
  }

  template <typename Number>
  [[nodiscard]] Number number(std::size_t at, Syntax syntax) const
  {
    if (at > bytes_.size() || bytes_.size() - at < sizeof(Number))
    {
      refuse(file_, "cut off, it ends within an element; export or copy it again");
    }
    Number value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
    {
      const auto byte = static_cast<unsigned char>(bytes_[at + i]);
      const std::size_t place = syntax.isBig ? sizeof value - 1 - i : i;
      value = static_cast<Number>(value | static_cast<Number>(byte) << 8 * place);
    }
    return value;
  }

  [[noreturn]] void refuseAt(const Element& element, const std::string& what) const
  {
    char tag[16];
    std::snprintf(tag, sizeof tag, "(%04x,%04x)", element.tag >> 16, element.tag & 0xffff);
    refuse(file_,
      std::string("cut off or damaged, its element ") + tag + " at byte " +
        std::to_string(element.begin) + ' ' + what + "; export or copy it again");
  }

  Element readHead(std::size_t end, Syntax syntax)
  {
    Element element{ .tag = number<std::uint16_t>(at_, syntax), .kind = {}, .begin = at_ };
    element.tag = element.tag << 16 | number<std::uint16_t>(at_ + 2, syntax);
    at_ += 4;
    bool isLong = true;
    if (syntax.isExplicit && element.tag != kEndOfItem)
    {
      const auto kind = kindAt(at_);
      if (kind == kKinds.end())
      {
        refuseAt(element, "is of no known kind");
      }
      element.kind = *kind;
      isLong = kind - kKinds.begin() < kLongKinds;
      at_ += isLong ? 4 : 2;
    }
    element.length =
      isLong ? number<std::uint32_t>(at_, syntax) : number<std::uint16_t>(at_, syntax);
    at_ += isLong ? 4 : 2;
    if (at_ > end)
    {
      refuseAt(element, "reaches beyond what holds it");
    }
    return element;
  }

  void skip(const Element& element, std::size_t end)
  {
    if (element.length > end - at_)
    {
      refuseAt(element,
        "claims " + std::to_string(element.length) + " bytes, of which there are " +
          std::to_string(end - at_));
    }
    at_ += element.length;
  }

  // elements to an end, or to a delimiter before it
  void walk(std::size_t end, std::uint32_t delimiter, Syntax syntax, int depth = 0)
  {
    while (at_ < end)
    {
      if (hasVoxels_ && bytes_.find_first_not_of('\0', at_) == bytes_.npos)
      {
        return; // filled up, as some archives do
      }
      const Element element = readHead(end, syntax);
      if (element.tag == delimiter)
      {
        return;
      }
      if (element.tag >> 16 < kFirstGroup)
      {
        refuseAt(element, "is none of a data set");
      }
      hasRows_ = hasRows_ || (element.tag == kRows && depth == 0);
      hasVoxels_ = hasVoxels_ || (element.tag >> 16 == kPixelData >> 16 && depth == 0);
      const bool isOpen = element.length == kOpen;
      const bool isPrivate = (element.tag >> 16 & 1) != 0;
      if (element.tag == kPixelData && isOpen)
      {
        readItems(element, end, syntax, depth);
      }
      else if (isOpen || (element.kind == "SQ" && !isPrivate))
      {
        const bool isUnknown = element.kind == "UN"; // which is never explicit
        isOpen && !isUnknown && !element.kind.empty() && element.kind != "SQ"
          ? refuseAt(element, "has no length")
          : readItems(element, end, isUnknown ? Syntax{ .isExplicit = false } : syntax, depth);
      }
      else
      {
        skip(element, end);
      }
    }
    if (delimiter != kNoDelimiter)
    {
      refuse(file_, "cut off, a sequence in it has no end; export or copy it again");
    }
  }

  void readItems(const Element& of, std::size_t end, Syntax syntax, int depth)
  {
    if (depth == kDeepest)
    {
      refuseAt(of, "is in too many others");
    }
    const std::size_t from = at_;
    if (of.length != kOpen)
    {
      skip(of, end);
      end = at_;
      at_ = from;
    }
    while (at_ < end)
    {
      const Element item = readHead(end, { .isExplicit = false, .isBig = syntax.isBig });
      if (item.tag == kEndOfSequence && of.length == kOpen)
      {
        return;
      }
      if (item.tag != kItem)
      {
        refuseAt(item, "stands where an item of a sequence should");
      }
      const std::size_t begin = at_;
      if (item.length != kOpen)
      {
        skip(item, end);
      }
      if (of.tag != kPixelData) // whose items are bytes
      {
        const std::size_t last = item.length == kOpen ? end : at_;
        at_ = begin;
        walk(last, item.length == kOpen ? kEndOfItem : kNoDelimiter, syntax, depth + 1);
      }
    }
    if (of.length == kOpen)
    {
      refuseAt(of, "has no end");
    }
  }

  const std::filesystem::path& file_;
  std::string bytes_;
  std::size_t at_ = 0;
  bool hasRows_ = false;
  bool hasVoxels_ = false;
};

} // namespace

bool checkElements(const std::filesystem::path& file)
{
  std::array<char, kPreamble + kMark.size()> head{};
  std::ifstream(file, std::ios::binary)
    .read(head.data(), static_cast<std::streamsize>(head.size()));
  const std::string_view start(head.data(), head.size());
  constexpr std::string_view kIdentifying("\x08\0", 2); // group, which a file without begins with
  return (start.ends_with(kMark) || start.starts_with(kIdentifying)) && ElementWalk(file).check();
}

} // namespace palp
