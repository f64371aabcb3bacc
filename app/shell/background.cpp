#include "app/shell/background.h"

#include "haptics/error.h"

#include <QEventLoop>
#include <QTimer>

#include <chrono>
#include <utility>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

bool hasEnded(const std::future<void>& work, std::chrono::milliseconds patience = 0ms)
{
  return work.wait_for(patience) == std::future_status::ready;
}

} // namespace

bool Background::run(Work work, const Follow& follow)
{
  constexpr auto kUnseen = 8ms; // half a picture, as the window waits for it
  constexpr int kEvery = 20;    // [ms]
  constexpr int kNoticed = 15;  // times
  if (going_)
  {
    throw Error(ErrorCode::BadValue, "other work goes on; wait for it, or cancel it");
  }
  const auto going = std::make_shared<FollowedWork>();
  auto result = std::async(std::launch::async,
    [work = std::move(work), going]
    {
      const FollowedWork::OfThread followed(*going);
      work();
    });
  if (!hasEnded(result, kUnseen))
  {
    going_ = going;
    QEventLoop loop;
    QTimer timer;
    int times = 0;
    QObject::connect(&timer, &QTimer::timeout, &loop,
      [&]
      {
        if (!going->isWanted() || hasEnded(result))
        {
          loop.quit();
        }
        else if (++times >= kNoticed)
        {
          follow(going->step());
        }
      });
    timer.start(kEvery);
    loop.exec();
    going_.reset();
    next();
    hasEnded(result) ? void() : going->giveUp(); // the program may end, too
  }
  std::erase_if(givenUp_, [](const auto& other) { return hasEnded(other); });
  if (!going->isWanted())
  {
    givenUp_.push_back(std::move(result));
    return false;
  }
  result.get();
  return true;
}

void Background::later(Work start)
{
  waiting_.push_back(std::move(start));
  next();
}

void Background::next()
{
  QTimer::singleShot(0, here_.get(),
    [this]
    {
      if (!isBusy() && !waiting_.empty())
      {
        const Work start = std::move(waiting_.front());
        waiting_.pop_front();
        start();
        next();
      }
    });
}

void Background::giveUpAll() noexcept
{
  waiting_.clear();
  giveUp();
}

void Background::giveUp() noexcept
{
  if (going_)
  {
    going_->giveUp();
  }
}

} // namespace palp
