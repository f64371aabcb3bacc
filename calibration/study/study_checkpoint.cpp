#include "calibration/study/study_files.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>

// what a run goes on from

namespace palp::fem
{
namespace
{

constexpr const char* kCheckpoint = "checkpoint.bin";
constexpr const char* kMagic = "palp checkpoint 2\n";

bool begins(std::istream& in, const std::string& text)
{
  std::string start(text.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in && start == text;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + what + "; start again without --resume");
}

bool has(const std::vector<IndentationStep>& steps, double depth)
{
  return std::ranges::any_of(steps,
    [depth](const IndentationStep& step)
    { return std::abs(step.depth - depth) <= kSameDepth * depth; });
}

// the numbers of both tables down to a depth [m], as they stand in the files
std::string rowsTo(const std::filesystem::path& folder, double depth)
{
  std::string rows;
  for (const char* name : { kTable, kProfiles })
  {
    std::ifstream in(folder / name);
    for (std::string line; std::getline(in, line);)
    {
      char* end = nullptr;
      const double first = std::strtod(line.c_str(), &end); // [mm]
      if (*end == ',' && units::fromMillimeters(first) <= depth * (1.0 + kSameDepth))
      {
        rows += line + '\n';
      }
    }
  }
  return rows;
}

// FNV-1a; against a slip of the hand or the disk, not against intent
std::uint64_t checksumOf(std::string_view bytes)
{
  std::uint64_t sum = 14695981039346656037U;
  for (const char byte : bytes)
  {
    sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return sum;
}

} // namespace

void StudyFiles::save(const Checkpoint& checkpoint, const std::vector<double>& refused) const
{
  std::string payload;
  const auto put = [&payload](const double* values, std::size_t count)
  { payload.append(reinterpret_cast<const char*>(values), count * sizeof(double)); };
  const auto size = static_cast<std::size_t>(checkpoint.displacement.size());
  const std::array head{ static_cast<double>(size), static_cast<double>(refused.size()),
    checkpoint.depth };
  put(head.data(), head.size());
  put(refused.data(), refused.size());
  put(checkpoint.displacement.data(), size);
  const std::uint64_t sum = checksumOf(payload + rowsTo(folder_.path(), checkpoint.depth));
  payload.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  replaceFile(folder_.stage() / kCheckpoint, kMagic + key_ + '\n' + payload);
  folder_.publish();
}

Saved StudyFiles::load() const
{
  Saved saved;
  const auto file = folder_.path() / kCheckpoint;
  std::ifstream in(file, std::ios::binary);
  if (!in)
  {
    return saved;
  }
  if (!begins(in, kMagic + key_ + '\n'))
  {
    refuse(file, "is of another case");
  }
  for (const char* name : { kTable, kProfiles })
  {
    std::ifstream table(folder_.path() / name, std::ios::binary);
    if (!begins(table, header_))
    {
      refuse(folder_.path() / name, "is of another case than the checkpoint beside it");
    }
  }
  const std::string payload{ std::istreambuf_iterator<char>(in), {} };
  std::size_t at = 0;
  const auto get = [&](auto* values, std::size_t count)
  {
    const std::size_t bytes = count * sizeof *values;
    if (payload.size() - at < bytes)
    {
      refuse(file, "is damaged");
    }
    if (bytes > 0) // an empty vector has no address to copy to
    {
      std::memcpy(values, payload.data() + at, bytes);
    }
    at += bytes;
  };
  std::array<double, 3> head{};
  get(head.data(), head.size());
  const std::size_t count = payload.size() / sizeof(double);
  const auto most = static_cast<double>(count); // NaN fails as well
  if (!(head[0] >= 0.0 && head[0] <= most && head[1] >= 0.0 && head[1] <= most))
  {
    refuse(file, "is damaged");
  }
  Checkpoint checkpoint{ .depth = head[2], .displacement = {} };
  checkpoint.displacement.resize(static_cast<Eigen::Index>(head[0]));
  saved.refused.resize(static_cast<std::size_t>(head[1]));
  get(saved.refused.data(), saved.refused.size());
  get(checkpoint.displacement.data(), static_cast<std::size_t>(head[0]));
  const std::string_view summed(payload.data(), at);
  std::uint64_t sum = 0;
  get(&sum, 1);
  if (sum != checksumOf(std::string(summed) + rowsTo(folder_.path(), checkpoint.depth)))
  {
    refuse(file, "does not fit the tables beside it, or one of them was changed");
  }

  // the table may be one depth ahead
  const double deepest = checkpoint.depth * (1.0 + kSameDepth);
  saved.steps = readSteps(folder_.path());
  std::erase_if(saved.steps, [&](const IndentationStep& step) { return step.depth > deepest; });
  if (!has(saved.steps, checkpoint.depth) ||
    std::ranges::any_of(
      saved.steps, [](const IndentationStep& step) { return step.profile.empty(); }))
  {
    refuse(file, "does not fit the tables beside it");
  }
  const auto missing = std::ranges::find_if(study_.depths,
    [&](double depth)
    {
      const bool refused = std::ranges::find(saved.refused, depth) != saved.refused.end();
      return depth < deepest && !refused && !has(saved.steps, depth);
    });
  if (missing != study_.depths.end())
  {
    refuse(
      file, "is past " + shortest(units::toMillimeters(*missing)) + " mm, which the table lacks");
  }
  saved.checkpoint = std::move(checkpoint);
  return saved;
}

} // namespace palp::fem
