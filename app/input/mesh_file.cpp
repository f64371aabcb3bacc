#include "app/input/mesh_file.h"

#include "app/program/sha256.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <span>
#include <sys/stat.h>
#include <system_error>

namespace palp
{

namespace
{

constexpr std::string_view kHash = ", SHA-256 ";

// what follows one of some words and a sign at the beginning of a line, without blanks
std::string fieldIn(
  const std::filesystem::path& file, std::span<const std::string_view> words, char sign)
{
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line);)
  {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t found = line.find(sign);
    const auto isKey = [&](std::string_view word) { return line.starts_with(word); };
    if (found != line.npos && std::ranges::any_of(words, isKey))
    {
      const std::size_t begin = line.find_first_not_of(blanks, found + 1);
      const std::size_t end = line.find_last_not_of(blanks) + 1;
      return begin < end ? line.substr(begin, end - begin) : "";
    }
  }
  return {};
}

// where the voxels of a header are; empty: in the file itself
std::filesystem::path dataBeside(const std::filesystem::path& file)
{
  static constexpr std::array<std::string_view, 1> kMeta{ "ElementDataFile" };
  static constexpr std::array<std::string_view, 2> kNrrd{ "data file", "datafile" };
  const std::string ending = lowered(file.extension().string());
  const std::string name = ending == ".mhd" ? fieldIn(file, kMeta, '=')
    : ending == ".nhdr"                     ? fieldIn(file, kNrrd, ':')
                                            : std::string();
  return name == "LOCAL" || name.empty() ? "" : file.parent_path() / name;
}

} // namespace

std::vector<std::filesystem::path> filesBehind(const std::filesystem::path& file)
{
  std::error_code none; // a pipe would be waited for
  if (std::filesystem::is_directory(file, none))
  {
    std::set<std::filesystem::path> inside; // in the same order everywhere
    for (const auto& entry : std::filesystem::directory_iterator(file, none))
    {
      entry.is_regular_file(none) ? void(inside.insert(entry.path())) : void();
    }
    return { inside.begin(), inside.end() };
  }
  std::vector<std::filesystem::path> files{ file };
  const bool isFile = std::filesystem::is_regular_file(file, none);
  if (auto data = isFile ? dataBeside(file) : std::filesystem::path(); !data.empty())
  {
    files.push_back(std::move(data));
  }
  return files;
}

FileStamps stampsOf(const std::filesystem::path& file)
{
  FileStamps stamps;
  for (const std::filesystem::path& one : filesBehind(file))
  {
    struct stat is = {};
    (void)stat(one.c_str(), &is); // what is missing is like nothing that was there
    stamps.emplace_back(is.st_dev, is.st_ino, is.st_size, is.st_mtim.tv_sec, is.st_mtim.tv_nsec,
      is.st_ctim.tv_sec, is.st_ctim.tv_nsec);
  }
  return stamps;
}

void checkUnchanged(const std::filesystem::path& file, const FileStamps& before)
{
  if (stampsOf(file) != before)
  {
    throw Error(
      ErrorCode::BadFile, printable(file.string()) + ": was changed while it was read; run again");
  }
}

LoadedSurface readUnchanged(
  const std::filesystem::path& file, UnitChoice unit, const ImagePart& part)
{
  const FileStamps before = stampsOf(file);
  try
  {
    return readSurface(file, unit, part);
  }
  catch (const Error&)
  {
    checkUnchanged(file, before);
    throw;
  }
}

MeshFile describeFile(const std::filesystem::path& file)
{
  Sha256 hash;
  for (const std::filesystem::path& one : filesBehind(file))
  {
    if (std::error_code none; std::filesystem::is_other(one, none))
    {
      throw Error(
        ErrorCode::BadFile, one.string() + ": is a pipe or a device, not a file; copy it into one");
    }
    hash.addFile(one);
  }
  const bool isFolder = std::filesystem::is_directory(file);
  const std::filesystem::path name =
    (isFolder ? std::filesystem::canonical(file) : file).filename();
  return { .name = name.string() + (isFolder ? "/" : ""),
    .sha256 = hash.hex(),
    .unit = {},
    .space = {},
    .part = {} };
}

std::string spaceOf(const std::vector<MeshFile>& files)
{
  const auto isLps = [](const MeshFile& file) { return file.space == "LPS" && !file.moved; };
  return !files.empty() && std::ranges::all_of(files, isLps) ? "LPS" : "";
}

std::string describe(const MeshFile& mesh)
{
  std::string part = mesh.part.series.empty() ? "" : ", series " + printable(mesh.part.series);
  part += mesh.part.level ? ", level " + shortest(*mesh.part.level) : "";
  part += mesh.part.band ? ", values " + bandText(*mesh.part.band) : "";
  for (const std::string& label : mesh.part.labels)
  {
    part += ", label " + label;
  }
  return std::string(mesh.name).append(kHash) + mesh.sha256 + ", read in " + mesh.unit +
    ", frame " + (mesh.space.empty() ? "of the file" : mesh.space) +
    (mesh.moved ? ", moved by the scene" : "") + part;
}

std::string identityOf(MeshFile mesh)
{
  mesh.name.clear(); // a copy under another name is the same
  mesh.moved = false;
  return std::string(trimmed(describe(mesh).substr(2)));
}

std::string noteOfPath(std::string_view path, const std::vector<MeshFile>& felt)
{
  std::string other;
  while (path.starts_with('#'))
  {
    const std::string_view line = path.substr(0, path.find('\n'));
    path.remove_prefix(std::min(path.size(), line.size() + 1));
    if (line.starts_with(kFelt) && line.find(kHash) != line.npos)
    {
      if (std::ranges::any_of(
            felt, [&](const MeshFile& mesh) { return line.find(mesh.sha256) != line.npos; }))
      {
        return "";
      }
      other = line.substr(kFelt.size(), line.find(kHash) - kFelt.size());
    }
  }
  return other.empty() ? ""
                       : "the path was recorded on " + printable(other) +
      ", another surface than this; depths and forces are not those of the recording";
}

} // namespace palp
