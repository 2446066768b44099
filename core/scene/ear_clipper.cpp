#include "core/scene/ear_clipper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <utility>

namespace dmpc::core {
namespace {

/// Corners that turn right by more than this are all equally bad.
constexpr double turn_min = -1;

constexpr std::uint32_t leaf_corners = 8;
/// Smaller polygons are searched linearly. A box excludes points that rounding alone puts into a triangle, and small polygons
/// keep their results.
constexpr std::uint32_t listed_corners = 64;

/// The maximum rounding error of sums of a few products; far more than that of doubles.
constexpr double rounding = 0x1p-44;

/// The remaining corners of a polygon, as a k-d tree (J. L. Bentley, "Multidimensional Binary Search Trees Used for Associative
/// Searching", 1975); a list for few corners.
class CornerTree {
 public:
  /// `polygon` outlives the tree.
  explicit CornerTree(const FlatPolygon& polygon)
      : polygon_(polygon), order_(polygon.count()), is_left_(polygon.count(), 1), leaf_(polygon.count()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.push_back({.box = box_of(0, polygon.count()), .first = 0, .end = polygon.count(), .left = polygon.count()});
    for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
      split(node);
    }
  }

  void remove(std::uint32_t corner) {
    is_left_[corner] = 0;
    for (std::uint32_t node = leaf_[corner]; node != none; node = nodes_[node].parent) {
      --nodes_[node].left;
    }
    Node& leaf = nodes_[leaf_[corner]];
    while (leaf.first < leaf.end && is_left_[order_[leaf.first]] == 0) {
      ++leaf.first;
    }
  }

  /// A corner that prevents the triangle from being cut off, if there is one.
  std::optional<std::uint32_t> hindrance(const CornerTriangle& triangle) { return hindrance_in(nodes_[0], query_for(triangle)); }

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

    bool misses(const Box& other) const {
      for (std::size_t side = 0; side < 2; ++side) {
        if (other.high[side] < box.low[side] || other.low[side] > box.high[side]) {
          return true;
        }
      }
      return std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
        const double farthest = edge.offset + std::max(edge.slope[0] * other.low[0], edge.slope[0] * other.high[0]) +
                                std::max(edge.slope[1] * other.low[1], edge.slope[1] * other.high[1]);
        return farthest < 0;
      });
    }
  };

  Query query_for(const CornerTriangle& triangle) const {
    Query query{.triangle = triangle, .box = {}};
    const auto at = [&](std::size_t corner, std::size_t side) { return polygon_.coordinate(triangle[corner % 3], side); };
    for (std::size_t side = 0; side < 2; ++side) {
      const auto [low, high] = std::minmax({at(0, side), at(1, side), at(2, side)});
      query.box.low[side] = low;
      query.box.high[side] = high;
    }
    const Box& all = nodes_[0].box;
    const double reach = std::max({std::fabs(all.low[0]), std::fabs(all.high[0]), std::fabs(all.low[1]), std::fabs(all.high[1])});
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = polygon_.sign() * (at(k + 1, 0) - at(k, 0)), v = polygon_.sign() * (at(k + 1, 1) - at(k, 1));
      query.edges[k] = {{-v, u}, v * at(k, 0) - u * at(k, 1) + rounding * reach * (std::fabs(u) + std::fabs(v))};
    }
    return query;
  }

  Box box_of(std::uint32_t first, std::uint32_t end) const {
    Box box;
    for (std::size_t side = 0; side < 2; ++side) {
      box.low[side] = box.high[side] = polygon_.coordinate(order_[first], side);
      for (std::uint32_t i = first; i < end; ++i) {
        box.low[side] = std::min(box.low[side], polygon_.coordinate(order_[i], side));
        box.high[side] = std::max(box.high[side], polygon_.coordinate(order_[i], side));
      }
    }
    return box;
  }

  /// Splits the box into halves in the middle of its longer side.
  void split(std::uint32_t node) {
    nodes_[node].is_one_place = std::all_of(order_.begin() + nodes_[node].first, order_.begin() + nodes_[node].end,
                                            [&](std::uint32_t i) { return polygon_.same_place(i, order_[nodes_[node].first]); });
    const Node whole = nodes_[node];
    if (polygon_.count() <= listed_corners || whole.end - whole.first <= leaf_corners || whole.is_one_place) {
      for (std::uint32_t i = whole.first; i < whole.end; ++i) {
        leaf_[order_[i]] = node;
      }
      return;
    }
    const std::size_t side = whole.box.high[0] - whole.box.low[0] >= whole.box.high[1] - whole.box.low[1] ? 0 : 1;
    const std::uint32_t middle = (whole.first + whole.end) / 2;
    const auto at = [this](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(whole.first), at(middle), at(whole.end), [&](std::uint32_t a, std::uint32_t b) {
      return polygon_.coordinate(a, side) < polygon_.coordinate(b, side);
    });
    nodes_[node].children = static_cast<std::uint32_t>(nodes_.size());
    for (const auto& [first, end] : {std::array{whole.first, middle}, std::array{middle, whole.end}}) {
      nodes_.push_back({.box = box_of(first, end), .parent = node, .first = first, .end = end, .left = end - first});
    }
  }

  std::optional<std::uint32_t> hindrance_in(const Node& node, const Query& query) {
    ++nodes_visited_;
    if (node.left == 0 || (nodes_.size() > 1 && query.misses(node.box))) {
      return std::nullopt;
    }
    if (node.children != none) {
      const auto found = hindrance_in(nodes_[node.children], query);
      return found ? found : hindrance_in(nodes_[node.children + 1], query);
    }
    for (std::uint32_t i = node.first; i < node.end; ++i) {
      if (is_left_[order_[i]] != 0 && polygon_.hinders(order_[i], query.triangle)) {
        return order_[i];
      }
      if (node.is_one_place) {
        break;
      }
    }
    return std::nullopt;
  }

  const FlatPolygon& polygon_;
  std::vector<std::uint32_t> order_;  ///< corners, each node's next to each other
  std::vector<std::uint8_t> is_left_;
  std::vector<std::uint32_t> leaf_;  ///< by corner
  std::vector<Node> nodes_;
  std::uint64_t nodes_visited_ = 0;
};

class EarClipper {
 public:
  explicit EarClipper(const FlatPolygon& polygon) : polygon_(polygon), tree_(polygon), corners_(polygon.count()) {
    const std::uint32_t count = polygon.count();
    for (std::uint32_t corner = 0; corner < count; ++corner) {
      corners_[corner].before = (corner + count - 1) % count;
      corners_[corner].after = (corner + 1) % count;
    }
    for (std::uint32_t corner = 0; corner < count; ++corner) {
      measure(corner);
      look_at(corner);
    }
  }

  std::vector<CornerTriangle> triangles() {
    std::vector<CornerTriangle> result;
    result.reserve(corners_.size() - 2);
    for (std::size_t left = corners_.size(); left > 3; --left) {
      const std::uint32_t corner = next();
      result.push_back(triangle_at(corner));
      cut(corner);
    }
    const std::uint32_t first = first_left(), second = corners_[first].after;
    result.push_back({first, second, corners_[second].after});
    return result;
  }

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

  CornerTriangle triangle_at(std::uint32_t corner) const { return {corners_[corner].before, corner, corners_[corner].after}; }

  void measure(std::uint32_t corner) {
    const auto [before, at, after] = triangle_at(corner);
    const double turn = polygon_.turn(before, at, after);
    corners_[corner].turn = turn > turn_min ? turn : -std::numeric_limits<double>::infinity();  // a NaN counts as such, too
    by_turn_.emplace(corners_[corner].turn, corner);
  }

  /// Tests whether the corner is an ear.
  void look_at(std::uint32_t corner) {
    ears_.erase(corner);
    if (!(corners_[corner].turn > 0)) {
      return;
    }
    const auto hindrance = tree_.hindrance(triangle_at(corner));
    if (!hindrance) {
      ears_.insert(corner);
    } else if (hindrance != corners_[corner].hindrance) {
      corners_[*hindrance].hindered.push_back(corner);
    }
    corners_[corner].hindrance = hindrance;
  }

  std::uint32_t next() {
    if (!ears_.empty()) {
      return *ears_.begin();
    }
    while (!corners_[by_turn_.top().second].is_left || corners_[by_turn_.top().second].turn != by_turn_.top().first) {
      by_turn_.pop();
    }
    if (by_turn_.top().first > turn_min) {
      return by_turn_.top().second;
    }
    return first_left();
  }

  std::uint32_t first_left() {
    while (!corners_[first_left_].is_left) {
      ++first_left_;
    }
    return first_left_;
  }

  void cut(std::uint32_t corner) {
    Corner& gone = corners_[corner];
    gone.is_left = false;
    ears_.erase(corner);
    tree_.remove(corner);
    corners_[gone.before].after = gone.after;
    corners_[gone.after].before = gone.before;
    for (const std::uint32_t neighbour : {gone.before, gone.after}) {
      measure(neighbour);
      look_at(neighbour);
    }
    for (const std::uint32_t hindered : std::exchange(gone.hindered, {})) {
      if (corners_[hindered].is_left && corners_[hindered].hindrance == corner) {
        look_at(hindered);
      }
    }
  }

  const FlatPolygon& polygon_;
  CornerTree tree_;
  std::vector<Corner> corners_;
  std::set<std::uint32_t> ears_;
  std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, TurnsLess> by_turn_;
  std::uint32_t first_left_ = 0;
};

}  // namespace

EarClipping clip_ears(const FlatPolygon& polygon) {
  EarClipper clipper(polygon);
  std::vector<CornerTriangle> triangles = clipper.triangles();
  return {std::move(triangles), clipper.nodes_visited()};
}

}  // namespace dmpc::core
