#include "calibration/study/study_files.h"

#include "haptics/error.h"
#include "haptics/files/checksum.h"
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

// the numbers of a checkpoint, one after another
class Numbers
{
public:
  Numbers(const std::string& payload, std::filesystem::path file)
    : payload_(payload)
    , file_(std::move(file))
  {
  }

  void get(auto* values, std::size_t count)
  {
    const std::size_t bytes = count * sizeof *values;
    if (payload_.size() - at_ < bytes)
    {
      refuse(file_, "is damaged");
    }
    if (bytes > 0) // an empty vector has no address to copy to
    {
      std::memcpy(values, payload_.data() + at_, bytes);
    }
    at_ += bytes;
  }

  // a count that the file has room for
  [[nodiscard]] std::size_t count(double value) const
  {
    const std::size_t most = payload_.size() / sizeof(double);
    if (!(value >= 0.0 && value <= static_cast<double>(most))) // NaN fails as well
    {
      refuse(file_, "is damaged");
    }
    return static_cast<std::size_t>(value);
  }

  [[nodiscard]] std::string_view taken() const
  {
    return std::string_view(payload_).substr(0, at_);
  }

private:
  const std::string& payload_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
};

void readCheckpoint(Numbers& numbers, Saved& saved)
{
  std::array<double, 3> head{};
  numbers.get(head.data(), head.size());
  Checkpoint& checkpoint = saved.checkpoint.emplace();
  checkpoint.displacement.resize(static_cast<Eigen::Index>(numbers.count(head[0])));
  saved.refused.resize(numbers.count(head[1]));
  checkpoint.depth = head[2];
  numbers.get(saved.refused.data(), saved.refused.size());
  numbers.get(checkpoint.displacement.data(), numbers.count(head[0]));
}

// every depth down to the checkpoint's has its row and its profile
void expectComplete(
  const Saved& saved, const std::vector<double>& depths, const std::filesystem::path& file)
{
  const double deepest = saved.checkpoint->depth * (1.0 + kSameDepth);
  if (!has(saved.steps, saved.checkpoint->depth) ||
    std::ranges::any_of(
      saved.steps, [](const IndentationStep& step) { return step.profile.empty(); }))
  {
    refuse(file, "does not fit the tables beside it");
  }
  const auto missing = std::ranges::find_if(depths,
    [&](double depth)
    {
      const bool refused = std::ranges::find(saved.refused, depth) != saved.refused.end();
      return depth < deepest && !refused && !has(saved.steps, depth);
    });
  if (missing != depths.end())
  {
    refuse(
      file, "is past " + shortest(units::toMillimeters(*missing)) + " mm, which the table lacks");
  }
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
    refuse(file, in ? "is of another case" : "is cut off");
  }
  for (const char* name : { kTable, kProfiles })
  {
    std::ifstream table(folder_.path() / name, std::ios::binary);
    std::string named; // the first line, which names the case as the folder was called
    std::getline(table, named);
    if (!begins(table, header_.substr(header_.find('\n') + 1)))
    {
      refuse(folder_.path() / name, "is of another case than the checkpoint beside it");
    }
  }
  const std::string payload{ std::istreambuf_iterator<char>(in), {} };
  Numbers numbers(payload, file);
  readCheckpoint(numbers, saved);
  const std::string summed(numbers.taken());
  std::uint64_t sum = 0;
  numbers.get(&sum, 1);
  if (sum != checksumOf(summed + rowsTo(folder_.path(), saved.checkpoint->depth)))
  {
    refuse(file, "does not fit the tables beside it, or one of them was changed");
  }
  // the table may be one depth ahead
  const double deepest = saved.checkpoint->depth * (1.0 + kSameDepth);
  saved.steps = readSteps(folder_.path());
  std::erase_if(saved.steps, [&](const IndentationStep& step) { return step.depth > deepest; });
  expectComplete(saved, study_.depths, file);
  return saved;
}

} // namespace palp::fem
