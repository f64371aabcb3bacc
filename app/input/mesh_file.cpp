#include "app/input/mesh_file.h"

#include "haptics/files/csv_text.h"
#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nettle/sha2.h>

namespace palp
{

MeshFile describeFile(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  sha256_ctx hash;
  sha256_init(&hash);
  std::array<char, 1 << 16> bytes{};
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0)
  {
    sha256_update(&hash, static_cast<std::size_t>(in.gcount()),
      reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }
  if (!in.eof())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be read; check name and permission");
  }
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&hash, digest.size(), digest.data());
  MeshFile mesh{ .name = file.filename().string(), .sha256 = {}, .unit = {}, .part = {} };
  for (const unsigned byte : digest)
  {
    constexpr const char* kDigits = "0123456789abcdef";
    mesh.sha256.append({ kDigits[byte / 16], kDigits[byte % 16] });
  }
  return mesh;
}

std::string describe(const MeshFile& mesh)
{
  constexpr std::array kPatient{ ".nii", ".nii.gz", ".mha", ".mhd" };
  const bool patient = std::ranges::any_of(
    kPatient, [&](const char* ending) { return mesh.name.ends_with(ending); });
  std::string part = mesh.part.level ? ", level " + shortest(*mesh.part.level) : "";
  for (const double label : mesh.part.labels)
  {
    part += ", label " + shortest(label);
  }
  return mesh.name + ", SHA-256 " + mesh.sha256 + ", read in " + mesh.unit + ", frame " +
    (patient ? "LPS" : "of the file") + (mesh.moved ? ", moved by the scene" : "") +
    part;
}

} // namespace palp
