// Rays side by side meet spheres and cones where each of them does alone, to the bit; the quick test before that drops no hit.
#include "core/trace/curved_lanes.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "apps/lab/bench/stability/random.h"
#include "core/record/curved_values.h"
#include "core/trace/primitive.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace curved_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

/// A leaf of spheres or cones of one family, which lie next to each other.
struct CurvedLeaf {
  CurvedLeaf(Random& random, PrimitiveKind kind, std::size_t count)
      : header{.kind = kind, .count = static_cast<std::uint8_t>(count)},
        middle(random.below(4) == 0 ? Vec3d{} : random.in_box(-1, 1)),
        size(std::ldexp(random.between(0.5, 1), -static_cast<int>(random.below(14)))),
        flatness(std::array{1.0, 1.0, 0.1, 1e-3, 1e-7}[random.below(5)]) {
    std::memcpy(record.data(), &header, sizeof(header));
    for (std::size_t lane = 0; lane < count; ++lane) {
      kind == PrimitiveKind::sphere ? put_sphere(random, lane) : put_cone(random, lane);
      put(value_count(kind), lane, std::bit_cast<float>(10 + 3 * static_cast<std::uint32_t>(lane)));
    }
  }

  void put(std::size_t row, std::size_t lane, float value) {
    std::memcpy(record.data() + sizeof(header) + 4 * (row * header.count + lane), &value, sizeof(value));
  }
  void put(std::size_t row, std::size_t lane, const Vec3d& value) {
    put(row, lane, coordinate_of(value.x));
    put(row + 1, lane, coordinate_of(value.y));
    put(row + 2, lane, coordinate_of(value.z));
  }
  void put_rests(Random& random, std::size_t row, std::size_t lane) {
    put(row, lane, std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())));
  }
  float some_radius(Random& random) const {
    return coordinate_of(size * std::array{1.0, 0.3, 0.01, 0.0}[random.below(4)] * random.between(0.5, 1));
  }

  void put_sphere(Random& random, std::size_t lane) {
    const float radius = some_radius(random);
    put(0, lane, middle + random.in_box(-size, size));
    put(3, lane, random.below(4) == 0 ? -radius : radius);
    put_rests(random, 4, lane);
  }
  /// Cones, cylinders, pointed, thin, flat ones and hollow ones of each.
  void put_cone(Random& random, std::size_t lane) {
    const Vec3d base = middle + random.in_box(-size, size), axis = random.direction() * (size * random.unit() * flatness);
    const float radius = some_radius(random), other = random.below(3) == 0 ? radius : some_radius(random);
    const bool is_flat = random.below(4) == 0, is_hollow = random.below(4) == 0;
    put(0, lane, base);
    put(3, lane, is_hollow ? -radius : radius);
    put(4, lane, is_flat ? axis : base + axis);
    put(7, lane, is_flat == is_hollow ? other : -other);
    put_rests(random, 8, lane);
    put_rests(random, 9, lane);
  }

  const float* rows() const { return reinterpret_cast<const float*>(record.data() + sizeof(header)); }
  float intersect(const Ray& ray, std::size_t lane) const {
    return header.kind == PrimitiveKind::sphere ? intersect_sphere(ray, rows(), header.count, lane)
                                                : intersect_cone(ray, rows(), header.count, lane);
  }

  LeafHeader header;
  Vec3d middle;
  double size, flatness;
  alignas(8) std::array<std::byte, record_bytes_max + overread_bytes> record{};
};

/// Through the leaf, past it, along an axis, from its apex, in its surface, or with odd numbers.
Ray some_ray(Random& random, const CurvedLeaf& leaf) {
  const std::size_t lane = random.below(leaf.header.count);
  const CurvedValues body(leaf.header.kind, leaf.rows(), leaf.header.count, lane);
  const bool is_cone = leaf.header.kind == PrimitiveKind::cone;
  const Vec3d base = body.vector(0), axis = is_cone ? body.axis() : random.direction();
  const double radius = std::fabs(body.value(3));
  const Vec3d side = normalize(cross(axis, random.direction()));
  const Vec3d place = base + axis * random.unit() + side * (radius * std::array{0.0, 1.0, 1.0, 1.5, 4.0}[random.below(5)]);
  Vec3d towards = random.direction();
  switch (random.below(5)) {
    case 0:
      towards = normalize(axis);
      break;
    case 1:
      towards = normalize(cross(side, axis));
      break;
    default:
      break;
  }
  Ray ray;
  const bool is_far = random.below(3) != 0;
  ray.start_at(place - towards * (is_far ? random.between(0, 4) : 0.0));
  ray.go_along(towards);
  ray.kind = random.below(2) == 0 ? RayKind::primary : RayKind::reflected;
  ray.t_max = random.below(3) == 0 ? static_cast<float>(random.between(0, 4)) : endless;
  ray.ignored_primitive = random.below(8) == 0 ? 10 : no_primitive;
  return ray;
}

Ray odd_ray(Random& random, const CurvedLeaf& leaf) {
  constexpr std::array<float, 9> odd{0,      -0.0F,  endless, -endless, std::numeric_limits<float>::quiet_NaN(),
                                     1e-40F, 1e-20F, 1e18F,   2};
  Ray ray = some_ray(random, leaf);
  const float number = odd[random.below(odd.size())];
  Vec3f& changed = random.below(2) == 0 ? ray.origin : ray.direction;
  random.below(2) == 0 ? void(changed = changed * number) : void(changed[random.below(3)] = number);
  return ray;
}

struct Rays {
  std::unique_ptr<RayBundle> bundle = std::make_unique<RayBundle>();
  RayMask asked;

  Rays(Random& random, const CurvedLeaf& leaf, bool are_odd) {
    bundle->count = random.below(bundle_rays_max) + 1;
    asked = bundle->all() & ~random.below(1U << bundle_rays_max);
    bundle->found = 0;
    for (std::size_t i = 0; i < bundle_rays_max; ++i) {
      const Ray ray = are_odd ? odd_ray(random, leaf) : some_ray(random, leaf);
      bundle->rays[i] = ray;
      bundle->t_max[i] = ray.t_max;
      bundle->ignored_primitive[i] = ray.ignored_primitive;
      bundle->best.set(i, random.below(4) == 0 ? Hit{static_cast<float>(random.between(0, 4)), 12, Address{1}} : Hit{});
    }
  }
};

/// By the scalar twins alone.
Hit met_alone(const CurvedLeaf& leaf, const Ray& ray, Hit best) {
  for (std::uint32_t lane = 0; lane < leaf.header.count; ++lane) {
    const float t = leaf.intersect(ray, lane);
    const std::uint32_t id = 10 + 3 * lane;
    if (t > 0.0F && t < ray.t_max && id != ray.ignored_primitive && nearer(t, id, best)) {
      best = {t, id, Address{5}, lane};
    }
  }
  return best;
}

bool are_same(const Hit& one, const Hit& other) {
  return std::bit_cast<std::uint32_t>(one.t) == std::bit_cast<std::uint32_t>(other.t) && one.primitive == other.primitive &&
         one.leaf == other.leaf && one.lane == other.lane;
}

template <class Check>
void for_some_leaves(std::uint64_t seed, const Check& check) {
  Random random(seed);
  for (std::size_t turn = 0; turn < ray_count(40'000); ++turn) {
    const PrimitiveKind kind = turn % 3 == 0 ? PrimitiveKind::sphere : PrimitiveKind::cone;
    const CurvedLeaf leaf(random, kind, random.below(leaf_lanes) + 1);
    check(leaf, Rays(random, leaf, turn % 4 == 0));
  }
}

}  // namespace

TEST_CASE("rays side by side hit spheres and cones where each does alone, whatever instructions the processor has") {
  for (std::size_t rank = 0; curved_reach(rank) != nullptr; ++rank) {
    for (auto width = static_cast<int>(vector_width()); width >= 0; --width) {
      CAPTURE(rank);
      CAPTURE(width);
      std::size_t differences = 0, hits = 0;
      for_some_leaves(81, [&](const CurvedLeaf& leaf, const Rays& rays) {
        RayBundle bundle = *rays.bundle;
        hit_curved(bundle, leaf.record.data(), Address{5}, rays.asked, curved_reach(rank),
                   VectorWidth{static_cast<std::uint8_t>(width)});
        for (std::size_t i = 0; i < bundle_rays_max; ++i) {
          const Hit before = rays.bundle->best.of(i);
          const bool is_asked = (rays.asked >> i & 1U) != 0;
          const Hit expected = is_asked ? met_alone(leaf, bundle.rays[i], before) : before;
          const bool is_found = (bundle.found >> i & 1U) != 0;
          differences += are_same(bundle.best.of(i), expected) && is_found == !are_same(expected, before) ? 0 : 1;
          hits += is_found ? 1 : 0;
        }
      });
      CHECK(differences == 0);
      CHECK(hits > ray_count(40'000) / 2);
    }
  }
}

TEST_CASE("the quick test of spheres and cones drops no hit, and most of what is not hit") {
  for (std::size_t rank = 0; curved_reach(rank) != nullptr; ++rank) {
    CAPTURE(rank);
    std::size_t lost = 0, reached = 0, tried = 0, hits = 0;
    for_some_leaves(82, [&](const CurvedLeaf& leaf, const Rays& rays) {
      for (std::size_t i = 0; i < bundle_rays_max; ++i) {
        const Ray& ray = rays.bundle->rays[i];
        const float t_most = std::min(ray.t_max, rays.bundle->best.t[i]);
        RayMask mask = 0;
        curved_reach(rank)({leaf.header.kind, leaf.rows(), leaf.header.count}, &ray, 1, &t_most, &mask);
        for (std::size_t lane = 0; lane < leaf.header.count; ++lane) {
          const float t = leaf.intersect(ray, lane);
          const bool is_hit = t > 0.0F && t <= t_most, is_reached = (mask >> lane & 1U) != 0;
          lost += is_hit && !is_reached ? 1 : 0;
          hits += is_hit ? 1 : 0;
          reached += is_reached ? 1 : 0;
          ++tried;
        }
        CHECK((mask >> leaf.header.count) == 0);
      }
    });
    CHECK(lost == 0);
    CHECK(reached < tried / 2);
    CHECK(hits > tried / 50);
  }
}

}  // namespace curved_test
