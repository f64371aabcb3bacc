#include "pipeline/formats/dicom/character_set.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

struct Name
{
  const char* characterSet;
  const char* stored;
  const char* read;
};

// as DICOM PS3.5 and pydicom's documentation of its character sets print them
constexpr Name kNames[] = {
  // annexes H.3, I.2, J.3, J.4 and K.2
  { "\\ISO 2022 IR 87", "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B",
    "Yamada^Tarou=山田^太郎" },
  { "ISO 2022 IR 13\\ISO 2022 IR 87", "\xd4\xcf\xc0\xde^\xc0\xdb\xb3=\x1b$B;3ED\x1b(J",
    "ﾔﾏﾀﾞ^ﾀﾛｳ=山田" },
  { "\\ISO 2022 IR 149", "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7",
    "Hong^Gildong=洪^吉洞" },
  { "ISO_IR 192", "Wang^XiaoDong=\xe7\x8e\x8b^\xe5\xb0\x8f\xe4\xb8\x9c", "Wang^XiaoDong=王^小东" },
  { "GB18030", "Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab", "Wang^XiaoDong=王^小东" },
  { "\\ISO 2022 IR 58", "Zhang^XiaoDong=\x1b$)A\xd5\xc5^\x1b$)A\xd0\xa1\xb6\xab",
    "Zhang^XiaoDong=张^小东" },
  // pydicom
  { "ISO_IR 144", "\xbb\xee\xda\x63\x65\xdc\xd1\x79\x70\xd3", "Люкceмбypг" },
  { "ISO_IR 126", "\xc4\xe9\xef\xed\xf5\xf3\xe9\xef\xf2", "Διονυσιος" },
  { "ISO_IR 127", "\xe2\xc8\xc7\xe6\xea^\xe4\xe6\xd2\xc7\xd1", "قباني^لنزار" },
  { "ISO_IR 138", "\xf9\xf8\xe5\xef^\xe3\xe1\xe5\xf8\xe4", "שרון^דבורה" },
  { "ISO_IR 100", "Buc^J\xe9r\xf4me", "Buc^Jérôme" },
  { "ISO 2022 IR 6\\ISO 2022 IR 100", "Buc^J\x1b-A\xe9r\xf4me", "Buc^Jérôme" },
  // undeclared, or declared wrongly
  { "",
    "Gr\xf6\xdf"
    "e",
    "Größe" },
  { "ISO_IR 100",
    "Gr\xc3\xb6\xc3\x9f"
    "e",
    "Größe" },
  { "ISO_IR 4711",
    "Gr\xf6\xdf"
    "e",
    "Größe" },
};

TEST(CharacterSet, ReadsWhatTheStandardPrints)
{
  for (const Name& name : kNames)
  {
    EXPECT_EQ(inUtf8(name.stored, name.characterSet), name.read) << name.characterSet;
  }
}

TEST(CharacterSet, ReadsAnythingAsSomeText)
{
  std::string bytes;
  for (int i = 1; i < 2000; ++i)
  {
    bytes += static_cast<char>(i * i % 251 + 1);
    for (const char* set :
      { "", "GB18030", "\\ISO 2022 IR 87", "ISO 2022 IR 13", "\\\\", "ISO_IR 192" })
    {
      const std::string text =
        i % 40 == 0 ? inUtf8(bytes, set) : inUtf8(bytes.substr(bytes.size() - 1), set);
      EXPECT_FALSE(text.empty());
      EXPECT_EQ(inUtf8(text, ""), text); // UTF-8
    }
  }
  EXPECT_EQ(inUtf8("\x1b", "\\ISO 2022 IR 87"), "");
  EXPECT_EQ(inUtf8("", "GB18030"), "");
}

} // namespace
} // namespace palp
