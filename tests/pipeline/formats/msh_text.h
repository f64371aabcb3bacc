#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace palp::test
{

/// A block of tetrahedra, 40 x 30 x 20 mm, as Gmsh's reference manual lays an MSH file out, with
/// the line along an edge and the triangles of one face, which Gmsh writes, too.
class MshBlock
{
public:
  MshBlock()
  {
    for (int i = 0; i < 8; ++i)
    {
      nodes_.emplace_back(i % 2 * 40.0, i / 2 % 2 * 30.0, i / 4 * 20.0);
    }
  }

  /// @param isOther  of the other order of bytes
  /// @param dimension  of a part of the model whose parameters the nodes have; 0: none have
  [[nodiscard]] std::string write(
    double version, bool isBinary, bool isOther = false, int dimension = 0)
  {
    isOther_ = isOther;
    dimension_ = dimension;
    std::string text = "$MeshFormat\n" + std::string(version < 3.0 ? "2.2" : "4.1") +
      (isBinary ? " 1 8\n" : " 0 8\n");
    isBinary_ = isBinary;
    text += isBinary ? bytes(1) + "\n" : "";
    text += "$EndMeshFormat\n";
    return text + (version < 3.0 ? older() : newer());
  }

private:
  template <typename Number>
  [[nodiscard]] std::string bytes(Number number) const
  {
    std::string result(sizeof number, '\0');
    std::memcpy(result.data(), &number, sizeof number);
    return isOther_ ? std::string(result.rbegin(), result.rend()) : result;
  }

  template <typename Number>
  [[nodiscard]] std::string put(Number number) const
  {
    std::ostringstream words;
    words << number << ' ';
    return isBinary_ ? bytes(number) : words.str();
  }

  [[nodiscard]] std::string line() const
  {
    return isBinary_ ? "" : "\n";
  }

  [[nodiscard]] std::string place(std::size_t node) const
  {
    return put(nodes_[node].x()) + put(nodes_[node].y()) + put(nodes_[node].z()) + line();
  }

  [[nodiscard]] std::string older() const
  {
    std::string text = "$Nodes\n8\n";
    for (int i = 0; i < 8; ++i)
    {
      text += put(tagOf(i)) + place(static_cast<std::size_t>(i));
    }
    text += "\n$EndNodes\n$Elements\n9\n";
    int tag = 1;
    for (const Kind& kind : kinds())
    {
      const auto many = static_cast<int>(kind.elements.size());
      text += isBinary_ ? bytes(kind.type) + bytes(many) + bytes(2) : "";
      for (const auto& element : kind.elements)
      {
        text += put(tag++) + (isBinary_ ? "" : put(kind.type) + put(2)) + put(7) + put(1);
        for (const int node : element)
        {
          text += put(tagOf(node));
        }
        text += line();
      }
    }
    return text + "\n$EndElements\n";
  }

  [[nodiscard]] std::string newer() const
  {
    const auto number = [this](std::size_t n) { return put(n); };
    std::string text =
      "$Nodes\n" + number(2) + number(8) + number(1) + number(8) + line(); // in two blocks
    for (const std::size_t first : { 0U, 4U })
    {
      text += put(dimension_ > 0 ? dimension_ : 3) + put(1) + put(dimension_ > 0 ? 1 : 0) +
        number(4) + line();
      for (std::size_t i = first; i < first + 4; ++i)
      {
        text += number(static_cast<std::size_t>(tagOf(static_cast<int>(i)))) + line();
      }
      for (std::size_t i = first; i < first + 4; ++i)
      {
        text += place(i);
        for (int k = 0; k < dimension_; ++k)
        {
          text += put(0.25);
        }
      }
    }
    text += "\n$EndNodes\n$Elements\n" + number(3) + number(9) + number(1) + number(9) + line();
    std::size_t tag = 1;
    for (const Kind& kind : kinds())
    {
      text += put(3) + put(1) + put(kind.type) + number(kind.elements.size()) + line();
      for (const auto& element : kind.elements)
      {
        text += number(tag++);
        for (const int node : element)
        {
          text += number(static_cast<std::size_t>(tagOf(node)));
        }
        text += line();
      }
    }
    return text + "\n$EndElements\n";
  }

  // of its nodes, in no order and with gaps
  static int tagOf(int node)
  {
    return 100 - 3 * node;
  }

  struct Kind
  {
    int type;
    std::vector<std::vector<int>> elements;
  };

  // a line, two triangles and the six tetrahedra about a diagonal
  static std::vector<Kind> kinds()
  {
    return { { 1, { { 0, 1 } } }, { 2, { { 0, 1, 3 }, { 0, 3, 2 } } },
      { 4,
        { { 0, 1, 3, 7 }, { 0, 3, 2, 7 }, { 0, 2, 6, 7 }, { 0, 6, 4, 7 }, { 0, 4, 5, 7 },
          { 0, 5, 1, 7 } } } };
  }

  std::vector<Eigen::Vector3d> nodes_;
  bool isBinary_ = false;
  bool isOther_ = false;
  int dimension_ = 0;
};

} // namespace palp::test
