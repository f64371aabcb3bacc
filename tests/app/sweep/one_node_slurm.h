#pragma once

#include "tests/app/commands/victim.h"
#include "tests/support/process.h"

#include <chrono>
#include <memory>
#include <thread>

namespace palp::test
{

/// Slurm with a node of two cores: keys, controller and node as this user, with files and ports of
/// their own beside whatever else of Slurm runs here.
class OneNodeSlurm
{
public:
  /// @param folder  made here
  explicit OneNodeSlurm(const std::filesystem::path& folder)
    : folder_(folder)
  {
    std::filesystem::create_directories(at("state"));
    std::filesystem::create_directories(at("spool"));
    write("slurm.conf", settings());
    write("cgroup.conf", "CgroupPlugin=cgroup/v1\nCgroupMountpoint=/sys/fs/cgroup\n");
    write("key", std::string(1024, 'k'));
    using std::filesystem::perms;
    std::filesystem::permissions(at("key"), perms::owner_read | perms::owner_write);
    keys_ = std::make_unique<Victim>("munged --foreground --force --key-file=" + at("key") +
      " --socket=" + at("socket") + " --log-file=" + at("munged.txt") +
      " --pid-file=" + at("munged.pid") + " --seed-file=" + at("seed"));
    waitFor([&] { return std::filesystem::exists(at("socket")); });
    const std::string inside = "env SLURM_CONF=" + at("slurm.conf") + " ";
    controller_ = std::make_unique<Victim>(inside + "slurmctld -D");
    waitFor([&] { return call("scontrol ping").out.find("is UP") != std::string::npos; });
    // what it asks of control groups is answered by an empty folder, where one may be mounted
    node_ = std::make_unique<Victim>(
      inside + "unshare -m sh -c 'mount -t tmpfs none /sys/fs/cgroup; exec slurmd -D -N palp'");
    ready_ = waitFor([&] { return call("sinfo -h -o %T").out.starts_with("idle"); });
  }

  [[nodiscard]] bool isReady() const
  {
    return ready_;
  }
  [[nodiscard]] std::string log() const
  {
    return readAll(at("munged.txt")) + readAll(at("slurmctld.txt")) + readAll(at("slurmd.txt"));
  }

  /// What a command of it does.
  [[nodiscard]] Finished call(const std::string& command) const
  {
    return runCommand("SLURM_CONF=" + at("slurm.conf") + " " + command);
  }

private:
  [[nodiscard]] std::string at(const std::string& name) const
  {
    return (folder_ / name).string();
  }
  void write(const std::string& name, const std::string& text) const
  {
    std::ofstream(at(name)) << text;
  }

  [[nodiscard]] std::string settings() const
  {
    const int port = 20'000 + 2 * (getpid() % 10'000);
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    const std::string name = host;
    const std::string user = runCommand("id -un").out;
    return "ClusterName=palp\nAuthType=auth/munge\nAuthInfo=socket=" + at("socket") +
      "\nSlurmctldHost=" + name.substr(0, name.find('.')) + "(127.0.0.1)\nSlurmUser=" + user +
      "SlurmdUser=" + user + "SlurmctldPort=" + std::to_string(port) +
      "\nSlurmdPort=" + std::to_string(port + 1) + "\nStateSaveLocation=" + at("state") +
      "\nSlurmdSpoolDir=" + at("spool") + "\nSlurmctldPidFile=" + at("slurmctld.pid") +
      "\nSlurmdPidFile=" + at("slurmd.pid") + "\nSlurmctldLogFile=" + at("slurmctld.txt") +
      "\nSlurmdLogFile=" + at("slurmd.txt") +
      "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
      "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\n"
      "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
      "SchedulerParameters=batch_sched_delay=0,sched_min_interval=0\nReturnToService=2\n"
      "SlurmdParameters=config_overrides\n"
      "NodeName=palp NodeHostname=" +
      name +
      " NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000\n"
      "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n";
  }

  template <typename Ready>
  static bool waitFor(Ready ready)
  {
    for (int i = 0; i < 300; ++i)
    {
      if (ready())
      {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }

  std::filesystem::path folder_;
  std::unique_ptr<Victim> keys_; // ends last
  std::unique_ptr<Victim> controller_;
  std::unique_ptr<Victim> node_;
  bool ready_ = false;
};

} // namespace palp::test
