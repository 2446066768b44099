// Triangulation of a polygon by ear clipping.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "core/scene/flat_polygon.h"

namespace dmpc::core {

/// The remaining corners of a polygon, as a k-d tree (J. L. Bentley, "Multidimensional Binary Search Trees Used for Associative
/// Searching", 1975); a list for few corners.
class CornerTree {
 public:
  /// `polygon` outlives the tree.
  explicit CornerTree(const FlatPolygon& polygon);

  void remove(std::uint32_t corner);
  /// A corner that prevents the triangle from being cut off, if there is one.
  std::optional<std::uint32_t> hindrance(const CornerTriangle& triangle);
  /// Nodes of the tree that all queries so far have visited.
  std::uint64_t nodes_visited() const { return nodes_visited_; }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  struct Box {
    std::array<double, 2> low{}, high{};
  };
  struct Node {
    Box box;
    std::uint32_t parent = none;
    std::uint32_t children = none;  ///< the first of two
    std::uint32_t first = 0, end = 0;
    std::uint32_t left = 0;     ///< corners in it that have not been removed
    bool is_one_place = false;  ///< all corners coincide: one represents all
  };

  /// Whether a node may hold a point of a triangle, up to rounding: where none of three straight lines has it on its right.
  struct Query {
    /// The turn at (u, v) is at most offset + slope[0] u + slope[1] v.
    struct Edge {
      std::array<double, 2> slope{};
      double offset = 0;
    };
    const CornerTriangle& triangle;
    Box box;
    std::array<Edge, 3> edges{};

    bool misses(const Box& other) const;
  };

  Query query_for(const CornerTriangle& triangle) const;
  Box box_of(std::uint32_t first, std::uint32_t end) const;
  void split(std::uint32_t node);
  std::optional<std::uint32_t> hindrance_in(const Node& node, const Query& query);

  const FlatPolygon& polygon_;
  std::vector<std::uint32_t> order_;  ///< corners, each node's next to each other
  std::vector<std::uint8_t> is_left_;
  std::vector<std::uint32_t> leaf_;  ///< by corner
  std::vector<Node> nodes_;
  std::uint64_t nodes_visited_ = 0;
};

/// Repeatedly cuts off the first ear in the order of the corners (G. Meisters, "Polygons Have Ears", 1975), or, if rounding or
/// self-intersection leaves none, the corner that turns left most. A corner that is no ear remembers one that prevents it, and is
/// tested again when that one or a neighbour is removed: so a polygon takes about n log n steps.
class EarClipper {
 public:
  /// `polygon` has at least 3 corners and outlives the clipper.
  explicit EarClipper(const FlatPolygon& polygon);

  std::vector<CornerTriangle> triangles();
  /// The cost: nodes of a tree of the corners, about n log n.
  std::uint64_t nodes_visited() const { return tree_.nodes_visited(); }

 private:
  struct Corner {
    std::uint32_t before = 0, after = 0;
    bool is_left = true;
    double turn = 0;                         ///< with its neighbours
    std::optional<std::uint32_t> hindrance;  ///< found by the last test
    std::vector<std::uint32_t> hindered;     ///< every corner whose hindrance this is, and some whose hindrance this was
  };
  /// The corner that turns left most comes last; of several the first one.
  struct TurnsLess {
    bool operator()(const std::pair<double, std::uint32_t>& a, const std::pair<double, std::uint32_t>& b) const {
      return a.first < b.first || (a.first == b.first && a.second > b.second);
    }
  };

  CornerTriangle triangle_at(std::uint32_t corner) const;
  void measure(std::uint32_t corner);
  void look_at(std::uint32_t corner);
  std::uint32_t next();
  std::uint32_t first_left();
  void cut(std::uint32_t corner);

  const FlatPolygon& polygon_;
  CornerTree tree_;
  std::vector<Corner> corners_;
  std::set<std::uint32_t> ears_;
  std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, TurnsLess> by_turn_;
  std::uint32_t first_left_ = 0;
};

}  // namespace dmpc::core
