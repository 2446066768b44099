// A polygon that loses one ear after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "core/scene/corner_tree.h"
#include "core/scene/flat_polygon.h"

namespace dmpc::core {

/// Cuts off the first ear in the order of the corners, again and again (G. Meisters, "Polygons Have Ears", 1975), or, where
/// rounding or self-intersection leaves none, the corner that turns left most. A corner that is no ear remembers one that hinders
/// it, and is looked at again when that one is gone or a neighbour is: so a polygon takes about n log n steps.
class EarClipper {
 public:
  /// `polygon` has at least 3 corners and outlives the clipper.
  explicit EarClipper(const FlatPolygon& polygon);

  std::vector<CornerTriangle> triangles();
  /// What it took: nodes of a tree of the corners, n log n or so.
  std::uint64_t nodes_visited() const { return tree_.nodes_visited(); }

 private:
  struct Corner {
    std::uint32_t before = 0, after = 0;
    bool is_left = true;
    double turn = 0;                         ///< with its neighbours
    std::optional<std::uint32_t> hindrance;  ///< found when it was looked at last
    std::vector<std::uint32_t> hindered;     ///< every corner whose hindrance this is, and some whose hindrance this was
  };
  /// The corner that turns left most comes last, of several the first one.
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
