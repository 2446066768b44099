// One ray against one block of 8 primitives.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/expect.h"
#include "core/record/records.h"
#include "core/trace/kernel.h"
#include "tests/bench/groups.h"

namespace dmpc::bench {
namespace {

constexpr std::size_t pair_count = 256;  ///< rays, each with a block of its own
const std::string group = "a block of 8";

/// A ray into the unit cube and a record with 8 primitives there, some of which it hits.
struct Pair {
  core::Ray ray;
  core::ShearedRay sheared;
  alignas(32) std::array<std::byte, core::record_bytes_max + core::overread_bytes> record{};

  const float* rows() const { return reinterpret_cast<const float*>(record.data() + sizeof(core::BlockHeader)); }
};

/// About a point of the cube: three vertices of a triangle, a sphere, or a cone's two ends.
std::array<float, 9> values_of(core::PrimitiveKind kind, apps::Random& random) {
  const core::Vec3d middle = random.in_box(0, 1);
  std::array<float, 9> values{};
  for (std::size_t i = 0; i < 3; ++i) {
    const core::Vec3f point(middle + random.in_box(-0.4, 0.4));
    const std::size_t step = kind == core::PrimitiveKind::triangle ? 3 : 4;
    for (std::size_t axis = 0; axis < 3 && i * step + axis < values.size(); ++axis) {
      values[i * step + axis] = point[axis];
    }
  }
  if (kind != core::PrimitiveKind::triangle) {
    values[3] = 0.2F;
    values[7] = 0.1F;
  }
  return values;
}

core::Ray random_ray(apps::Random& random) {
  core::Ray ray;
  const core::Vec3d from = random.in_box(-1, 2);
  ray.origin = core::Vec3f(from);
  ray.direction = core::Vec3f(core::normalize(random.in_box(0.2, 0.8) - from));
  return ray;
}

Pair make_pair(core::PrimitiveKind kind, apps::Random& random) {
  const core::Ray ray = random_ray(random);
  Pair pair{.ray = ray, .sheared = core::ShearedRay(ray)};
  const core::BlockHeader header{.kind = kind, .count = core::block_lanes};
  std::memcpy(pair.record.data(), &header, sizeof(header));
  const std::size_t value_count = core::value_count(kind);
  for (std::uint32_t lane = 0; lane < core::block_lanes; ++lane) {
    const std::array<float, 9> values = values_of(kind, random);
    for (std::size_t row = 0; row < value_count; ++row) {
      std::memcpy(pair.record.data() + sizeof(header) + 4 * (row * core::block_lanes + lane), &values[row], 4);
    }
    std::memcpy(pair.record.data() + sizeof(header) + 4 * (value_count * core::block_lanes + lane), &lane, 4);
  }
  return pair;
}

std::vector<Pair> pairs_of(core::PrimitiveKind kind) {
  apps::Random random(1);
  std::vector<Pair> pairs;
  while (pairs.size() < pair_count) {
    pairs.push_back(make_pair(kind, random));
  }
  return pairs;
}

/// Nearest hits of all pairs: how many, and a sum over their bits.
struct Answer {
  std::uint64_t hits = 0;
  std::uint64_t sum = 0;

  void add(float t, std::uint32_t lane) {
    ++hits;
    sum += std::bit_cast<std::uint32_t>(t) * std::uint64_t{lane + 1};
  }
  bool operator==(const Answer&) const = default;
};

/// By the scalar routine of each primitive.
Answer expected(const std::vector<Pair>& pairs, core::PrimitiveKind kind) {
  Answer answer;
  for (const Pair& pair : pairs) {
    core::Hit best;
    for (std::uint32_t lane = 0; lane < core::block_lanes; ++lane) {
      const float t =
          kind == core::PrimitiveKind::triangle ? core::intersect_triangle(pair.sheared, pair.rows(), core::block_lanes, lane)
          : kind == core::PrimitiveKind::sphere ? core::intersect_sphere(pair.ray, pair.rows(), core::block_lanes, lane)
                                                : core::intersect_cone(pair.ray, pair.rows(), core::block_lanes, lane);
      if (t > 0.0F && core::nearer(t, lane, best)) {
        best = {.t = t, .primitive = lane};
      }
    }
    if (best.found()) {
      answer.add(best.t, best.primitive);
    }
  }
  core::expect(answer.hits > pair_count / 10 && answer.hits < pair_count, "some of the rays hit something");
  return answer;
}

/// `test(pair, answer)` once for each pair, again and again.
template <class Test>
void repeat(benchmark::State& state, core::PrimitiveKind kind, Test test) {
  const std::vector<Pair> pairs = pairs_of(kind);
  const Answer right = expected(pairs, kind);
  for (auto _ : state) {
    Answer answer;
    for (const Pair& pair : pairs) {
      test(pair, answer);
    }
    core::expect(answer == right, "a block's nearest hits are those of its primitives, one by one");
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}

void test_triangles(core::TriangleKernel kernel, const Pair& pair, Answer& answer) {
  std::array<float, core::block_lanes> times{};
  core::Hit best;
  std::uint32_t hits = kernel(pair.sheared, {pair.rows(), core::block_lanes}, core::no_primitive, best.t, times.data());
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(hits));
    if (core::nearer(times[lane], lane, best)) {
      best = {.t = times[lane], .primitive = lane};
    }
  }
  if (best.found()) {
    answer.add(best.t, best.primitive);
  }
}

void add_kernel(const std::string& subject, core::TriangleKernel kernel) {
  add_row(group, subject, [kernel](benchmark::State& state) {
    repeat(state, core::PrimitiveKind::triangle,
           [kernel](const Pair& pair, Answer& answer) { test_triangles(kernel, pair, answer); });
  });
}

void add_block(const std::string& subject, core::PrimitiveKind kind) {
  add_row(group, subject, [kind](benchmark::State& state) {
    core::Operations operations;
    repeat(state, kind, [&operations](const Pair& pair, Answer& answer) {
      core::Hit best;
      core::test_block(pair.ray, pair.sheared, pair.record.data(), core::Address{0}, best, operations);
      if (best.found()) {
        answer.add(best.t, best.primitive);
      }
    });
  });
}

}  // namespace

void add_kernel_rows() {
  add_kernel("triangles, scalar", core::hit_triangles_scalar);
  add_kernel(std::string("triangles, ") + core::simd_name(), core::hit_triangles);
  add_block("triangles, the whole test", core::PrimitiveKind::triangle);
  add_block("spheres, the whole test", core::PrimitiveKind::sphere);
  add_block("cones, the whole test", core::PrimitiveKind::cone);
}

}  // namespace dmpc::bench
