#pragma once

#include "haptics/force/relaxation/contact_rows.h"
#include "haptics/force/relaxation/prony_series.h"

#include <span>

namespace palp
{

/// Tissue that remembers how it was pressed: the rows of an elastic law, each of Maxwell's springs.
///
/// A row is pressed as deep as the tool, or lies where it has recovered to by itself; so the tool
/// loses contact before it is back at the surface, and a dent stays that recovers. The stored
/// energy never grows by more than the work done on it. A tick is predict, any number of
/// questions, settle.
///
/// @source  Ting 1966 in the form of Argatov and Popov 2016; e_i = exp(-dt / tau_i), exact where
/// the
///          depth is linear between ticks
class RelaxingContact
{
public:
  /// Takes time from the tissue.
  ///
  /// @param dt  since the last tick [s]; not above 0 or not finite: none
  /// @realtime  no allocation, no lock, no exception
  void predict(const PronySeries& series, double dt) noexcept;

  /// What the tissue answers to a depth at the end of the tick; grows with it.
  /// @param depth  of the tool below the surface as it was before any press [m]
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] ElasticForce at(const ContactRows& rows, double depth) const noexcept;

  /// Depth of the elastic contact that is as wide as that at a depth at the end of the tick [m].
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double contactDepth(const ContactRows& rows, double depth) const noexcept;

  /// Ends the tick with the tool at a depth.
  /// @realtime  no allocation, no lock, no exception
  void settle(const ContactRows& rows, double depth) noexcept;

  /// Force of each row after settle() [N]; of those that are not named: 0.
  [[nodiscard]] std::span<const double> loads() const noexcept
  {
    return { load_.data(), loaded_ };
  }

  /// Energy in the springs after settle() [J].
  [[nodiscard]] double energy(const ContactRows& rows, const PronySeries& series) const noexcept;

  /// Depth of the surface at the tool's axis after settle() [m]: under the tool, or of the dent
  /// that is left.
  [[nodiscard]] double surfaceDepth() const noexcept
  {
    return surface_[0];
  }

  /// Lets a part of what is remembered go; energy is only lost.
  /// @param kept  0 to 1
  void fade(double kept) noexcept;

private:
  using Row = std::array<double, ContactRows::kCount>;

  Row surface_{};                                 // w, depth of each row [m]
  std::array<Row, PronySeries::kMost> stress_{};  // h_i over k_j, of the spring with a dashpot [m]
  Row free_{};                                    // w at the end of the tick without a tool [m]
  Row load_{};                                    // [N]
  std::array<double, PronySeries::kMost> gain_{}; // of this tick, h_i over what w moves
  std::size_t terms_ = 0;
  double rate_ = 1.0;      // of this tick, df / dw of a row over k_j
  std::size_t used_ = 0;   // rows that have not been at rest for ever
  std::size_t loaded_ = 0; // rows that the tool presses
};

} // namespace palp
