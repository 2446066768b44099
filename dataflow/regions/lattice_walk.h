// A ray's way through a lattice of regions, from cell to cell.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "core/trace/walk.h"
#include "dataflow/regions/joint_lattice.h"

namespace dmpc::dataflow {

/// The cells of a lattice that one ray after the other comes to, in the order in which core::Walk crosses the planes between
/// them: so a ray comes to a Bsp's regions in the order in which next_stop() leads it from one to the next. Not thread-safe.
class LatticeWalk {
 public:
  /// `lattice` outlives it; its grid is that of `frame`.
  LatticeWalk(const JointLattice& lattice, const core::GridFrame& frame)
      : lattice_(lattice), frame_(frame), grid_{.high = core::grid_size(frame)} {}

  /// Goes to the first cell of a ray; false if it misses the grid.
  bool enter(const core::Ray& ray) {
    walk_.emplace(ray, frame_, grid_);
    const std::optional<double> t_enter = walk_->entry(ray);
    if (t_enter) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place_[axis] = place_at(axis, *t_enter);
      }
    }
    return t_enter.has_value();
  }

  /// Goes on to the next cell; false if the ray leaves the grid. Requires that enter() has found a cell, and every call since.
  bool advance() {
    double t = std::numeric_limits<double>::infinity();
    std::size_t through = 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t ahead = place_[axis] + (walk_->step(axis) > 0 ? 1 : 0);
      if (const double at = walk_->plane(axis, lattice_.planes(axis)[ahead]); at < t) {
        t = at;
        through = axis;
      }
    }
    if (through == 3) {
      return false;
    }
    if (walk_->step(through) > 0) {
      return ++place_[through] + 1 < lattice_.planes(through).size();
    }
    return place_[through]-- > 0;
  }

  /// Where the ray is.
  std::size_t cell() const { return lattice_.cell_at(place_); }

 private:
  /// Sought from where the ray before was: neighbours in a picture enter by the same cell.
  std::size_t place_at(std::size_t axis, double t_enter) const {
    const std::span<const std::int32_t> planes = lattice_.planes(axis);
    std::size_t place = std::min(place_[axis], planes.size() - 2);  // it may have left the grid
    while (place > 0 && !walk_->starts_above(axis, planes[place], t_enter)) {
      --place;
    }
    while (place + 2 < planes.size() && walk_->starts_above(axis, planes[place + 1], t_enter)) {
      ++place;
    }
    return place;
  }

  const JointLattice& lattice_;
  core::GridFrame frame_;
  core::Region grid_;
  std::optional<core::Walk> walk_;
  JointLattice::Place place_{};
};

}  // namespace dmpc::dataflow
