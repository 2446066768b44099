#include "dataflow/regions/joint_lattice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/base/expect.h"

namespace joint_lattice_test {

using namespace dmpc;
using dataflow::Bsp;
using dataflow::JointLattice;
using dataflow::Regions;

namespace {

constexpr core::Corner lattice_size{640, 512, 900};

std::vector<Regions> several() {
  std::vector<Bsp> bsps;
  for (const std::uint32_t count : {1U, 4U, 7U, 32U}) {
    bsps.push_back(dataflow::equal_size_bsp(lattice_size, {0, 2}, count));
  }
  bsps[1].assign(std::vector<std::uint32_t>{2, 0, 3, 1});
  bsps[2].mark_empty(5);
  std::vector<Regions> partitions(bsps.begin(), bsps.end());
  partitions.emplace_back(dataflow::scatter(lattice_size, {0, 2}, 5, 12));
  partitions.back().mark_empty(7);
  return partitions;
}

std::size_t place_of(const JointLattice& lattice, std::size_t axis, std::int32_t finest) {
  const auto planes = lattice.planes(axis);
  return static_cast<std::size_t>(std::upper_bound(planes.begin(), planes.end(), finest) - planes.begin()) - 1;
}

}  // namespace

TEST_CASE("a lattice of several partitions has the owner and the emptiness of every cell in each") {
  const std::vector<Regions> bsps = several();
  const JointLattice lattice(bsps);
  CHECK(lattice.all_partitions() == 0b11111);
  CHECK(lattice.planes(1).size() == 2);
  for (std::int32_t x = 0; x < lattice_size[0]; x += 13) {
    for (std::int32_t z = 0; z < lattice_size[2]; z += 17) {
      const core::Corner at{x, 7, z};
      const std::size_t cell = lattice.cell_at({place_of(lattice, 0, x), 0, place_of(lattice, 2, z)});
      for (std::size_t i = 0; i < bsps.size(); ++i) {
        CHECK(nodes::NodeId{lattice.owners(cell)[i]} == bsps[i].owner_of(at));
        CHECK((lattice.occupied(cell) >> i & 1U) == (bsps[i].is_empty(bsps[i].region_index_of(at)) ? 0 : 1));
      }
    }
  }
}

TEST_CASE("a lattice has a plane for each cut between the grid's ends, once, and knows its size beforehand") {
  const std::vector<Regions> bsps = {dataflow::equal_size_bsp({8, 4, 8}, {0, 1}, 8),
                                     dataflow::equal_size_bsp({8, 4, 8}, {0, 1}, 8)};
  const JointLattice lattice(bsps);
  CHECK(std::vector(lattice.planes(0).begin(), lattice.planes(0).end()) == std::vector<std::int32_t>{0, 2, 4, 6, 8});
  CHECK(std::vector(lattice.planes(1).begin(), lattice.planes(1).end()) == std::vector<std::int32_t>{0, 2, 4});
  CHECK(JointLattice::owner_count(bsps) == 2 * 4 * 2);
}

TEST_CASE("more regions than finest columns leave a lattice of what there is") {
  const std::vector<Regions> bsps = {dataflow::equal_size_bsp({2, 2, 2}, {0, 1}, 9)};
  const JointLattice lattice(bsps);
  CHECK(lattice.planes(0).size() == 3);
  CHECK(lattice.planes(1).size() == 3);
}

TEST_CASE("a lattice of nothing, of too many Bsps or of different grids is refused") {
  CHECK_THROWS_AS(JointLattice({}), core::InternalError);
  const std::vector<Regions> many(JointLattice::partitions_max + 1, Bsp({4, 4, 4}));
  CHECK_THROWS_AS(JointLattice{many}, core::InternalError);
  CHECK(JointLattice(std::span(many).first(JointLattice::partitions_max)).all_partitions() == ~std::uint64_t{0});
  const std::vector<Regions> different = {Bsp({4, 4, 4}), Bsp({4, 4, 8})};
  CHECK_THROWS_AS(JointLattice{different}, core::InternalError);
}

}  // namespace joint_lattice_test
