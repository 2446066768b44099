// Hits of triangles, whose geometry is found side by side.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hit_state.h"
#include "core/picture/lanes.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Up to bundle_rays_max hits side by side, a row for each of their numbers.
class TriangleLanes {
 public:
  /// Takes a hit whose geometry comes next, if it is one of a triangle that shares its plane with none. `record`: its block,
  /// which stays until read_all(). Requires room.
  bool take(HitState& state, const std::byte* record);
  /// Does to all that were taken what read_geometry() does, to the bit, and forgets them.
  void read_all(VectorWidth width = vector_width());

 private:
  void find_lanes();

  std::size_t count_ = 0;
  std::array<HitState*, bundle_rays_max> state_;
  std::array<const std::byte*, bundle_rays_max> record_;
  VectorRows corner_, second_, third_, origin_, direction_;
  Row<double> t_;
  VectorRows point_, normal_;
  Row<double> u_, v_, clearance_;
};

}  // namespace dmpc::core
