#include "app/report/organ/solving_course.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/threads/followed_work.h"

#include <cmath>
#include <condition_variable>
#include <utility>

namespace palp::report
{
namespace
{

double secondsOf(std::chrono::steady_clock::duration time)
{
  return std::chrono::duration<double>(time).count();
}

// of a solution, against others: mostly the factorization, whose time grows so with the cells
double workOf(const OrganBody& body, double side)
{
  constexpr double kGrowth = 1.7;
  const Surface& surface = *body.surface;
  const double volume = std::abs(enclosedVolume(surface.points(), surface.triangles()));
  return std::pow(volume / std::pow(side, 3), kGrowth);
}

double workOf(std::span<const OrganBody> bodies, std::span<const double> sides)
{
  double all = 0.0;
  for (const OrganBody& body : bodies)
  {
    for (const double side : sides)
    {
      all += workOf(body, side);
    }
  }
  return all;
}

} // namespace

SolvingCourse::SolvingCourse(std::span<const OrganBody> bodies, std::span<const double> sides,
  std::function<void(double)> tell)
  : tell_(std::move(tell))
  , all_(workOf(bodies, sides))
  , teller_(
      [this](const std::stop_token& finished)
      {
        constexpr auto kOften = std::chrono::milliseconds(250);
        std::condition_variable_any ended;
        std::unique_lock lock(mutex_);
        while (!ended.wait_for(lock, finished, kOften, [&] { return finished.stop_requested(); }))
        {
          show(Clock::now());
        }
      })
{
}

void SolvingCourse::begin(const OrganBody& body, double side)
{
  const std::lock_guard lock(mutex_);
  begun_ = Clock::now();
  done_ += std::exchange(now_, workOf(body, side));
  show(begun_);
}

void SolvingCourse::show(Clock::time_point now) const
{
  constexpr double kGuess = 5.0; // seconds of the first one, of which nothing is known
  const double expected = done_ > 0.0 ? now_ / done_ * secondsOf(begun_ - start_) : kGuess;
  const double part = now_ > 0.0 ? 1.0 - std::exp(-secondsOf(now - begun_) / expected) : 0.0;
  tell_((done_ + part * now_) / all_);
}

std::function<void(double)> tellFollower()
{
  return [work = FollowedWork::ofThisThread()](double part)
  { work != nullptr ? work->tell(part) : void(); };
}

} // namespace palp::report
