#include "core/picture/hits/lanes.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/base/elementary.h"
#include "core/base/sampling.h"
#include "core/picture/hits/hit_geometry.h"
#include "core/picture/hits/hit_lanes.h"
#include "core/picture/lights/light_fall.h"
#include "core/record/record.h"

namespace lanes_test {

using namespace dmpc::core;

namespace {

/// Numbers without an end, of all sizes that coordinates have, and zeros.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() { return state_ = mix(state_ + 1); }
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  double around_zero() { return bits() % 16 == 0 ? 0.0 : (unit() - 0.5) * (bits() % 8 == 0 ? 0x1p-40 : 1.0); }
  Vec3d vector() { return {around_zero(), around_zero(), around_zero()}; }
  Vec3d direction() {
    const Vec3d v = vector();
    return length(v) > 0 ? normalize(v) : Vec3d{0, 0, 1};
  }

 private:
  std::uint64_t state_;
};

std::vector<VectorWidth> widths() {
  std::vector<VectorWidth> all{VectorWidth::any};
  for (const VectorWidth width : {VectorWidth::bits_256, VectorWidth::bits_512}) {
    if (width <= vector_width()) {
      all.push_back(width);
    }
  }
  return all;
}

HitState lit_hit(Numbers& numbers) {
  HitState state;
  state.point = numbers.vector();
  state.normal = numbers.direction();
  state.geometric_normal = numbers.bits() % 2 == 0 ? state.normal : numbers.direction();
  state.ray.go_along(numbers.direction());
  const double along = numbers.unit() * 0x1p-20;
  state.clearance = numbers.bits() % 2 == 0 ? Clearance::of_flat(along) : Clearance{along, along * 0x1p-18, numbers.unit()};
  state.surface = {};
  constexpr std::array<float, 6> shines{0, 1, 3.0827F, 30.5F, 1e4F, 3e38F};
  state.surface.material.shine = shines[numbers.bits() % shines.size()];
  return state;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_bits(const Vec3d& a, const Vec3d& b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z); }

bool same_fall(const LightFall& a, const LightFall& b) {
  return same_bits(a.towards, b.towards) && same_bits(a.cosine, b.cosine);
}

static_assert(sizeof(Ray) == 20 * sizeof(float), "no byte of a ray is without meaning");
bool same_ray(const Ray& a, const Ray& b) { return std::memcmp(&a, &b, sizeof(Ray)) == 0; }

double highlight_of(const HitState& state, const LightFall& fall) {
  return pow_unit(lobe_cosine(state.ray.full_direction(), state.normal, fall.towards), double{state.surface.material.shine});
}

/// A hit that sends both a mirrored and a refracted ray: within glass, or on the way into it.
HitState sending_hit(Numbers& numbers) {
  HitState state = lit_hit(numbers);
  state.leaving = numbers.bits() % 2 == 0;
  state.surface.material.refraction_index = numbers.bits() % 8 == 0 ? 0.0F : 1.5F;
  if (refracted_cosine_squared(state.ray.full_direction(), state.normal, relative_index(state)) < 0.0) {
    state.normal = -state.ray.full_direction();
  }
  return state;
}

constexpr std::size_t leaf_triangles = 8;

/// A leaf of triangles, some of them needles, and rays at their insides, edges and corners, or past them.
struct Leaf {
  explicit Leaf(Numbers& numbers) : record(leaf_bytes(PrimitiveKind::triangle, leaf_triangles)) {
    const LeafHeader header{.kind = PrimitiveKind::triangle, .count = leaf_triangles};
    std::memcpy(record.data(), &header, sizeof(header));
    for (std::size_t lane = 0; lane < leaf_triangles; ++lane) {
      const Vec3d corner = numbers.vector(), edge = numbers.vector() + Vec3d{0.25, 0, 0};
      const Vec3d third = edge * numbers.unit() + numbers.vector() * (lane % 2 == 0 ? 0x1p-18 : 1.0) + Vec3d{0, 0x1p-20, 0};
      put_corners(lane, {Vec3f(corner), Vec3f(corner + edge), Vec3f(corner + third)});
    }
  }

  void put_corners(std::size_t lane, const std::array<Vec3f, 3>& corners) {
    for (std::size_t row = 0; row < 9; ++row) {
      const float value = corners[row / 3][row % 3];
      std::memcpy(record.data() + sizeof(LeafHeader) + 4 * (row * leaf_triangles + lane), &value, sizeof(value));
    }
    triangle[lane] = corners;
  }

  HitState hit(Numbers& numbers) const {
    HitState state;
    state.hit.lane = static_cast<std::uint32_t>(numbers.bits() % leaf_triangles);
    const auto& [a, b, c] = triangle[state.hit.lane];
    constexpr std::array<double, 5> weights{0, 1, 0.5, 0x1p-30, -0.25};
    const double u = numbers.bits() % 2 == 0 ? numbers.unit() : weights[numbers.bits() % weights.size()];
    const double v = numbers.bits() % 2 == 0 ? (1 - u) * numbers.unit() : weights[numbers.bits() % weights.size()];
    const Vec3d place = Vec3d(a) * (1 - u - v) + Vec3d(b) * u + Vec3d(c) * v;
    const Vec3d towards = numbers.bits() % 16 == 0 ? normalize(Vec3d(b) - Vec3d(a)) : numbers.direction();
    const double t = numbers.unit();
    state.ray.start_at(place - towards * t);
    state.ray.go_along(towards);
    state.hit.t = static_cast<float>(t);
    return state;
  }

  std::vector<std::byte> record;
  std::array<std::array<Vec3f, 3>, leaf_triangles> triangle;
};

}  // namespace

TEST_CASE("a light falls on hits side by side as on each alone, with the same shadow rays, by vectors of any width") {
  Numbers numbers(19);
  int aimed_anew = 0, aimed_once = 0;
  for (int round = 0; round < 2000; ++round) {
    LitLanes lanes;
    std::vector<HitState> hits(numbers.bits() % bundle_rays_max + 1);
    for (HitState& state : hits) {
      state = lit_hit(numbers);
      lanes.add(state);
    }
    const Vec3d light = numbers.bits() % 16 == 0 ? hits.front().point : numbers.vector() * 4.0;
    for (const VectorWidth width : widths()) {
      lanes.light(light, width);
      bool all_same = true;
      for (std::size_t lane = 0; lane < hits.size(); ++lane) {
        const HitState& state = hits[lane];
        const Vec3d way = light - state.point;
        const double distance = length(way);
        const LightFall fall{direction_of(way, distance), dot(direction_of(way, distance), state.normal)};
        const RayStart start = start_towards(fall.towards, state.geometric_normal, state.clearance);
        Ray alone, beside;
        aim_shadow(alone, light, state.point, state.geometric_normal, fall.towards, distance, start);
        lanes.set_way(lane, beside);
        all_same = all_same && same_fall(lanes.fall(lane), fall) && same_ray(beside, alone) &&
                   same_bits(lanes.highlight(lane), highlight_of(state, fall));
        aimed_anew += start.across != 0.0 ? 1 : 0;
        aimed_once += start.across == 0.0 ? 1 : 0;
      }
      CAPTURE(round);
      CAPTURE(static_cast<int>(width));
      CHECK(all_same);
    }
  }
  CHECK(aimed_anew > 1000);
  CHECK(aimed_once > 1000);
}

TEST_CASE("hits side by side mirror and bend rays as each does alone, by vectors of any width") {
  Numbers numbers(20);
  for (int round = 0; round < 2000; ++round) {
    ChildLanes lanes;
    std::vector<HitState> hits(numbers.bits() % bundle_rays_max + 1);
    for (HitState& state : hits) {
      state = sending_hit(numbers);
      lanes.add(state, relative_index(state));
    }
    const auto as_alone = [&](auto direction_of) {
      bool all_same = true;
      for (std::size_t lane = 0; lane < hits.size(); ++lane) {
        const HitState& state = hits[lane];
        const Vec3d towards = normalize(direction_of(state));
        Ray alone, beside;
        leave(alone, state.point, state.geometric_normal, towards,
              start_towards(towards, state.geometric_normal, state.clearance));
        lanes.set_way(lane, beside);
        all_same = all_same && same_ray(beside, alone);
      }
      return all_same;
    };
    for (const VectorWidth width : widths()) {
      CAPTURE(round);
      CAPTURE(static_cast<int>(width));
      lanes.mirror(width);
      CHECK(as_alone([](const HitState& state) { return mirrored_direction(state.ray.full_direction(), state.normal); }));
      lanes.bend(width);
      CHECK(as_alone(
          [](const HitState& state) { return bent_direction(state.ray.full_direction(), state.normal, relative_index(state)); }));
    }
  }
}

TEST_CASE("the geometry of hits of triangles is the same side by side as of each alone, by vectors of any width") {
  Numbers numbers(21);
  for (int round = 0; round < 2000; ++round) {
    const Leaf leaf(numbers);
    std::vector<HitState> hits(numbers.bits() % bundle_rays_max + 1);
    for (HitState& state : hits) {
      state = leaf.hit(numbers);
    }
    for (const VectorWidth width : widths()) {
      std::vector<HitState> beside = hits;
      TriangleLanes lanes;
      for (HitState& state : beside) {
        REQUIRE(lanes.take(state, leaf.record.data()));
      }
      lanes.read_all(width);
      bool all_same = true;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        HitState alone = hits[i];
        read_geometry(alone, leaf.record.data());
        all_same = all_same && std::memcmp(&alone, &beside[i], sizeof(alone)) == 0;
      }
      CAPTURE(round);
      CAPTURE(static_cast<int>(width));
      CHECK(all_same);
    }
  }
}

TEST_CASE("hits of what is curved, or whose plane is shared, or whose geometry is known, are not read side by side") {
  Numbers numbers(23);
  Leaf leaf(numbers);
  HitState state = leaf.hit(numbers);
  TriangleLanes lanes;
  state.stage = HitState::Stage::material;
  CHECK_FALSE(lanes.take(state, leaf.record.data()));
  state.stage = HitState::Stage::geometry;
  for (const LeafHeader& header :
       {LeafHeader{.kind = PrimitiveKind::triangle, .count = leaf_triangles, .plane = LeafHeader::shared_plane},
        LeafHeader{.kind = PrimitiveKind::sphere, .count = 1}, LeafHeader{.kind = PrimitiveKind::cone, .count = 1}}) {
    std::memcpy(leaf.record.data(), &header, sizeof(header));
    CHECK_FALSE(lanes.take(state, leaf.record.data()));
  }
}

}  // namespace lanes_test
