#include "core/kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "apps/stability/random.h"
#include "core/records.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

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

/// Rows as in a block, then 8 floats of garbage.
std::vector<float> rows_of(const std::vector<Triangle>& triangles, Random& random) {
  std::vector<float> rows;
  for (std::size_t row = 0; row < 9; ++row) {
    for (const Triangle& triangle : triangles) {
      rows.push_back(triangle.v[row / 3][row % 3]);
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    rows.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())));
  }
  return rows;
}

/// A block of triangles with the ids 10, 20, ... and room to read over.
std::vector<std::byte> block_of(const std::vector<Triangle>& triangles) {
  Random random(1);
  std::vector<std::byte> bytes(block_bytes(PrimitiveKind::triangle, block_lanes) + overread_bytes);
  const BlockHeader header{.kind = PrimitiveKind::triangle, .count = static_cast<std::uint8_t>(triangles.size())};
  const auto rows = rows_of(triangles, random);
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::memcpy(bytes.data() + sizeof(header), rows.data(), triangles.size() * 36);
  for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
    const auto id = static_cast<std::uint32_t>(10 * (lane + 1));
    std::memcpy(bytes.data() + sizeof(header) + triangles.size() * 36 + 4 * lane, &id, 4);
  }
  return bytes;
}

const Triangle front{{Vec3f{-1, -1, 1}, Vec3f{1, -1, 1}, Vec3f{0, 1, 1}}};
const Triangle behind{{Vec3f{-1, -1, 2}, Vec3f{1, -1, 2}, Vec3f{0, 1, 2}}};
const Ray along_z = ray_from({0, 0, 0}, {0, 0, 1});

Hit tested(const std::vector<Triangle>& triangles, const Ray& ray) {
  Hit best;
  Operations operations;
  const auto block = block_of(triangles);
  test_block(ray, ShearedRay(ray), block.data(), Address{5}, best, operations);
  CHECK(operations.primitive_tests[0] == triangles.size());
  return best;
}

}  // namespace

TEST_CASE("vectors of 1 to 8 lanes give the scalar twin's bits, whatever lies behind") {
  Random random(1);
  std::size_t differences = 0, hits = 0;
  for (std::size_t i = 0; i < scaled(200'000); ++i) {
    const std::size_t count = 1 + i % block_lanes;
    std::vector<Triangle> triangles;
    while (triangles.size() < count) {
      triangles.push_back(random_triangle(random));
    }
    const auto rows = rows_of(triangles, random);
    const ShearedRay ray(random_ray(random));
    float scalar[block_lanes], simd[block_lanes];
    triangles_scalar(ray, rows.data(), count, scalar);
    triangles_simd(ray, rows.data(), count, simd);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const bool nothing = !(scalar[lane] > 0.0F) && !(simd[lane] > 0.0F);
      differences += nothing || std::bit_cast<std::uint32_t>(scalar[lane]) == std::bit_cast<std::uint32_t>(simd[lane]) ? 0 : 1;
      hits += scalar[lane] > 0.0F ? 1 : 0;
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
    while (triangles.size() < block_lanes) {
      triangles.push_back(random_triangle(random));
    }
    const ShearedRay ray(random_ray(random));
    float forward[block_lanes], backward[block_lanes];
    triangles_simd(ray, rows_of(triangles, random).data(), block_lanes, forward);
    std::reverse(triangles.begin(), triangles.end());
    triangles_simd(ray, rows_of(triangles, random).data(), block_lanes, backward);
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
      CHECK((!(forward[lane] > 0.0F) || forward[lane] == backward[block_lanes - 1 - lane]));
    }
  }
}

TEST_CASE("a block yields its nearest hit, and the lowest id of equal ones") {
  const Hit hit = tested({behind, front, front}, along_z);
  CHECK(hit.t == 1.0F);
  CHECK(hit.primitive == 20);
  CHECK(hit.lane == 1);
  CHECK(hit.block == Address{5});
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

TEST_CASE("testing a block twice, or after a nearer hit, changes nothing") {
  const auto block = block_of({front, behind});
  Hit best{.t = 0.5F, .primitive = 3};
  Operations operations;
  test_block(along_z, ShearedRay(along_z), block.data(), Address{5}, best, operations);
  CHECK(best.primitive == 3);
  best = {.t = 1.0F, .primitive = 15};
  for (int i = 0; i < 2; ++i) {
    test_block(along_z, ShearedRay(along_z), block.data(), Address{5}, best, operations);
    CHECK(best.primitive == 10);
  }
}

TEST_CASE("the kernel has a name") {
  const std::string name = simd_name();
  CHECK((name == "AVX3" || name == "AVX2" || name == "scalar"));
}
