#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// Convex profile of revolution through given points.
///
/// Smooth where the points are: a cubic per segment. A point that turns the profile abruptly
/// stays a corner, so that three points make two straight pieces and not a curve.
class Profile
{
public:
  struct Point
  {
    double radius; ///< r [m], the first 0
    double height; ///< f(r) [m] above the apex, the first 0
  };

  /// Reads `radius_mm,height_mm`; lines that begin with # are comments.
  /// @throws Error  BadFile: missing, no such header, or what the
  ///                constructor refuses, with the line
  [[nodiscard]] static Profile read(const std::filesystem::path& file);

  /// @param points   3 to 10,000; radii increasing, heights and slopes never decreasing
  /// @param name     for people: the file
  /// @throws Error  BadValue: names the point
  explicit Profile(std::vector<Point> points, std::string name = {});

  /// @param radius  [m], 0 to baseRadius(); beyond, the base's value
  /// @return        f(r) [m]
  /// @realtime      pure; no allocation, no lock, no exception
  [[nodiscard]] double height(double radius) const noexcept;

  /// @return    f'(r) [-]
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double slope(double radius) const noexcept;

  /// Radius of the shaft [m].
  [[nodiscard]] double baseRadius() const noexcept
  {
    return pieces_.back().end;
  }

  [[nodiscard]] const std::string& name() const noexcept
  {
    return name_;
  }

  /// Radius of the flat at the apex [m]; 0 where there is none.
  [[nodiscard]] double flatRadius() const noexcept;

  /// Radius of the ball that stands for the round end of a profile [m]: r / f'(r) at a quarter of
  /// the base; 0 where it is pointed or flat.
  [[nodiscard]] double noseRadius() const noexcept;

  /// Depth at which the circle of contact on a half-space has this radius.
  ///
  /// @param radius  a [m], 0 to baseRadius()
  /// @return        g(a) = a int_0^a f'(r) / sqrt(a^2 - r^2) dr [m], exact for the cubic pieces
  /// @source        Sneddon 1965; method of dimensionality reduction, Popov and Hess 2015
  [[nodiscard]] double contactDepth(double radius) const noexcept;

  /// So many circles of contact stand for those of all depths.
  static constexpr std::size_t kCircles = 8;

  /// Radius of one of them, the last that of the base [m]; closer at a flat, where a little deeper
  /// is much wider.
  [[nodiscard]] static constexpr double circleRadius(
    double flat, double base, std::size_t circle) noexcept
  {
    const double part = static_cast<double>(circle + 1) / static_cast<double>(kCircles);
    return flat + (base - flat) * part * part;
  }

  /// contactDepth() of each [m]: a servo thread has no time for all points of a file.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] const std::array<double, kCircles>& circleDepths() const noexcept
  {
    return circleDepths_;
  }

private:
  /// f' = c0 + c1 r + c2 r^2 from begin to end.
  struct Piece
  {
    double begin;  // [m]
    double end;    // [m]
    double height; // at begin [m]
    double c0;     // [-]
    double c1;     // [1/m]
    double c2;     // [1/m^2]

    [[nodiscard]] double slope(double r) const noexcept
    {
      return c0 + r * (c1 + r * c2);
    }
  };

  [[nodiscard]] const Piece& pieceAt(double radius) const noexcept;
  void bakeCircles() noexcept;

  std::vector<Piece> pieces_;
  std::array<double, kCircles> circleDepths_{};
  std::string name_;
};

} // namespace palp
