#include "core/database/tree/cut_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "apps/lab/bench/stability/random.h"

namespace cut_tree_test {

using namespace dmpc::core;
using dmpc::apps::Random;

namespace {

const Parallel serial(1);

/// Boxes of edge 1, scattered.
Cutter scattered(std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  Cutter cutter(count);
  for (std::uint32_t id = 0; id < count; ++id) {
    const Vec3d low = random.in_box(0, 100);
    cutter.add(id, Bounds::around({low, low + Vec3d{1, 1, 1}}));
  }
  return cutter;
}

/// Groups of 8 equal boxes of edge 1 at these places along x, one behind the other.
Cutter clusters(const std::vector<double>& places) {
  Cutter cutter(places.size() * leaf_lanes);
  for (std::uint32_t id = 0; id < places.size() * leaf_lanes; ++id) {
    const double at = places[id / leaf_lanes];
    cutter.add(id, Bounds::around({{at, 0, 0}, {at + 1, 1, 1}}));
  }
  return cutter;
}

CutTree tree_of(Cutter& cutter, std::size_t count) {
  return CutTree(cutter, cutter.group(PrimitiveKind::triangle, 0, count), serial);
}

void add_leaves(const CutTree& tree, std::vector<Group>& leaves) {
  for (const CutTree* child : tree.children()) {
    if (child->is_leaf()) {
      leaves.push_back(child->group());
    } else {
      add_leaves(*child, leaves);
    }
  }
}

/// Surfaces of the BVH nodes that children() leads to.
double surface_of(const CutTree& tree) {
  double sum = double{tree.group().bounds.area()};
  for (const CutTree* child : tree.children()) {
    sum += child->is_leaf() ? 0 : surface_of(*child);
  }
  return sum;
}

int levels_of(const CutTree& tree) {
  int below = 0;
  for (const CutTree* child : tree.children()) {
    below = std::max(below, child->is_leaf() ? 0 : levels_of(*child));
  }
  return below + 1;
}

/// The least surface of BVH nodes below a group that takes 1 to 8 of its BVH node's children, or fewer.
std::array<double, 9> least_surfaces(Cutter& cutter, const Group& group) {
  std::array<double, 9> least{};
  if (group.count() <= leaf_lanes) {
    return least;
  }
  const auto [first_group, second_group] = cutter.cut(group, false);
  const auto first = least_surfaces(cutter, first_group), second = least_surfaces(cutter, second_group);
  least.fill(std::numeric_limits<double>::infinity());
  for (std::size_t places = 2; places <= 8; ++places) {
    for (std::size_t share = 1; share < places; ++share) {
      least[places] = std::min(least[places], first[share] + second[places - share]);
    }
  }
  least[1] = double{group.bounds.area()} + *std::min_element(least.begin() + 2, least.end());
  for (std::size_t places = 2; places <= 8; ++places) {
    least[places] = std::min(least[places], least[places - 1]);
  }
  return least;
}

}  // namespace

TEST_CASE("what fits a leaf is its own only child") {
  for (const std::uint32_t count : {1U, 8U}) {
    Cutter cutter = scattered(count, 1);
    const CutTree tree = tree_of(cutter, count);
    CHECK(tree.is_leaf());
    CHECK(tree.levels() == 1);
    REQUIRE(tree.children().size() == 1);
    CHECK(tree.children()[0] == &tree);
  }
}

TEST_CASE("one primitive more than a leaf makes two of them, under one BVH node") {
  Cutter cutter = scattered(9, 1);
  const CutTree tree = tree_of(cutter, 9);
  CHECK_FALSE(tree.is_leaf());
  CHECK(tree.children().size() == 2);
  CHECK(tree.levels() == 1);
}

TEST_CASE("the leaves of a tree are parts of its group that no two share") {
  for (const std::uint32_t count : {9U, 64U, 65U, 1000U, 20'000U}) {
    CAPTURE(count);
    Cutter cutter = scattered(count, count);
    const CutTree tree = tree_of(cutter, count);
    std::vector<Group> leaves;
    add_leaves(tree, leaves);
    std::sort(leaves.begin(), leaves.end(), [](const Group& a, const Group& b) { return a.first < b.first; });
    std::uint32_t place = 0;
    for (const Group& leaf : leaves) {
      REQUIRE(leaf.first == place);
      REQUIRE(leaf.count() <= leaf_lanes);
      place = leaf.last;
    }
    CHECK(place == count);
    CHECK(tree.levels() == levels_of(tree));
  }
}

TEST_CASE("neighbours share a BVH node, and what is far away takes a place of its own") {
  Cutter cutter = clusters({0, 1000, 2000, 3000, 4000, 5000, 6000, 7000, 7002, 7004});
  const CutTree tree = tree_of(cutter, 80);
  const auto children = tree.children();
  REQUIRE(children.size() == 8);
  for (const CutTree* child : children) {
    CHECK(child->is_leaf() == (child->group().bounds.low[0] < 7000.0F));
  }
  CHECK(tree.levels() == 2);
}

TEST_CASE("no other choice of children has BVH nodes of less surface together") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    Cutter cutter = scattered(2000, seed), again = scattered(2000, seed);
    const double least = least_surfaces(again, again.group(PrimitiveKind::triangle, 0, 2000))[1];
    CHECK(surface_of(tree_of(cutter, 2000)) == doctest::Approx(least).epsilon(1e-5));
  }
}

TEST_CASE("two kinds stay apart and are known as such") {
  Cutter cutter = scattered(40, 3);
  auto triangles = std::make_unique<CutTree>(cutter, cutter.group(PrimitiveKind::triangle, 0, 30), serial);
  auto spheres = std::make_unique<CutTree>(cutter, cutter.group(PrimitiveKind::sphere, 30, 40), serial);
  const CutTree tree(std::move(triangles), std::move(spheres));
  CHECK(tree.group().count() == 40);
  REQUIRE(tree.kinds().size() == 2);
  CHECK(tree.kinds()[0].count() == 30);
  CHECK(tree.kinds()[1].kind == PrimitiveKind::sphere);
  std::vector<Group> leaves;
  add_leaves(tree, leaves);
  for (const Group& leaf : leaves) {
    CHECK((leaf.kind == PrimitiveKind::sphere) == (leaf.first >= 30));
  }
}

}  // namespace cut_tree_test
