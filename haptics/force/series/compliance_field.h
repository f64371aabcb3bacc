#pragma once

#include "haptics/force/series/organ_motion.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace palp
{

/// What a body adds to the displacement of its own surface at a place, over its contact modulus:
/// a load of F at p + x moves the surface at p + y by F / E* (constant + slope.(x + y)) more than
/// that of a half-space, and by (x'Ax + y'Ay) / 2 more where the body bends.
struct BodyCompliance
{
  double constant = 0.0; ///< E* G0 [1/m]; negative over a near support
  double slope = 0.0;    ///< length of E* b, along the surface [1/m^2]
  double bend = 0.0;     ///< E* tr A [1/m^3]
  double edge = 0.0;     ///< 1/D, one over the distance to the sharp edge that slope is of [1/m];
                         ///< 0: none is near
};

/// How far a place of a body's compliance may be believed.
enum class ComplianceTrust
{
  Known,
  Edge,      ///< a sharp edge is nearer than the cells can tell
  Thin,      ///< the body is thinner there than two cells
  Supported, ///< it is held there
  Unknown,   ///< too little of the surface is around it; taken from its neighbors
};

/// What a body adds to the displacement of its surface at one place, over its contact modulus.
struct PlacedCompliance
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< on the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, of unit length
  double constant = 0.0;                              ///< E* G0 [1/m]
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();    ///< E* b, along the surface [1/m^2]
  double bend = 0.0;                                  ///< E* tr A [1/m^3]
  double edge = 0.0; ///< one over the distance to a sharp edge [1/m]; 0: none near; negative:
                     ///< another one is not much farther on the other side
  ComplianceTrust trust = ComplianceTrust::Known;
};

/// The compliance of a body over its surface, which is known at places all over it.
///
/// Each place tells of its surroundings by its value and twice its slope, which is the gradient of
/// the constant. Beside an edge at a distance D it is as in a wedge: of the constant 2 D times the
/// slope goes as 1/D, and the slope as 1/D^2, up to next to the edge. Between two edges it also
/// tells how the constant is curved. These are blended, twice continuously differentiable along the
/// surface but for the slope where it comes to 0 between two edges.
class ComplianceField
{
public:
  /// A body at a contact.
  struct Local
  {
    BodyCompliance body;
    double doubtful = 0.0; ///< part of what is told here that may not be believed [-]
  };

  /// @param places   spread evenly, no two nearer than the spacing, no gap wider
  /// @param spacing  [m]
  /// @param poisson  of the body that was solved for [-]
  /// @param motion   of the same body, for pictures; null: not known
  /// @param young    modulus that E* is of [Pa]; 0: whatever the tissue has, as in an even body
  ComplianceField(std::span<const PlacedCompliance> places, double spacing, double poisson,
    std::shared_ptr<const OrganMotion> motion = nullptr, double young = 0.0);

  /// Where a body is asked.
  struct Spot
  {
    Eigen::Vector3d center; ///< of a contact, on the surface [m]
    Eigen::Vector3d normal; ///< outward, of unit length
    double height = 0.0;    ///< of what meets the body there, over the center [m]: beside an edge,
                            ///< over which the normal leans, its foot is the nearest of the face
  };

  /// @return    of a half-space where no place is near
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Local at(const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
    double height = 0.0) const noexcept;

  /// At four that are next to each other, in the time of one; what is doubtful is not told.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] std::array<Local, 4> atFour(const std::array<Spot, 4>& spots) const noexcept;

  [[nodiscard]] std::size_t places() const noexcept
  {
    return places_.size();
  }
  [[nodiscard]] double poissonRatio() const noexcept
  {
    return poisson_;
  }
  [[nodiscard]] double youngModulus() const noexcept
  {
    return young_;
  }
  /// What pictures move the surface by; null: not known.
  [[nodiscard]] const std::shared_ptr<const OrganMotion>& motion() const noexcept
  {
    return motion_;
  }

private:
  using Cell = std::array<int, 3>;

  // a place, small enough for the caches
  struct Place
  {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    Eigen::Vector3f gradient;              // of the constant, where no edge is near
    Eigen::Vector3f edge;                  // away from one, of unit length
    std::array<Eigen::Vector3f, 2> curves; // of the constant between two, across each other, by the
                                           // root of its second derivative
    float rest;                            // of the constant, without an edge
    float slope;                           // likewise
    float bend;
    float wedge;  // times D, what an edge adds to the constant
    float beside; // D [m]; 0: no edge is near
    float doubtful;
    bool isBetween; // two edges
  };

  enum Told
  {
    kRest,  // of the constant, without edges
    kSlope, // likewise
    kBend,
    kWedge,    // times D, what edges add to the constant
    kBeside,   // D times the part of places beside an edge
    kDoubtful, // part of places that may not be believed
    kPart,     // of places beside an edge
    kOutward,  // mean of their normals, x, y, z
    kTold = kOutward + 3
  };

  // a column for each spot, added up a row at a time
  template <int kRows, int kSpots>
  using Rows = Eigen::Array<float, kRows, kSpots, kSpots == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

  template <int kSpots>
  using Lanes = Rows<1, kSpots>;

  // spots next to each other
  template <int kSpots>
  struct Around
  {
    explicit Around(const std::array<Spot, kSpots>& spots) noexcept;
    void move(const Rows<3, kSpots>& way) noexcept;

    Eigen::Vector3f origin;  // the first one's center, nearly [m]
    Rows<3, kSpots> centers; // from there
    Rows<3, kSpots> normals;
    Lanes<kSpots> heights;
  };

  // what places tell together
  template <int kSpots>
  using Blend = Rows<kTold, kSpots>;

  // how they lie, beside an edge
  template <int kSpots>
  struct Faces
  {
    Rows<3, kSpots> outward; // along the mean of their normals
    Lanes<kSpots> above;     // mean height of the spot over their planes [m]
    Lanes<kSpots> part;      // of them beside an edge
  };

  struct Range
  {
    std::uint32_t first = 0;
    std::uint32_t last = 0;    // the one behind it
    bool isBesideEdge = false; // one of them
  };

  [[nodiscard]] Cell cellOf(const Eigen::Vector3d& place) const noexcept;
  [[nodiscard]] Range near(const Eigen::Vector3d& place) const noexcept;
  // visit(place, from it to each spot, its weight there); the sum of all weights
  template <int kSpots, typename Visit>
  Lanes<kSpots> forNear(
    const Around<kSpots>& spots, const Range& range, const Visit& visit) const noexcept;
  template <int kSpots>
  [[nodiscard]] Blend<kSpots> blendAt(
    const Around<kSpots>& spots, const Range& range) const noexcept;
  template <int kSpots>
  [[nodiscard]] Faces<kSpots> facesAt(
    const Around<kSpots>& spots, const Range& range) const noexcept;
  template <int kSpots>
  [[nodiscard]] Rows<3, kSpots> toFace(
    const Around<kSpots>& spots, const Faces<kSpots>& faces) const noexcept; // to the foot on it
  template <int kSpots>
  [[nodiscard]] std::array<Local, kSpots> tellAt(
    const std::array<Spot, kSpots>& asked) const noexcept;
  template <int kSpots>
  [[nodiscard]] std::array<Local, kSpots> localsOf(const Blend<kSpots>& told) const noexcept;
  [[nodiscard]] static float constantOf(const Place& place) noexcept;
  void sortIntoCells();
  template <typename Visit>
  void forCellsWithin(const Eigen::Vector3d& position, const Visit& visit); // reach of there
  [[nodiscard]] std::array<Eigen::Vector3f, 2> curvesAt(const Place& place) const;
  void sharpen();

  float reach_;    // of a place [m]
  float perReach_; // one over it
  double cell_;    // side of a cell [m]
  double poisson_;
  double young_;
  std::shared_ptr<const OrganMotion> motion_;
  std::vector<Place> places_;
  std::unordered_map<std::uint64_t, Range> cells_;
  std::vector<std::uint32_t> near_; // places of cell after cell
};

} // namespace palp
