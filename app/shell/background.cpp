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

bool Background::run(const Work& work, const std::function<void()>& follow)
{
  constexpr auto kUnseen = 30ms; // less than a picture or two
  constexpr int kEvery = 20;     // [ms]
  constexpr int kNoticed = 15;   // times
  if (wanted_)
  {
    throw Error(ErrorCode::BadValue, "other work goes on; wait for it, or cancel it");
  }
  const auto wanted = std::make_shared<std::atomic<bool>>(true);
  auto result = std::async(std::launch::async, [work, wanted] { work(*wanted); });
  if (!hasEnded(result, kUnseen))
  {
    wanted_ = wanted;
    QEventLoop loop;
    QTimer timer;
    int times = 0;
    QObject::connect(&timer, &QTimer::timeout, &loop,
      [&]
      {
        if (!*wanted || hasEnded(result))
        {
          loop.quit();
        }
        else if (++times >= kNoticed)
        {
          follow();
        }
      });
    timer.start(kEvery);
    loop.exec();
    wanted_.reset();
    *wanted = *wanted && hasEnded(result); // the program may end, too
  }
  std::erase_if(givenUp_, [](const auto& other) { return hasEnded(other); });
  if (!*wanted)
  {
    givenUp_.push_back(std::move(result));
    return false;
  }
  result.get();
  return true;
}

void Background::giveUp() noexcept
{
  if (wanted_)
  {
    *wanted_ = false;
  }
}

} // namespace palp
