#include "haptics/threads/followed_work.h"

#include "haptics/error.h"

#include <utility>

namespace palp
{
namespace
{

thread_local FollowedWork* gWork = nullptr;

} // namespace

void FollowedWork::begin(std::string what)
{
  const std::lock_guard lock(mutex_);
  step_ = { .what = std::move(what) };
}

void FollowedWork::tell(double done)
{
  const std::lock_guard lock(mutex_);
  step_.done = done;
}

FollowedWork::Step FollowedWork::step() const
{
  const std::lock_guard lock(mutex_);
  return step_;
}

FollowedWork* FollowedWork::ofThisThread() noexcept
{
  return gWork;
}

FollowedWork::OfThread::OfThread(FollowedWork& work) noexcept
{
  gWork = &work;
}

FollowedWork::OfThread::~OfThread()
{
  gWork = nullptr;
}

void checkWanted()
{
  if (gWork != nullptr && !gWork->isWanted())
  {
    throw Error(ErrorCode::NoSolution, "canceled");
  }
}

void tellDone(double done)
{
  checkWanted();
  gWork != nullptr ? gWork->tell(done) : void();
}

} // namespace palp
