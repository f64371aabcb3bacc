#include "app/bench/bench_sweep.h"

#include "app/program/sha256.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_process.h"
#include "app/sweep/cases/case_record.h"
#include "app/sweep/cases/merge.h"
#include "app/sweep/cases/result_rows.h"
#include "app/sweep/cases/runner.h"
#include "app/sweep/cases/status.h"
#include "app/sweep/plan.h"
#include "haptics/error.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kTools = 10; // of the varied alone

double secondsOf(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// most that this process held so far [MB]
long memory()
{
  rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss * 1024 / 1'000'000;
}

SweepAxis numbered(const std::string& name, const std::string& begin, std::size_t count)
{
  SweepAxis axis{ { name }, {} };
  for (std::size_t i = 1; i <= count; ++i)
  {
    axis.rows.push_back({ begin + std::to_string(i) + (name == "young" ? "kPa" : "mm") });
  }
  return axis;
}

// values that palp takes, so that nothing has to check them
Manifest planned(const fs::path& folder, const Sweep& sweep)
{
  const CommandOptions known{ { "young", "tip", "depth", "element-size" }, {} };
  planSweep(
    sweep, fs::current_path(), known, [](const auto&) {}, folder);
  return Manifest(folder);
}

void simulateResults(Manifest& manifest)
{
  const CaseFolders folders{ manifest.folder() };
  manifest.forEach(
    [&](const PlannedCase& one)
    {
      const fs::path place = folders.result(one.name);
      fs::create_directories(place);
      const std::string table = "depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm\n1,0.1" +
        std::to_string(one.number) + ",2.23606797749979,0.2509334505105813\n";
      std::ofstream(resultTable(place, "force")) << table;
      writeRecord(
        place, { .name = one.name, .seconds = 2.0, .memory = 8e6, .tableSha256 = sha256Of(table) });
      if (!std::ofstream(place / kLogFile))
      {
        refuseFile(place, errno);
      }
    });
}

void reportMany(std::ostream& out, const fs::path& folder, std::size_t count)
{
  const Sweep sweep{ .title = "many",
    .kind = "force",
    .fixed = { { "depth", "1:1:1mm" } },
    .axes = {
      numbered("young", "", (count + kTools - 1) / kTools), numbered("tip", "sphere:", kTools) } };
  const double plan = secondsOf([&] { (void)planned(folder, sweep); });
  Manifest manifest(folder);
  out << "plan of " << sweep.count() << " cases: " << plan << " s, " << memory() << " MB\n";
  out << "simulated in " << secondsOf([&] { simulateResults(manifest); }) << " s\n";
  out << "status: " << secondsOf([&] { (void)statusOf(manifest); }) << " s, " << memory()
      << " MB\n";
  for (const char* name : { "all.csv", "all.vtt" })
  {
    out << "merge into " << name << ": "
        << secondsOf([&] { mergeResults(manifest, {}, folder / name); }) << " s, " << memory()
        << " MB\n";
  }
  std::ptrdiff_t most = 0;
  for (const auto& part : fs::directory_iterator(CaseFolders{ folder }.results()))
  {
    most = std::max(most, std::distance(fs::directory_iterator(part), {}));
  }
  out << "most entries in a folder: " << std::max<std::ptrdiff_t>(most, 4096) << '\n';
}

// the commands of all cases, some at a time, and nothing else
double secondsAlone(Manifest& manifest, unsigned jobs)
{
  const fs::path log = manifest.folder() / "alone.txt";
  unsigned running = 0;
  const auto await = [&]
  {
    int status = 0;
    if (wait(&status) < 0 || status != 0)
    {
      throw Error(ErrorCode::NoSolution, lastWords(log, status));
    }
    --running;
  };
  fs::remove_all(manifest.folder() / "alone");
  return secondsOf(
    [&]
    {
      manifest.forEach(
        [&](const PlannedCase& one)
        {
          const SweepHead& head = manifest.head();
          auto words = caseWords(head.kind, optionsOf(head, one.values), head.flags);
          words.insert(words.begin(), (prefix() / "bin/palp").string());
          if (head.kind == "calibrate")
          {
            words.insert(words.end(),
              { "--no-picture", "--out=" + (manifest.folder() / "alone" / one.name).string() });
          }
          (void)startProcess(words, "/dev/null", log);
          ++running == jobs ? await() : void();
        });
      while (running > 0)
      {
        await();
      }
    });
}

double secondsBy(Manifest& manifest, unsigned jobs)
{
  fs::remove_all(CaseFolders{ manifest.folder() }.results());
  return secondsOf([&] { (void)runCases(manifest, manifest.numbers(), jobs); });
}

// how often one time is in another, over the rounds
struct Ratio
{
  void add(double one, double all)
  {
    least = std::min(least, one / all);
    most = std::max(most, one / all);
    alone += one;
    together += all;
  }

  double least = 1e9;
  double most = 0.0;
  double alone = 0.0;
  double together = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Ratio& ratio)
{
  return out << ratio.alone / ratio.together << " times as fast (" << ratio.least << " to "
             << ratio.most << ')';
}

// in turn, for what else a machine does changes from second to second
void reportSpeedUp(std::ostream& out, Manifest manifest, unsigned rounds)
{
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  Ratio swept;
  Ratio alone;
  for (unsigned round = 0; round < rounds; ++round)
  {
    swept.add(secondsBy(manifest, 1), secondsBy(manifest, cores));
    alone.add(secondsAlone(manifest, 1), secondsAlone(manifest, cores));
  }
  out << manifest.head().count << " calibrations, " << rounds << " times: by " << cores
      << " processes " << swept << " than by one; the same commands without a sweep " << alone
      << '\n';
}

void reportFew(std::ostream& out, const fs::path& folder, const BenchedSweep& how)
{
  Sweep sweep{ .title = "short",
    .kind = "force",
    .fixed = { { "depth", "1:1:1mm" } },
    .axes = { numbered("young", "", how.computed) } };
  Manifest brief = planned(folder / "brief", sweep);
  (void)secondsBy(brief, 1); // the program comes from the disk
  const double alone = secondsAlone(brief, 1);
  const double swept = secondsBy(brief, 1);
  const auto cases = static_cast<double>(how.computed);
  out << how.computed << " forces: " << alone << " s by themselves, " << swept
      << " s as a sweep: " << 1e3 * (swept - alone) / cases << " ms a case\n";
  sweep.kind = "calibrate";
  sweep.axes = { numbered("young", "", how.timed) };
  sweep.fixed = { { "depth", "0.5:1.5:0.5mm" }, { "element-size", "1mm" } };
  reportSpeedUp(out, planned(folder / "longer", sweep), how.rounds);
}

} // namespace

void reportSweep(std::ostream& out, const fs::path& folder, const BenchedSweep& count)
{
  std::error_code failed;
  if (!fs::create_directory(folder, failed))
  {
    throw Error(ErrorCode::BadFile,
      folder.string() + ": is there or cannot be made; give a folder that is new");
  }
  const auto clean = [](const fs::path* made) { fs::remove_all(*made); };
  const std::unique_ptr<const fs::path, decltype(clean)> cleaned(&folder, clean);
  out << std::setprecision(3);
  reportFew(out, folder, count);
  reportMany(out, folder / "many", count.planned);
}

} // namespace palp
