#include "haptics/force/relaxation/relaxing_contact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{
namespace
{

constexpr double kForgotten = 1e-12; // [m]; a dent less deep is none

} // namespace

void RelaxingContact::predict(const PronySeries& series, double dt) noexcept
{
  const double time = dt > 0.0 && std::isfinite(dt) ? dt : 0.0;
  terms_ = series.all().size();
  std::array<double, PronySeries::kMost> left{};
  double gains = 0.0;
  for (std::size_t i = 0; i < terms_; ++i)
  {
    const auto [fraction, tau] = series.all()[i];
    const double x = time / tau;
    left[i] = std::exp(-x);
    gain_[i] = fraction * (x > 0.0 ? -std::expm1(-x) / x : 1.0);
    gains += gain_[i];
  }
  rate_ = series.lasting() + gains;
  Row& pull = free_; // of what is remembered on the surface, then the surface without a tool
  std::fill_n(pull.begin(), used_, 0.0);
  for (std::size_t i = 0; i < terms_; ++i)
  {
    for (std::size_t j = 0; j < used_; ++j)
    {
      stress_[i][j] *= left[i];
      pull[j] += stress_[i][j];
    }
  }
  for (std::size_t j = 0; j < used_; ++j)
  {
    free_[j] = (gains * surface_[j] - pull[j]) / rate_;
  }
}

ElasticForce RelaxingContact::at(const ContactRows& rows, double depth) const noexcept
{
  constexpr std::size_t kLanes = 4; // sums side by side, none of which waits for another
  static_assert(ContactRows::kCount % kLanes == 0);
  std::array<double, kLanes> force{};
  std::array<double, kLanes> stiffness{};
  // a free row is never above the undeformed surface, so deeper ones are open
  for (std::size_t j = 0; j < ContactRows::kCount && rows.depth[j] < depth; j += kLanes)
  {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
    {
      const double pressed = depth - rows.depth[j + lane] - free_[j + lane];
      const double k = pressed > 0.0 ? rows.stiffness[j + lane] : 0.0;
      force[lane] += k * pressed;
      stiffness[lane] += k;
    }
  }
  return { rate_ * std::reduce(force.begin(), force.end()),
    rate_ * std::reduce(stiffness.begin(), stiffness.end()) };
}

double RelaxingContact::contactDepth(const ContactRows& rows, double depth) const noexcept
{
  const auto gap = [&](std::size_t j) { return rows.depth[j] + free_[j] - depth; };
  std::size_t open = 0;
  for (std::size_t j = 0; j < ContactRows::kCount && rows.depth[j] < depth; ++j)
  {
    open = gap(j) < 0.0 ? j + 1 : open;
  }
  if (open == 0 || open == ContactRows::kCount)
  {
    return open == 0 ? 0.0 : depth;
  }
  const double closed = gap(open - 1);
  const double fraction = closed / (closed - std::max(0.0, gap(open)));
  return rows.depth[open - 1] + fraction * (rows.depth[open] - rows.depth[open - 1]);
}

void RelaxingContact::settle(const ContactRows& rows, double depth) noexcept
{
  loaded_ = 0;
  const auto met =
    std::lower_bound(rows.depth.begin(), rows.depth.end(), depth) - rows.depth.begin();
  const std::size_t count = std::max(used_, static_cast<std::size_t>(met));
  used_ = 0;
  for (std::size_t j = 0; j < count; ++j)
  {
    const double pressed = depth - rows.depth[j] - free_[j];
    const double surface = free_[j] + std::max(0.0, pressed);
    const double moved = surface - surface_[j];
    surface_[j] = surface;
    for (std::size_t i = 0; i < terms_; ++i)
    {
      stress_[i][j] += gain_[i] * moved;
    }
    load_[j] = pressed > 0.0 ? rows.stiffness[j] * rate_ * pressed : 0.0;
    loaded_ = pressed > 0.0 ? j + 1 : loaded_;
    if (surface > kForgotten)
    {
      used_ = j + 1;
    }
    else
    {
      surface_[j] = free_[j] = 0.0; // or it would be kept below every normal number
      for (std::size_t i = 0; i < terms_; ++i)
      {
        stress_[i][j] = 0.0;
      }
    }
  }
}

double RelaxingContact::energy(const ContactRows& rows, const PronySeries& series) const noexcept
{
  double energy = 0.0;
  for (std::size_t j = 0; j < used_; ++j)
  {
    double density = series.lasting() * surface_[j] * surface_[j];
    for (std::size_t i = 0; i < terms_; ++i)
    {
      density += stress_[i][j] * stress_[i][j] / series.all()[i].fraction;
    }
    energy += 0.5 * rows.stiffness[j] * density;
  }
  return energy;
}

void RelaxingContact::fade(double kept) noexcept
{
  const double part = std::clamp(kept, 0.0, 1.0);
  for (std::size_t j = 0; j < used_; ++j)
  {
    surface_[j] *= part;
    free_[j] *= part;
    for (std::size_t i = 0; i < terms_; ++i)
    {
      stress_[i][j] *= part;
    }
  }
}

} // namespace palp
