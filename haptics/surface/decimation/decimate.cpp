#include "haptics/surface/decimation/decimate.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/decimation/half_edges.h"
#include "haptics/surface/decimation/planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

using HalfEdge = HalfEdges::HalfedgeHandle;
using Vertex = HalfEdges::VertexHandle;

// twice the area, along the normal
OpenMesh::Vec3d areaOf(const OpenMesh::Vec3d& a, const OpenMesh::Vec3d& b, const OpenMesh::Vec3d& c)
{
  return (b - a) % (c - a);
}

// Takes points away along edges, the cheapest first, in rounds: in each only such as no other of
// the round is next to.
class Decimation
{
public:
  Decimation(HalfEdges& mesh, double error)
    : mesh_(mesh)
    , squaredError_(error * error)
    , left_(mesh.n_vertices())
    , known_(left_)
    , costs_(mesh.n_halfedges())
    , vertices_(mesh.vertices_begin(), mesh.vertices_end())
  {
    for (const HalfEdges::FaceHandle face : mesh.faces())
    {
      std::array<Vertex, 3> corners;
      std::ranges::copy(mesh.fv_range(face), corners.begin());
      const OpenMesh::Vec3d& on = mesh.point(corners[0]);
      OpenMesh::Vec3d normal = areaOf(on, mesh.point(corners[1]), mesh.point(corners[2]));
      const double area = normal.norm();
      if (!(area > 0.0))
      {
        continue;
      }
      normal /= area;
      for (const Vertex corner : corners)
      {
        known(corner).planes.add(Eigen::Vector3d(normal.data()), -(normal | on), area);
        known(corner).area += area;
      }
    }
    for (const HalfEdges::EdgeHandle edge : mesh.edges())
    {
      evaluate(mesh.halfedge_handle(edge, 0));
    }
  }

  void downTo(std::size_t count)
  {
    constexpr std::size_t kSlow = 500; // points for one that can still be taken away
    std::size_t taken = left_;
    while (left_ > count && taken * kSlow > left_)
    {
      taken = goAround(count);
    }
  }

private:
  // its cost, as in costs_, and the edge; what is none comes last
  using Choice = std::pair<double, HalfEdge>;
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // of a point
  struct Known
  {
    Planes planes;        // of the triangles it stands for
    double area = 0.0;    // twice theirs [m^2]
    int round = 0;        // in which something next to it was taken
    Vertex nextTo{};      // that is looked at
    Choice best{};        // of its edges, if any may be taken
    bool isAsked = false; // it holds since something changed
  };

  Known& known(Vertex vertex)
  {
    return known_[at(vertex.idx())];
  }

  // how many points were taken
  std::size_t goAround(std::size_t count)
  {
    ++now_;
    std::vector<Choice> choices;
    choices.reserve(left_);
    std::erase_if(vertices_, [&](Vertex vertex) { return mesh_.status(vertex).deleted(); });
    for (const Vertex vertex : vertices_)
    {
      if (Known& here = known(vertex); !here.isAsked)
      {
        here.isAsked = true;
        here.best = bestOf(vertex);
      }
      const Choice& best = known(vertex).best;
      best.first < kNever ? choices.push_back(best) : void();
    }
    const std::size_t before = left_;
    const std::size_t some = (choices.size() + 7) / 8; // others may be cheaper when these are done
    const auto end = choices.begin() + static_cast<std::ptrdiff_t>(some);
    std::ranges::nth_element(choices, end, std::less());
    choices.resize(some);
    constexpr std::size_t kMany = 4096; // taken as they lie in memory, in a twentieth less time
    some > kMany ? std::ranges::sort(choices, std::less(), &Choice::second)
                 : std::ranges::sort(choices, std::less());
    for (const Choice& choice : choices)
    {
      left_ > count ? take(choice.second) : void();
    }
    return before - left_;
  }

  Choice bestOf(Vertex vertex)
  {
    Choice best{ kNever, HalfEdge() };
    for (const HalfEdge edge : mesh_.voh_range(vertex))
    {
      best = std::min(best, Choice(costs_[at(edge.idx())], edge));
    }
    return best;
  }

  [[nodiscard]] Eigen::Vector3d placeOf(Vertex vertex) const
  {
    return Eigen::Vector3d(mesh_.point(vertex).data());
  }

  // what it costs to take either end away; infinite where it is more than allowed
  void evaluate(HalfEdge edge)
  {
    const HalfEdge back = mesh_.opposite_halfedge_handle(edge);
    const Vertex to = mesh_.to_vertex_handle(edge);
    const Vertex from = mesh_.to_vertex_handle(back);
    const Known& a = known(from);
    const Known& b = known(to);
    const double area = a.area + b.area;
    constexpr double kEven = 1e-6; // among equals the shorter edge, so that triangles stay round
    const double even = kEven * area * (mesh_.point(to) - mesh_.point(from)).sqrnorm();
    const auto costAt = [&](Vertex kept)
    {
      const Eigen::Vector3d x = placeOf(kept);
      const double moved = std::max(0.0, a.planes.at(x) + b.planes.at(x));
      return moved <= squaredError_ * area ? moved + even : kNever;
    };
    costs_[at(edge.idx())] = costAt(to);
    costs_[at(back.idx())] = costAt(from);
  }

  void take(HalfEdge edge)
  {
    const Vertex from = mesh_.from_vertex_handle(edge);
    const Vertex to = mesh_.to_vertex_handle(edge);
    if (known(from).round == now_ || known(to).round == now_ || !keepsTopology(edge) ||
      spoils(from, to))
    {
      return;
    }
    for (const Vertex near : mesh_.vv_range(from))
    {
      known(near).round = now_;
      askAgain(near, from);
      askAgain(near, to);
    }
    for (const Vertex near : mesh_.vv_range(to))
    {
      askAgain(near, to);
    }
    known(to).planes.add(known(from).planes);
    known(to).area += known(from).area;
    mesh_.collapse(edge);
    known(to).isAsked = false;
    for (const HalfEdge out : mesh_.voh_range(to))
    {
      evaluate(out);
      compare(mesh_.opposite_halfedge_handle(out));
    }
    --left_;
  }

  // where the best of a point's edges is one to another
  void askAgain(Vertex vertex, Vertex other)
  {
    Known& here = known(vertex);
    const HalfEdge best = here.best.second;
    here.isAsked = here.isAsked && !(best.is_valid() && mesh_.to_vertex_handle(best) == other);
  }

  // of one edge, whose cost is another by now, with the best of those from the same point
  void compare(HalfEdge edge)
  {
    if (Known& here = known(mesh_.from_vertex_handle(edge)); here.isAsked)
    {
      here.best = std::min(here.best, Choice(costs_[at(edge.idx())], edge));
    }
  }

  // whether no more edges lead from a point
  [[nodiscard]] bool isOfThree(Vertex vertex) const
  {
    const HalfEdge first = mesh_.halfedge_handle(vertex);
    HalfEdge edge = first;
    int edges = 0;
    do
    {
      edge = mesh_.cw_rotated_halfedge_handle(edge);
      ++edges;
    } while (edge != first && edges <= 3);
    return edges <= 3;
  }

  // the link condition: what both ends are next to are the corners across from the edge
  bool keepsTopology(HalfEdge edge)
  {
    const Vertex from = mesh_.from_vertex_handle(edge);
    const Vertex to = mesh_.to_vertex_handle(edge);
    const bool isRim = mesh_.is_boundary(mesh_.edge_handle(edge));
    if (mesh_.is_boundary(from) && !isRim)
    {
      return false;
    }
    for (const Vertex near : mesh_.vv_range(from))
    {
      known(near).nextTo = from;
    }
    int common = 0;
    bool isThin = false; // a corner of three triangles would keep two, back to back
    for (const Vertex near : mesh_.vv_range(to))
    {
      const bool isCommon = known(near).nextTo == from;
      common += isCommon ? 1 : 0;
      isThin = isThin || (isCommon && isOfThree(near));
    }
    std::ranges::for_each(
      mesh_.vv_range(from), [&](Vertex near) { known(near).nextTo = Vertex(); });
    return common == (isRim ? 1 : 2) && !isThin;
  }

  // whether a triangle would turn over, or become a sliver
  [[nodiscard]] bool spoils(Vertex from, Vertex to) const
  {
    constexpr double kMost = 0.7;  // cosine
    constexpr double kThin = 0.02; // height over longest edge
    for (const HalfEdge out : mesh_.voh_range(from))
    {
      const Vertex a = mesh_.to_vertex_handle(out);
      const Vertex b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
      if (mesh_.is_boundary(out) || a == to || b == to)
      {
        continue;
      }
      const auto& [one, other] = std::pair(mesh_.point(a), mesh_.point(b));
      const OpenMesh::Vec3d before = areaOf(mesh_.point(from), one, other);
      const OpenMesh::Vec3d after = areaOf(mesh_.point(to), one, other);
      const double size = before.norm();
      const bool isTurned = !((before | after) > kMost * size * after.norm());
      if (size > 0.0 && (isTurned || !(flatness(placeOf(to), placeOf(a), placeOf(b)) > kThin)))
      {
        return true;
      }
    }
    return false;
  }

  HalfEdges& mesh_;
  double squaredError_; // [m^2]
  std::size_t left_;    // points
  std::vector<Known> known_;
  std::vector<double> costs_;    // of half-edges: squared distance times area, and a little of the
                                 // length [m^4]
  std::vector<Vertex> vertices_; // but for those that were taken before this round
  int now_ = 0;                  // round
};

TriangleMesh whatIsLeft(const HalfEdges& mesh)
{
  TriangleMesh result;
  std::vector<int> numbers(mesh.n_vertices());
  const auto isLeft = [&](auto handle) { return !mesh.status(handle).deleted(); };
  result.points.reserve(static_cast<std::size_t>(std::ranges::count_if(mesh.vertices(), isLeft)));
  result.triangles.reserve(static_cast<std::size_t>(std::ranges::count_if(mesh.faces(), isLeft)));
  for (const Vertex vertex : mesh.vertices())
  {
    if (isLeft(vertex))
    {
      numbers[at(vertex.idx())] = static_cast<int>(result.points.size());
      result.points.emplace_back(mesh.point(vertex).data());
    }
  }
  for (const HalfEdges::FaceHandle face : mesh.faces())
  {
    if (!isLeft(face))
    {
      continue;
    }
    Triangle& triangle = result.triangles.emplace_back();
    std::ranges::transform(mesh.fv_range(face), triangle.begin(),
      [&](Vertex vertex) { return numbers[at(vertex.idx())]; });
  }
  return result;
}

} // namespace

TriangleMesh decimated(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  std::size_t count, double error)
{
  TriangleMesh result;
  decimateTo({ &count, 1 }, points, triangles, error,
    [&](TriangleMesh mesh)
    {
      result = std::move(mesh);
      return true;
    });
  return result;
}

void decimateTo(std::span<const std::size_t> counts, std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, double error, const std::function<bool(TriangleMesh)>& take)
{
  HalfEdges mesh = halfEdgesOf(points, triangles);
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  Decimation decimation(mesh, error);
  for (const std::size_t count : counts)
  {
    decimation.downTo(count);
    if (!take(whatIsLeft(mesh)))
    {
      return;
    }
  }
}

} // namespace palp
