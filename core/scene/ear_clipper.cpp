#include "core/scene/ear_clipper.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace dmpc::core {
namespace {

/// A corner that turns right by more is no better than another.
constexpr double turn_min = -1;

}  // namespace

EarClipper::EarClipper(const FlatPolygon& polygon) : polygon_(polygon), tree_(polygon), corners_(polygon.count()) {
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

CornerTriangle EarClipper::triangle_at(std::uint32_t corner) const {
  return {corners_[corner].before, corner, corners_[corner].after};
}

void EarClipper::measure(std::uint32_t corner) {
  const auto [before, at, after] = triangle_at(corner);
  const double turn = polygon_.turn(before, at, after);
  corners_[corner].turn = turn > turn_min ? turn : -std::numeric_limits<double>::infinity();  // no number neither
  by_turn_.emplace(corners_[corner].turn, corner);
}

/// Whether it is an ear.
void EarClipper::look_at(std::uint32_t corner) {
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

std::uint32_t EarClipper::next() {
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

std::uint32_t EarClipper::first_left() {
  while (!corners_[first_left_].is_left) {
    ++first_left_;
  }
  return first_left_;
}

void EarClipper::cut(std::uint32_t corner) {
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

std::vector<CornerTriangle> EarClipper::triangles() {
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

}  // namespace dmpc::core
