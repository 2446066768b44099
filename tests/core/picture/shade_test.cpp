#include "core/picture/shade.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/scene/scene.h"
#include "tests/support/shooting.h"

namespace shade_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

struct Shaded {
  std::vector<Ray> children;
  Operations operations;

  std::vector<Ray> of(RayKind kind) const {
    std::vector<Ray> some;
    std::copy_if(children.begin(), children.end(), std::back_inserter(some), [&](const Ray& ray) { return ray.kind == kind; });
    return some;
  }
};

/// Shades what `ray` hits, to the end.
Shaded shaded(const Database& database, const Ray& ray, const ShadeOptions& options = {}, const Skips& skips = {}) {
  const LocalRecords records(database.bytes());
  const Hit hit = shoot(database, ray);
  REQUIRE(hit.found());
  Shaded result;
  HitState state = begin_shading(ray, hit);
  const Shader shader(database.header(), options, skips, result.operations);
  while (state.stage != HitState::Stage::finished) {
    const Address needed = record_needed(state, database.header());
    Ray child;
    if (shader.step(state, needed == no_address ? nullptr : records.find(needed), child)) {
      result.children.push_back(child);
    }
  }
  return result;
}

/// A floor in z = 0 whose normal is +z, under the lights.
Scene floor_scene(const Material& material, const std::vector<Vec3d>& lights) {
  Scene scene;
  SceneBuilder builder(scene);
  for (const Vec3d& position : lights) {
    builder.light({.position = position, .color = {1, 1, 1}, .has_color = true});
  }
  builder.material(material);
  builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  return seen_from(scene, 2);
}

/// From `offset` towards the floor's middle.
Ray towards_middle(const Database& database, const Vec3d& offset) {
  const GridFrame& frame = database.header().frame;
  return ray_through(to_local(frame, offset), to_local(frame, {0, 0, 0}));
}

void check_direction(const Ray& ray, const Vec3d& wanted) {
  const Vec3d unit = normalize(wanted), d(ray.direction);
  CHECK(d.x == doctest::Approx(unit.x).epsilon(1e-5).scale(1));
  CHECK(d.y == doctest::Approx(unit.y).epsilon(1e-5).scale(1));
  CHECK(d.z == doctest::Approx(unit.z).epsilon(1e-5).scale(1));
}

}  // namespace

TEST_CASE("a mirror reflects at the angle of incidence with the weight Ks") {
  const Database database = database_of(floor_scene({.specular = 0.25}, {}));
  const Shaded result = shaded(database, towards_middle(database, {-1, 0, 1}));
  REQUIRE(result.children.size() == 1);
  const Ray& child = result.children[0];
  CHECK(child.kind == RayKind::reflected);
  check_direction(child, {1, 0, 1});
  CHECK(child.weight == Color{0.25F, 0.25F, 0.25F});
  CHECK(child.depth == 2);
  CHECK(child.ignored_primitive != no_primitive);
}

TEST_CASE("a ray that can bring less than the cutoff is not shot, and one that can bring as much is") {
  const Database database = database_of(floor_scene({.specular = 0.25}, {{0, 0, 1}}));
  const auto children = [&](double cutoff) {
    return shaded(database, towards_middle(database, {-1, 0, 1}), {.cutoff = cutoff, .radiance_bound = 2});
  };
  CHECK(children(0).children.size() == 2);
  CHECK(children(0.5).of(RayKind::reflected).size() == 1);  // 0.25 of at most 2
  const Shaded cut = children(0.500001);
  CHECK(cut.of(RayKind::reflected).empty());
  CHECK(cut.of(RayKind::shadow).size() == 1);
  CHECK(cut.operations.rays_cut == 1);
  CHECK(children(10).children.empty());
  CHECK(children(10).operations.rays_cut == 2);
}

TEST_CASE("no ray finds more light than a bound by the scene's lights, materials and depth") {
  Scene scene =
      floor_scene({.color = {0.5, 1, 0}, .diffuse = 0.5, .specular = 0.25, .transmittance = 0.5}, {{0, 0, 1}, {1, 0, 1}});
  CHECK(radiance_bound(scene, 1) == doctest::Approx(1.5));  // two lights, 0.5 diffuse and 0.25 in the highlight
  CHECK(radiance_bound(scene, 2) == doctest::Approx(1.5));
  CHECK(radiance_bound(scene, 3) == doctest::Approx(1.5 + 0.75 * 1.5));
  scene.ambient = {0.5, 1, 0.25};
  CHECK(radiance_bound(scene, 1) == doctest::Approx(2));  // and 0.5 of the ambient light
  scene.background = {0, 9, 0};
  CHECK(radiance_bound(scene, 2) == doctest::Approx(9));
  CHECK(radiance_bound(scene, 3) == doctest::Approx(9));
  CHECK(radiance_bound(scene, 5) == doctest::Approx(9));
  CHECK(radiance_bound(Scene{}, 5) == 0);
}

TEST_CASE("a ray into glass bends by Snell's law") {
  const Database database = database_of(floor_scene({.transmittance = 0.5, .refraction_index = 1.5}, {}));
  const auto refracted = shaded(database, towards_middle(database, {-1, 0, 1})).of(RayKind::refracted);
  REQUIRE(refracted.size() == 1);
  const double sine = std::sqrt(0.5) / 1.5;
  check_direction(refracted[0], {sine, 0, -std::sqrt(1 - sine * sine)});
  CHECK(refracted[0].weight == Color{0.5F, 0.5F, 0.5F});
}

TEST_CASE("a ray out of glass bends the other way") {
  const Database database = database_of(floor_scene({.transmittance = 0.5, .refraction_index = 1.5}, {}));
  const auto refracted = shaded(database, towards_middle(database, {-0.2, 0, -1})).of(RayKind::refracted);
  REQUIRE(refracted.size() == 1);
  const double sine = 1.5 * 0.2 / std::sqrt(1.04);
  check_direction(refracted[0], {sine, 0, std::sqrt(1 - sine * sine)});
}

TEST_CASE("beyond the critical angle everything is reflected") {
  const Database database = database_of(floor_scene({.specular = 0.25, .transmittance = 0.5, .refraction_index = 1.5}, {}));
  const Shaded result = shaded(database, towards_middle(database, {-1, 0, -1}));
  REQUIRE(result.children.size() == 1);
  check_direction(result.children[0], {1, 0, -1});
  CHECK(result.children[0].weight == Color{0.75F, 0.75F, 0.75F});
  CHECK(result.operations.total_internal_reflections == 1);
}

TEST_CASE("an index of 1 does not bend") {
  const Database database = database_of(floor_scene({.transmittance = 1, .refraction_index = 1}, {}));
  const auto refracted = shaded(database, towards_middle(database, {-1, 0.5, 1})).of(RayKind::refracted);
  REQUIRE(refracted.size() == 1);
  check_direction(refracted[0], {1, -0.5, -1});
}

TEST_CASE("a light brings Kd times the cosine and the colours") {
  const Database database = database_of(floor_scene({.color = {1, 0.5, 0}, .diffuse = 0.5}, {{1, 0, 1}}));
  const auto shadows = shaded(database, towards_middle(database, {0, 0, 1})).of(RayKind::shadow);
  REQUIRE(shadows.size() == 1);
  check_direction(shadows[0], {1, 0, 1});
  CHECK(shadows[0].weight.x == doctest::Approx(0.5 * std::sqrt(0.5)));
  CHECK(shadows[0].weight.y == doctest::Approx(0.25 * std::sqrt(0.5)));
  CHECK(shadows[0].weight.z == 0);
  CHECK(double{shadows[0].t_max} == doctest::Approx(std::sqrt(2.0) * database.header().frame.scale).epsilon(1e-4));
  CHECK(shadows[0].depth == 1);
}

TEST_CASE("the highlight is Ks where the mirrored ray meets the light") {
  const Database database = database_of(floor_scene({.diffuse = 0, .specular = 0.5, .shine = 20}, {{1, 0, 1}}));
  const auto shadows = shaded(database, towards_middle(database, {-1, 0, 1})).of(RayKind::shadow);
  REQUIRE(shadows.size() == 1);
  CHECK(shadows[0].weight.x == doctest::Approx(0.5).epsilon(1e-4));
}

TEST_CASE("a light behind the surface gets no shadow ray by haines, a dark one by paper") {
  const Database database = database_of(floor_scene({}, {{0, 0, -1}, {0, 0, 1}}));
  const Ray ray = towards_middle(database, {0.3, 0, 1});
  CHECK(shaded(database, ray).of(RayKind::shadow).size() == 1);
  const auto both = shaded(database, ray, {.convention = Convention::paper}).of(RayKind::shadow);
  REQUIRE(both.size() == 2);
  CHECK(both[0].weight == Color{});
  CHECK(both[1].weight.x > 0);
}

TEST_CASE("both sides of a polygon are lit") {
  const Database database = database_of(floor_scene({}, {{0, 0, -1}}));
  CHECK(shaded(database, towards_middle(database, {0.3, 0, -1})).of(RayKind::shadow).size() == 1);
}

TEST_CASE("at the depth limit a hit casts shadow rays only") {
  const Database database = database_of(floor_scene({.specular = 1, .transmittance = 1}, {{0, 0, 1}}));
  Ray ray = towards_middle(database, {0.3, 0, 1});
  CHECK(shaded(database, ray, {.depth_max = 2}).children.size() == 3);
  CHECK(shaded(database, ray, {.depth_max = 1}).children.size() == 1);
  ray.depth = 5;
  CHECK(shaded(database, ray, {.depth_max = 5}).children.size() == 1);
}

TEST_CASE("a thousand lights are taken one a step") {
  std::vector<Vec3d> lights(1000, Vec3d{0, 0, 1});
  const Database database = database_of(floor_scene({}, lights));
  CHECK(shaded(database, towards_middle(database, {0.3, 0, 1})).of(RayKind::shadow).size() == 1000);
}

TEST_CASE("a patch blends its normals") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.specular = 1});
  builder.patch({{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, {{-1, 0, 1}, {1, 0, 1}, {0, 0, 3}});
  const Database database = database_of(seen_from(scene, 2));
  const auto reflected = shaded(database, towards_middle(database, {0, 0, 1})).of(RayKind::reflected);
  REQUIRE(reflected.size() == 1);
  check_direction(reflected[0], {0, 0, 1});
  const GridFrame& frame = database.header().frame;
  const Ray aside = ray_through(to_local(frame, {-0.9, -0.95, 1}), to_local(frame, {-0.9, -0.95, 0}));
  CHECK(shaded(database, aside).of(RayKind::reflected)[0].direction.x < -0.5F);
}

TEST_CASE("spheres and cones have their normals outwards and may be met again") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.specular = 1});
  builder.sphere({0, 0, 0}, 0.5);
  builder.cone({3, 0, -1}, 0.5, {3, 0, 1}, 0.5);
  const Database database = database_of(scene);
  const GridFrame& frame = database.header().frame;
  const double h = std::sqrt(0.125);
  const Ray at_sphere = ray_through(to_local(frame, {h, 0, 2}), to_local(frame, {h, 0, 0}));
  const auto from_sphere = shaded(database, at_sphere).of(RayKind::reflected);
  REQUIRE(from_sphere.size() == 1);
  check_direction(from_sphere[0], {1, 0, 0});
  CHECK(from_sphere[0].ignored_primitive == no_primitive);
  const Ray at_cone = ray_through(to_local(frame, {3 - h, 2, 0}), to_local(frame, {3 - h, 0, 0}));
  const auto from_cone = shaded(database, at_cone).of(RayKind::reflected);
  REQUIRE(from_cone.size() == 1);
  check_direction(from_cone[0], {-1, 0, 0});
}

TEST_CASE("a ray starts along its way off the point of the hit, and off what it grazes") {
  const Database database = database_of(floor_scene({.specular = 1}, {}));
  const GridFrame& frame = database.header().frame;
  for (const double rise : {1.0, 0.2, 1e-2, 1e-5}) {
    const Vec3d target{0.3, -0.2, 0};  // on no edge
    const Ray parent = ray_through(to_local(frame, target + Vec3d{-0.7, 0.1, 0.7 * rise}), to_local(frame, target));
    const auto mirrored = shaded(database, parent).of(RayKind::reflected);
    REQUIRE(mirrored.size() == 1);
    const Vec3d start = mirrored[0].full_origin() - to_local(frame, target), along = mirrored[0].full_direction();
    const double off = length(start - along * dot(start, along));
    CHECK(start.z >= 0x1p-27);
    CHECK(length(start) < 0x1p-16);
    CHECK(off < (rise > 0.15 ? 1e-8 : 0x1p-19));
  }
}

TEST_CASE("a ray off a sphere leads to where it would from the very point, whatever it grazes") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.specular = 1});
  builder.sphere({0, 0, 0}, 0.5);
  const Database database = database_of(scene);
  const GridFrame& frame = database.header().frame;
  const Vec3d center = to_local(frame, {0, 0, 0});
  for (const double height : {0.0, 0.3, 0.49, 0.4999}) {
    Ray parent;
    parent.start_at(to_local(frame, {0, height, 3}));
    parent.go_along({0, 0, -1});
    const auto mirrored = shaded(database, parent).of(RayKind::reflected);
    REQUIRE(mirrored.size() == 1);
    const double y = height * frame.scale, radius = 0.5 * frame.scale, z = std::sqrt(radius * radius - y * y);
    const Vec3d normal = Vec3d{0, y, z} * (1 / radius), towards = normal * (2 * normal.z) - Vec3d{0, 0, 1};
    const Vec3d from_point = mirrored[0].full_origin() - center - Vec3d{0, y, z};
    CHECK(length(mirrored[0].full_direction() - towards) < 1e-7);
    CHECK(length(from_point - towards * dot(from_point, towards)) < 1e-9);
    CHECK(dot(from_point, normal) > 0);
  }
}

TEST_CASE("light is clamped in its brightest channel once two surfaces have sent it on, and never unasked") {
  const Color light{4, 2, 1};
  const auto left = [&light](RayKind kind, std::uint8_t depth, float clamp) {
    Ray ray;
    ray.kind = kind;
    ray.depth = depth;
    return clamped(ray, light, {.clamp = clamp});
  };
  CHECK(left(RayKind::scattered, 3, 0) == light);
  CHECK(left(RayKind::primary, 1, 2) == light);
  CHECK(left(RayKind::scattered, 2, 2) == light);
  CHECK(left(RayKind::shadow, 1, 2) == light);
  CHECK(left(RayKind::scattered, 3, 8) == light);
  CHECK(left(RayKind::scattered, 3, 2) == Color{2, 1, 0.5F});
  CHECK(left(RayKind::reflected, 3, 2) == Color{2, 1, 0.5F});
  CHECK(left(RayKind::shadow, 2, 2) == Color{2, 1, 0.5F});
}

}  // namespace shade_test
