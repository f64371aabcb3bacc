#include "app/session/sample_readers.h"

#include <span>

namespace palp
{

std::function<std::vector<Sample>()> SampleReaders::of(const Recording& recording, bool grows) const
{
  const std::vector<Sample>& all = recording.samples;
  if (grows && all.capacity() < kKeptWhole) // few, whose memory moves as they grow; see bound()
  {
    return [all] { return all; };
  }
  const std::span<const Sample> samples = all;
  ++*count_;
  const auto leave = [count = count_](const void*)
  {
    --*count;
    count->notify_all();
  };
  const std::shared_ptr<const void> reading(samples.data(), leave);
  return [samples, reading] { return std::vector<Sample>(samples.begin(), samples.end()); };
}

void SampleReaders::wait() const noexcept
{
  for (int now = *count_; now > 0; now = *count_)
  {
    count_->wait(now);
  }
}

} // namespace palp
