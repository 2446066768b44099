// A ray's way through a lattice of regions, from cell to cell.
#pragma once

#include <array>
#include <optional>

#include "core/trace/ray_planes.h"
#include "dataflow/regions/joint_lattice.h"

namespace dmpc::dataflow {

/// The cells of a lattice along one ray after the other, in the order in which core::CellTraversal crosses the planes between
/// them: so a ray visits a partition's regions in the order of next_stop(). Not thread-safe.
class LatticeTraversal {
 public:
  /// `lattice` outlives it; its grid is that of `frame`.
  LatticeTraversal(const JointLattice& lattice, const core::GridFrame& frame)
      : lattice_(lattice), frame_(frame), grid_size_(core::grid_size(frame)) {}

  /// Goes to the first cell of a ray; false if it misses the grid.
  bool enter(const core::Ray& ray) {
    ray_.emplace(ray, frame_);
    const std::optional<double> t_enter = ray_->entry(grid_size_, ray.t_max);
    for (std::size_t axis = 0; t_enter && axis < 3; ++axis) {
      place_[axis] = place_at(axis, *t_enter);
      note_plane_ahead(axis);
    }
    cell_ = lattice_.cell_at(place_);
    return t_enter.has_value();
  }

  /// Goes on to the next cell; false if the ray leaves the grid. Requires that enter() and every call since returned true.
  bool advance() {
    // Planes that are crossed at one t are crossed in the order x, y, z.
    std::size_t through = t_ahead_[1] < t_ahead_[0] ? 1 : 0;
    through = t_ahead_[2] < t_ahead_[through] ? 2 : through;
    if (ray_->step(through) > 0 && place_[through] + 2 < lattice_.planes(through).size()) {
      ++place_[through];
      cell_ += lattice_.stride(through);
    } else if (ray_->step(through) < 0 && place_[through] > 0) {
      --place_[through];
      cell_ -= lattice_.stride(through);
    } else {
      return false;  // a ray without a step goes nowhere
    }
    note_plane_ahead(through);
    return true;
  }

  /// The current cell.
  std::size_t cell() const { return cell_; }

 private:
  /// Searched from the entry of the ray before: neighbours in a picture enter by the same cell.
  std::size_t place_at(std::size_t axis, double t_enter) const {
    const std::span<const std::int32_t> planes = lattice_.planes(axis);
    std::size_t place = place_[axis];
    while (place > 0 && !ray_->starts_above(axis, planes[place], t_enter)) {
      --place;
    }
    while (place + 2 < planes.size() && ray_->starts_above(axis, planes[place + 1], t_enter)) {
      ++place;
    }
    return place;
  }

  void note_plane_ahead(std::size_t axis) {
    t_ahead_[axis] = ray_->plane(axis, lattice_.planes(axis)[place_[axis] + (ray_->step(axis) > 0 ? 1 : 0)]);
  }

  const JointLattice& lattice_;
  core::GridFrame frame_;
  core::Corner grid_size_;
  std::optional<core::RayPlanes> ray_;
  JointLattice::Place place_{};
  std::size_t cell_ = 0;
  std::array<double, 3> t_ahead_{};  ///< at which the ray crosses the next plane of each axis
};

}  // namespace dmpc::dataflow
