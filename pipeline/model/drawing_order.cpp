#include "pipeline/model/drawing_order.h"

namespace palp
{
namespace
{

constexpr int kKept = 32; // corners that a renderer has at hand, at least

// fans of triangles about one point after the other, each next to the one before where it can be
class Fans
{
public:
  Fans(std::span<const Triangle> triangles, std::size_t pointCount)
    : triangles_(triangles)
    , first_(pointCount + 1)
    , fan_(3 * triangles.size())
    , left_(pointCount)
    , shaded_(pointCount, -kKept)
    , isDrawn_(triangles.size())
  {
    for (const Triangle& triangle : triangles)
    {
      for (const int corner : triangle)
      {
        ++left_[at(corner)];
      }
    }
    for (std::size_t i = 0; i < pointCount; ++i)
    {
      first_[i + 1] = first_[i] + left_[i];
    }
    std::vector<int> end = first_;
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      for (const int corner : triangles[i])
      {
        fan_[at(end[at(corner)]++)] = static_cast<int>(i);
      }
    }
  }

  std::vector<Triangle> inOrder()
  {
    drawn_.reserve(triangles_.size());
    for (int point = unfinished(); point >= 0; point = next())
    {
      draw(point);
    }
    return std::move(drawn_);
  }

private:
  void draw(int point)
  {
    around_.clear();
    for (int i = first_[at(point)]; i < first_[at(point) + 1]; ++i)
    {
      const int triangle = fan_[at(i)];
      if (isDrawn_[at(triangle)])
      {
        continue;
      }
      isDrawn_[at(triangle)] = true;
      drawn_.push_back(triangles_[at(triangle)]);
      for (const int corner : triangles_[at(triangle)])
      {
        around_.push_back(corner);
        --left_[at(corner)];
        if (now_ - shaded_[at(corner)] >= kKept)
        {
          shaded_[at(corner)] = now_++;
        }
      }
    }
    trail_.insert(trail_.end(), around_.begin(), around_.end());
  }

  // the one shaded longest ago whose fan can be drawn before it is forgotten
  int next()
  {
    int best = -1;
    int oldest = -1;
    for (const int point : around_)
    {
      const int age = now_ - shaded_[at(point)];
      if (left_[at(point)] > 0 && age + 2 * left_[at(point)] <= kKept && age > oldest)
      {
        oldest = age;
        best = point;
      }
    }
    return best >= 0 ? best : unfinished();
  }

  // the last one met, or the first of all; -1: all is drawn
  int unfinished()
  {
    for (; !trail_.empty(); trail_.pop_back())
    {
      if (left_[at(trail_.back())] > 0)
      {
        return trail_.back();
      }
    }
    while (from_ < left_.size() && left_[from_] == 0)
    {
      ++from_;
    }
    return from_ < left_.size() ? static_cast<int>(from_) : -1;
  }

  std::span<const Triangle> triangles_;
  std::vector<int> first_;  // per point, its first triangle in fan_, and an end
  std::vector<int> fan_;    // triangles of each point
  std::vector<int> left_;   // per point, triangles to draw
  std::vector<int> shaded_; // per point, when
  std::vector<bool> isDrawn_;
  std::vector<int> around_; // corners of the last fan
  std::vector<int> trail_;  // of all fans
  std::size_t from_ = 0;    // no point before it has triangles to draw
  int now_ = 0;
  std::vector<Triangle> drawn_;
};

} // namespace

std::vector<Triangle> inDrawingOrder(std::span<const Triangle> triangles, std::size_t pointCount)
{
  return Fans(triangles, pointCount).inOrder();
}

} // namespace palp
