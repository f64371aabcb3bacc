#include "tests/app/sweep/one_node_slurm.h"
#include "tests/app/sweep/sweep_rig.h"

#include <random>

// the real scheduler, which ./tests/run --long installs

namespace palp
{
namespace
{

using test::Finished;
using test::OneNodeSlurm;
using test::Sweeping;

class SlurmSweeping : public Sweeping
{
protected:
  /// The first task of the array in a state, as 12_7; empty: none.
  [[nodiscard]] static std::string taskThat(
    const OneNodeSlurm& slurm, const std::string& job, const std::string& state)
  {
    std::istringstream all(slurm.call("squeue -h -r -o '%i %t/%r' -j " + job).out);
    for (std::string task, now; all >> task >> now;)
    {
      if (now.find(state) != now.npos)
      {
        return task;
      }
    }
    return "";
  }

  /// Ends some tasks in each of the ways in which a cluster does, until no task is left.
  void disturb(const OneNodeSlurm& slurm, const std::string& job)
  {
    while (!slurm.call("squeue -h -j " + job).out.empty())
    {
      const std::string task = taskThat(slurm, job, "R/");
      const bool spared = random_() % 8 != 0 || task.empty() || disturbed_ == kDisturbed;
      if (!spared)
      {
        const int way = disturbed_++ % 3;
        if (way == 0)
        {
          requeued_ += slurm.call("scontrol requeue " + task).code == 0 ? 1 : 0;
        }
        else if (way == 1)
        {
          killed_ += slurm.call("scancel --full --signal=KILL " + task).code == 0 ? 1 : 0;
        }
        else
        {
          killWorker("array", false);
        }
      }
      expectKept();
      // what was requeued would wait two minutes
      if (const std::string late = taskThat(slurm, job, "/BeginTime"); !late.empty())
      {
        (void)slurm.call("scontrol update StartTime=now JobId=" + late);
      }
    }
  }

  void expectKept()
  {
    Results now = results("array");
    for (const auto& [name, text] : before_)
    {
      EXPECT_EQ(now[name], text) << "computed again after it was finished";
    }
    before_ = std::move(now);
  }

  static constexpr int kDisturbed = 30; // or none would ever end
  int disturbed_ = 0;
  int requeued_ = 0;
  int killed_ = 0;
  Results before_;

private:
  std::mt19937 random_{ 1 };
};

TEST_F(SlurmSweeping, KilledAndRequeuedTasksMakeTheSame)
{
  std::filesystem::permissions(folder(), std::filesystem::perms(0755)); // as munge wants it
  const OneNodeSlurm slurm(folder() / "slurm");
  if (!slurm.isReady() && slurm.log().find("cgroup") != std::string::npos)
  {
    GTEST_SKIP() << "nothing may be mounted here\n" << slurm.log();
  }
  ASSERT_TRUE(slurm.isReady()) << "tests/run --long installs it\n" << slurm.log();
  plan("grid.json", "serial");
  ASSERT_EQ(test::sweep("run --jobs 2 " + at("serial")).code, 0);

  countStarts("sleep 0.3"); // else a task ends before it can be killed
  const Finished planned = counted("plan " + at("grid.json") + " " + at("array") + " --slurm");
  ASSERT_EQ(planned.code, 0) << planned.err;
  int submitted = 0;
  while (before_.size() < kCases)
  {
    ASSERT_LT(++submitted, 20);
    const Finished job = slurm.call("PALP_DATA=" PALP_SHARE " PALP_PREFIX=" + folder().string() +
      " sbatch --parsable " + at("array/sweep.sbatch"));
    ASSERT_EQ(job.code, 0) << job.err;
    disturb(slurm, job.out.substr(0, job.out.find('\n')));
    expectKept();
  }
  EXPECT_GT(requeued_, 0);
  EXPECT_GT(killed_, 0);
  std::printf("%d jobs, %d tasks requeued, %d killed, %d starts of %d cases\n", submitted,
    requeued_, killed_, starts(), kCases);
  EXPECT_EQ(merged("array"), merged("serial"));
}

} // namespace
} // namespace palp
