#include "app/supports/organ_seal.h"

#include "app/program/sha256.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace palp
{
namespace
{

constexpr std::string_view kKey = "# sha256: ";

std::string textOf(const std::filesystem::path& file)
{
  return readText(file, "an organ file");
}

} // namespace

void writeSealed(const std::filesystem::path& file, const OrganTable& table)
{
  writeOrganTable(file, table);
  std::string text = textOf(file);
  const std::string seal = std::string(kKey) + sha256Of(text) + '\n';
  replaceFile(file, text.insert(text.find('\n') + 1, seal));
}

void checkSeal(const std::filesystem::path& file)
{
  std::string text = textOf(file);
  const std::size_t second = text.find('\n') + 1;
  if (!std::string_view(text).substr(second).starts_with(kKey))
  {
    return;
  }
  const std::size_t end = std::min(text.size(), text.find('\n', second));
  const std::string known = text.substr(second + kKey.size(), end - second - kKey.size());
  if (sha256Of(text.erase(second, end + 1 - second)) != known)
  {
    throw Error(ErrorCode::BadFile,
      printable(file.string()) +
        ": is not as palp organ wrote it, by its SHA-256: damaged, or edited; make it again, or "
        "take its line '# sha256:' out to have it as it is");
  }
}

} // namespace palp
