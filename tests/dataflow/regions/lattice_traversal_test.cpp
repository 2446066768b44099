#include "dataflow/regions/lattice_traversal.h"

#include <doctest/doctest.h>

#include <optional>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/trace/traversal.h"
#include "dataflow/rays/next_stop.h"
#include "tests/support/surroundings.h"

namespace lattice_traversal_test {

using namespace dmpc;
using dataflow::Bsp;

namespace {

const core::GridFrame walked_frame{.resolution = {4, 4, 4}, .finest_cell = 1};
const core::Corner walked_size = core::grid_size(walked_frame);

/// Cut along two axes, with some regions that hold nothing.
Bsp with_empty_regions(const dataflow::CutAxes& axes, std::uint32_t region_count, std::uint64_t seed) {
  Bsp bsp = dataflow::equal_size_bsp(walked_size, axes, region_count);
  apps::Random random(seed);
  for (std::uint32_t region = 0; region < region_count; ++region) {
    if (random.below(4) != 0) {
      bsp.mark_empty(region);
    }
  }
  return bsp;
}

/// From corners of cells, along axes, in planes between cells and along their edges; some from outside.
core::Ray ray_along_planes(apps::Random& random) {
  core::Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto eighths = static_cast<std::int32_t>(random.below(15)) - 3;
    ray.origin[axis] = static_cast<float>(eighths * walked_size[axis] / 8);
    ray.direction[axis] = static_cast<float>(random.below(5)) / 2 - 1;
  }
  return ray;
}

std::optional<std::uint32_t> owner_on_planes(const core::Ray& ray, const dataflow::Regions& bsp) {
  if (const auto passage = core::first_passage(ray, walked_frame)) {
    core::Operations operations;
    const dataflow::NextStop stop = tests::next_stop_without_proxy(ray, *passage, walked_frame, bsp, operations);
    if (stop.traced == core::Traced::left) {
      return nodes::index_of(bsp.owner_of(stop.passage.cell));
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> owner_by_lattice(const core::Ray& ray, const dataflow::JointLattice& lattice,
                                              dataflow::LatticeTraversal& walk, std::size_t bsp) {
  for (bool is_inside = walk.enter(ray); is_inside; is_inside = walk.advance()) {
    if ((lattice.occupied(walk.cell()) >> bsp & 1U) != 0) {
      return lattice.owners(walk.cell())[bsp];
    }
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a ray that crosses several planes at once comes to the regions to which the traversal takes it") {
  const std::vector<dataflow::Regions> bsps = {with_empty_regions({0, 1}, 16, 1), with_empty_regions({1, 2}, 64, 2),
                                               with_empty_regions({0, 1}, 12, 3)};
  const dataflow::JointLattice lattice(bsps);
  dataflow::LatticeTraversal walk(lattice, walked_frame);
  apps::Random random(20'261);
  int found = 0, missed = 0;
  for (int i = 0; i < 20'000; ++i) {
    CAPTURE(i);
    const core::Ray ray = ray_along_planes(random);
    for (std::size_t bsp = 0; bsp < bsps.size(); ++bsp) {
      const auto owner = owner_on_planes(ray, bsps[bsp]);
      CHECK(owner_by_lattice(ray, lattice, walk, bsp) == owner);
      ++(owner ? found : missed);
    }
  }
  CHECK(found > 5000);
  CHECK(missed > 5000);
}

}  // namespace lattice_traversal_test
