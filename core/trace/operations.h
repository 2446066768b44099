// Counts of core's work. Only the machine model of nodes/ knows what each costs.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>

#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// Counted in one place each, the same under every runner and strategy.
struct Operations {
  std::uint64_t cell_steps = 0;  ///< steps from one cell to the next, on any level
  /// Steps that rays would take in addition if they left each empty cell by itself; a traversal's last jump, out of the grid or
  /// beyond the light, is not counted.
  std::uint64_t empty_cells = 0;
  std::uint64_t bvh_node_reads = 0;
  std::array<std::uint64_t, primitive_kind_count> primitive_tests{};  ///< lanes tested, by kind
  std::uint64_t instance_entries = 0;                                 ///< rays that entered a base mesh by an instance
  std::uint64_t placed_triangles =
      0;                       ///< triangles of base meshes placed: by a traversal, once for all rays of a bundle, or for shading
  std::uint64_t shadings = 0;  ///< hits that were shaded
  std::uint64_t normal_reads = 0;     ///< hits on smooth triangles that were shaded
  std::uint64_t texture_lookups = 0;  ///< hits on textured triangles that were shaded
  std::uint64_t tile_reads = 0;       ///< tiles of textures: 1 to 8 for each probe of a look-up

  std::array<std::uint64_t, ray_kind_count> rays{};  ///< shot, hit or miss, by kind
  std::uint64_t primary_hits = 0;
  std::uint64_t secondary_hits = 0;  ///< reflected and refracted rays that hit
  std::uint64_t shadow_blocked = 0;
  std::uint64_t total_internal_reflections = 0;
  std::uint64_t deposits_saturated = 0;
  std::uint64_t rays_cut = 0;         ///< rays that were not shot because they could bring less light than the cutoff
  std::uint64_t bundles = 0;          ///< traversals of several rays together
  std::uint64_t rays_in_bundles = 0;  ///< rays in these
  SkippedWork skipped;

  /// Rays shot, of all kinds.
  std::uint64_t ray_count() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }
  /// Rays that were not known to meet only the background.
  std::uint64_t traced_ray_count() const { return ray_count() - skipped.background; }
};

}  // namespace dmpc::core
