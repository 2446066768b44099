#include "core/trace/kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/record/records.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace kernel_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

struct Triangle {
  std::array<Vec3f, 3> v;
};

Vec3f point(Random& random) { return Vec3f(random.in_box(-1, 1)); }

/// Random, needle-shaped, degenerate, huge, or through exactly representable places that rays through the origin meet on edges.
Triangle random_triangle(Random& random) {
  const Vec3f a = point(random), b = point(random), c = point(random);
  switch (random.below(6)) {
    case 0:
      return {{a, b, b + Vec3f(random.in_box(-1e-6, 1e-6))}};
    case 1:
      return {{a, a, b}};
    case 2:
      return {{Vec3f{-1, -1, 1}, Vec3f{1, -1, 1}, Vec3f{0, 1, 1}}};
    case 3:
      return {{Vec3f{0, 0, 0.5F}, Vec3f{1, 0, 0.5F}, Vec3f{0, 1, 0.5F}}};
    case 4:
      return {{a * 1e18F, b * 1e18F, c * 1e18F}};
    default:
      return {{a, b, c}};
  }
}

Ray random_ray(Random& random) {
  switch (random.below(3)) {
    case 0:
      return ray_from({0, 0, 0}, {0, 0, 1});
    case 1:
      return ray_from({0, 0, -1}, Vec3f(normalize(Vec3d{0.25 * random.below(5), 0.25 * random.below(5), 1})));
    default:
      return ray_from(point(random), Vec3f(random.direction()));
  }
}

/// Rows as in a leaf, ids 10, 20, ..., then 8 floats of garbage.
std::vector<float> rows_of(const std::vector<Triangle>& triangles, Random& random) {
  std::vector<float> rows;
  for (std::size_t row = 0; row < 9; ++row) {
    for (const Triangle& triangle : triangles) {
      rows.push_back(triangle.v[row / 3][row % 3]);
    }
  }
  for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
    rows.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(10 * (lane + 1))));
  }
  for (std::size_t i = 0; i < 8; ++i) {
    rows.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())));
  }
  return rows;
}

/// A leaf of triangles with the ids 10, 20, ... and room to read over.
std::vector<std::byte> leaf_of(const std::vector<Triangle>& triangles) {
  Random random(1);
  std::vector<std::byte> bytes(leaf_bytes(PrimitiveKind::triangle, leaf_lanes) + overread_bytes);
  const LeafHeader header{.kind = PrimitiveKind::triangle, .count = static_cast<std::uint8_t>(triangles.size())};
  const auto rows = rows_of(triangles, random);
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::memcpy(bytes.data() + sizeof(header), rows.data(), triangles.size() * 40);
  return bytes;
}

const Triangle front{{Vec3f{-1, -1, 1}, Vec3f{1, -1, 1}, Vec3f{0, 1, 1}}};
const Triangle behind{{Vec3f{-1, -1, 2}, Vec3f{1, -1, 2}, Vec3f{0, 1, 2}}};
const Ray along_z = ray_from({0, 0, 0}, {0, 0, 1});

Hit tested(const std::vector<Triangle>& triangles, const Ray& ray) {
  Hit best;
  Operations operations;
  const auto leaf = leaf_of(triangles);
  test_leaf(ray, ShearedRay(ray), leaf.data(), Address{5}, best, operations);
  CHECK(operations.primitive_tests[0] == triangles.size());
  return best;
}

}  // namespace

TEST_CASE("vectors of 1 to 8 lanes give the scalar twin's bits, whatever lies behind") {
  Random random(1);
  std::size_t differences = 0, hits = 0;
  for (std::size_t i = 0; i < scaled(200'000); ++i) {
    const std::size_t count = 1 + i % leaf_lanes;
    std::vector<Triangle> triangles;
    while (triangles.size() < count) {
      triangles.push_back(random_triangle(random));
    }
    const auto rows = rows_of(triangles, random);
    const ShearedRay ray(random_ray(random));
    const auto ignored = static_cast<std::uint32_t>(10 * random.below(12));
    const float t_most = random.bits() % 4 == 0 ? 1.0F : std::numeric_limits<float>::infinity();
    float scalar[leaf_lanes], simd[leaf_lanes];
    const std::uint32_t expected = hit_triangles_scalar(ray, {rows.data(), count}, ignored, t_most, scalar);
    differences += hit_triangles(ray, {rows.data(), count}, ignored, t_most, simd) == expected ? 0 : 1;
    for (std::uint32_t rest = expected; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
      differences += std::bit_cast<std::uint32_t>(scalar[lane]) == std::bit_cast<std::uint32_t>(simd[lane]) ? 0 : 1;
      ++hits;
    }
  }
  CHECK(differences == 0);
  CHECK(hits > scaled(10'000));
}

TEST_CASE("a ray that has left a plane does not meet a needle that lies in it") {
  const Triangle needle{{Vec3f{0.711276472F, 0.485763639F, 0.258575141F}, Vec3f{0.299474895F, 0.580835521F, 0.258575141F},
                         Vec3f{0.276886404F, 0.585476339F, 0.258575141F}}};
  const Ray leaving = ray_from({0.417535782F, 0.553579032F, 0.258574665F}, {-0.652881801F, 0.632484794F, -0.416783363F});
  CHECK_FALSE(tested({needle}, leaving).found());
  CHECK_FALSE(tested({front, needle, behind}, leaving).found());
  Ray coming = leaving;
  coming.direction = -coming.direction;
  CHECK(tested({needle}, coming).found());
}

TEST_CASE("a lane's place changes no bit of its answer") {
  Random random(2);
  for (std::size_t i = 0; i < scaled(2000); ++i) {
    std::vector<Triangle> triangles;
    while (triangles.size() < leaf_lanes) {
      triangles.push_back(random_triangle(random));
    }
    const ShearedRay ray(random_ray(random));
    float forward[leaf_lanes], backward[leaf_lanes];
    const auto hits = [&](float* times) {
      const auto rows = rows_of(triangles, random);
      return hit_triangles(ray, {rows.data(), leaf_lanes}, no_primitive, std::numeric_limits<float>::infinity(), times);
    };
    const std::uint32_t ahead = hits(forward);
    std::reverse(triangles.begin(), triangles.end());
    const std::uint32_t back = hits(backward);
    for (std::size_t lane = 0; lane < leaf_lanes; ++lane) {
      const bool is_hit = (ahead >> lane & 1U) != 0;
      CHECK(is_hit == ((back >> (leaf_lanes - 1 - lane) & 1U) != 0));
      CHECK((!is_hit || forward[lane] == backward[leaf_lanes - 1 - lane]));
    }
  }
}

TEST_CASE("a leaf yields its nearest hit, and the lowest id of equal ones") {
  const Hit hit = tested({behind, front, front}, along_z);
  CHECK(hit.t == 1.0F);
  CHECK(hit.primitive == 20);
  CHECK(hit.lane == 1);
  CHECK(hit.leaf == Address{5});
}

TEST_CASE("the ignored primitive and hits at t_max or beyond do not count") {
  Ray ray = along_z;
  ray.ignored_primitive = 20;
  CHECK(tested({behind, front}, ray).primitive == 10);
  ray = along_z;
  ray.t_max = 1.0F;
  CHECK_FALSE(tested({behind, front}, ray).found());
  ray.t_max = 1.5F;
  CHECK(tested({behind, front}, ray).primitive == 20);
  CHECK_FALSE(tested({behind, front}, ray_from({0, 0, 3}, {0, 0, 1})).found());
}

TEST_CASE("testing a leaf twice, or after a nearer hit, changes nothing") {
  const auto leaf = leaf_of({front, behind});
  Hit best{.t = 0.5F, .primitive = 3};
  Operations operations;
  test_leaf(along_z, ShearedRay(along_z), leaf.data(), Address{5}, best, operations);
  CHECK(best.primitive == 3);
  best = {.t = 1.0F, .primitive = 15};
  for (int i = 0; i < 2; ++i) {
    test_leaf(along_z, ShearedRay(along_z), leaf.data(), Address{5}, best, operations);
    CHECK(best.primitive == 10);
  }
}

namespace {

/// With up to 8 boxes of any size and place, flat ones and points too.
BvhNode random_bvh_node(Random& random) {
  BvhNode bvh_node{.origin = point(random), .unit = std::ldexp(1.0F, -8 - static_cast<int>(random.below(6)))};
  bvh_node.child_count = static_cast<std::uint32_t>(1 + random.below(bvh_children_max));
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    bvh_node.child[child] = BvhChild::leaf(Address{static_cast<std::uint32_t>(100 + child)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::uint8_t>(random.below(256)), b = static_cast<std::uint8_t>(random.below(256));
      bvh_node.bounds[axis][child] = std::min(a, b);
      bvh_node.bounds[axis + 3][child] = random.below(8) == 0 ? std::min(a, b) : std::max(a, b);
    }
  }
  return bvh_node;
}

/// In any direction, or along one or two axes with zeros of either sign.
Ray random_ray_at(const BvhNode& bvh_node, Random& random) {
  Vec3f direction(random.direction());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    direction[axis] = random.below(4) == 0 ? std::copysign(0.0F, direction[axis]) : direction[axis];
  }
  const Vec3f target = bvh_node.origin + Vec3f(random.in_box(0, 255)) * bvh_node.unit;
  return ray_from(target - direction * static_cast<float>(random.between(-1, 3)), direction);
}

struct Met {
  BvhChild first = BvhChild::none();
  float t_first = 0;
  std::vector<BvhChild> waiting;  ///< the nearest last
  std::vector<float> t_enter;     ///< the waiting children's

  bool operator==(const Met& other) const {
    const auto same = [](BvhChild a, BvhChild b) { return a.bits == b.bits; };
    return same(first, other.first) && t_first == other.t_first && t_enter == other.t_enter &&
           std::equal(waiting.begin(), waiting.end(), other.waiting.begin(), other.waiting.end(), same);
  }
  std::size_t count() const { return waiting.size() + (first.found() ? 1 : 0); }
};

Met met_by(BvhNodeKernel meet, const Ray& ray, const BvhNode& bvh_node, bool in_order, float t_high) {
  MetChildren waiting;
  waiting.count = 0;
  waiting.t_taken = 0;
  const BvhChild first = meet(BoxRay(ray, reciprocal_direction(ray)), bvh_node, 0.0F, t_high, in_order, waiting);
  return {first,
          waiting.t_taken,
          {waiting.record.begin(), waiting.record.begin() + waiting.count},
          {waiting.t_enter.begin(), waiting.t_enter.begin() + waiting.count}};
}

/// Whether the ray's point at t is in the box, in double.
bool is_inside(const BvhNode& bvh_node, std::size_t child, const Ray& ray, double t, double margin) {
  bool inside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = double{ray.origin[axis]} + t * double{ray.direction[axis]};
    const double low = double{bvh_node.origin[axis]} + bvh_node.bounds[axis][child] * double{bvh_node.unit};
    const double high = double{bvh_node.origin[axis]} + bvh_node.bounds[axis + 3][child] * double{bvh_node.unit};
    inside = inside && at >= low + margin && at <= high - margin;
  }
  return inside;
}

}  // namespace

TEST_CASE("vectors of boxes give the scalar twin's children, in its order, with its bits") {
  Random random(3);
  std::size_t differences = 0, found = 0;
  for (std::size_t i = 0; i < scaled(200'000); ++i) {
    const BvhNode bvh_node = random_bvh_node(random);
    const Ray ray = random_ray_at(bvh_node, random);
    const float t_high = random.bits() % 2 == 0 ? 1.0F : std::numeric_limits<float>::infinity();
    const bool in_order = random.bits() % 2 == 0;
    const Met met = met_by(meet_children, ray, bvh_node, in_order, t_high);
    differences += met == met_by(meet_children_scalar, ray, bvh_node, in_order, t_high) ? 0 : 1;
    found += met.count();
  }
  CHECK(differences == 0);
  CHECK(found > scaled(40'000));
}

TEST_CASE("a ray meets every box that it passes through by more than rounding, nearest first") {
  Random random(4);
  std::size_t missed_boxes = 0, out_of_order = 0, through = 0;
  for (std::size_t i = 0; i < scaled(50'000); ++i) {
    const BvhNode bvh_node = random_bvh_node(random);
    const Ray ray = random_ray_at(bvh_node, random);
    const Met met = met_by(meet_children, ray, bvh_node, true, std::numeric_limits<float>::infinity());
    const bool sorted = std::is_sorted(met.t_enter.rbegin(), met.t_enter.rend());
    out_of_order += sorted && (met.t_enter.empty() || met.t_first <= met.t_enter.back()) ? 0 : 1;
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      bool inside = false;
      for (int step = 0; step < 64; ++step) {
        inside = inside || is_inside(bvh_node, child, ray, step / 16.0, 0x1p-20);
      }
      const auto is_child = [&](BvhChild one) { return one.bits == bvh_node.child[child].bits; };
      const bool is_met = is_child(met.first) || std::any_of(met.waiting.begin(), met.waiting.end(), is_child);
      missed_boxes += inside && !is_met ? 1 : 0;
      through += inside ? 1 : 0;
    }
  }
  CHECK(missed_boxes == 0);
  CHECK(out_of_order == 0);
  CHECK(through > scaled(8000));
}

TEST_CASE("the kernel has a name") {
  const std::string name = simd_name();
  CHECK((name == "AVX3" || name == "AVX2" || name == "scalar"));
}

}  // namespace kernel_test
