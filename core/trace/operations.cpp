#include "core/trace/operations.h"

namespace dmpc::core {
namespace {

template <std::size_t N>
void add_all(std::array<std::uint64_t, N>& sum, const std::array<std::uint64_t, N>& more) {
  for (std::size_t i = 0; i < N; ++i) {
    sum[i] += more[i];
  }
}

}  // namespace

Operations& operator+=(Operations& sum, const Operations& more) {
  sum.cell_steps += more.cell_steps;
  sum.brick_reads += more.brick_reads;
  add_all(sum.primitive_tests, more.primitive_tests);
  sum.shadings += more.shadings;
  sum.normal_reads += more.normal_reads;
  sum.texture_lookups += more.texture_lookups;
  sum.tile_reads += more.tile_reads;
  add_all(sum.rays, more.rays);
  sum.primary_hits += more.primary_hits;
  sum.secondary_hits += more.secondary_hits;
  sum.shadow_blocked += more.shadow_blocked;
  sum.total_internal_reflections += more.total_internal_reflections;
  sum.deposits_saturated += more.deposits_saturated;
  sum.rays_cut += more.rays_cut;
  sum.bundles += more.bundles;
  sum.rays_in_bundles += more.rays_in_bundles;
  sum.skipped += more.skipped;
  return sum;
}

}  // namespace dmpc::core
