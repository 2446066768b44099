// Rays that leave a surface do not meet it again.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "apps/lab/bench/stability/children.h"
#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace self_hits_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

const Material mirror{.specular = 0.5, .shine = 10};

/// A convex body under eight lights that surround it.
template <class Add>
Scene lit(Add add_body) {
  Scene scene;
  SceneBuilder builder(scene);
  for (std::uint32_t i = 0; i < 8; ++i) {
    builder.light({.position = {(i & 1U) != 0 ? 9.0 : -8.0, (i & 2U) != 0 ? 7.0 : -9.0, (i & 4U) != 0 ? 8.0 : -7.0}});
  }
  builder.material(mirror);
  add_body(builder);
  return seen_from(scene, 2);
}

Scene lit_mesh(const Mesh& mesh) {
  return lit([&](SceneBuilder& builder) {
    for (const auto& t : mesh.triangles) {
      builder.polygon({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
  });
}

struct Count {
  std::size_t children = 0, self_hits = 0;
};

void shoot_children(const Database& database, const Ray& ray, const Hit& hit, Count& count) {
  for (const Ray& child : children_of(database, ray, hit)) {
    ++count.children;
    count.self_hits += shoot(database, child).found() ? 1 : 0;
  }
}

/// Next to an edge rounding may order two hits the wrong way, and the ray meets the far triangle from within.
bool from_outside(const Database& database, const Ray& ray, const Hit& hit) {
  const PrimitiveValues& triangle = database.primitives()[hit.primitive];
  const Vec3d a = triangle.vector(0);
  return triangle.kind != PrimitiveKind::triangle ||
         dot(Vec3d(ray.direction), cross(triangle.vector(3) - a, triangle.vector(6) - a)) < 0;
}

/// From outside onto a convex body: no child may hit anything.
Count self_hits(const Scene& scene, std::size_t rays) {
  const Database database = database_of(scene);
  const GridFrame& frame = database.header().frame;
  Random random(41);
  Count count;
  for (std::size_t i = 0; i < rays; ++i) {
    const Ray ray = ray_through(to_local(frame, random.direction() * 4.0), to_local(frame, random.in_box(-0.9, 0.9)));
    const Hit hit = shoot(database, ray);
    if (hit.found() && from_outside(database, ray, hit)) {
      shoot_children(database, ray, hit, count);
    }
  }
  return count;
}

/// Hits of rays that meet random triangles at `rise` (the sine of the angle to their plane), also next to their edges.
Count grazing_self_hits(const Scene& scene, double rise, std::size_t rays) {
  const Database database = database_of(scene);
  Random random(42);
  Count count;
  for (std::size_t i = 0; i < rays; ++i) {
    const auto& triangle = database.primitives()[random.below(database.primitives().size())];
    const Vec3d a = triangle.vector(0), b = triangle.vector(3), c = triangle.vector(6);
    const Vec3d normal = normalize(cross(b - a, c - a)), along = normalize(cross(normal, random.direction()));
    const double u = i % 3 == 0 ? 1e-6 : random.unit(), v = random.unit() * (1 - u);
    const Vec3d target = a + (b - a) * u + (c - a) * v;
    const Ray ray = ray_through(target - (along - normal * rise) * 1.5, target);
    const Hit hit = shoot(database, ray);
    if (hit.found() && from_outside(database, ray, hit)) {
      shoot_children(database, ray, hit, count);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("children of hits on convex meshes hit nothing") {
  for (const Mesh& mesh : {cube(), tetrahedron(), sphere_mesh(12, 16, 0), sphere_mesh(40, 60, 0)}) {
    const Count count = self_hits(lit_mesh(mesh), scaled(30'000));
    CHECK(count.self_hits == 0);
    CHECK(count.children > 0);
  }
}

TEST_CASE("children of grazing hits on convex meshes hit nothing") {
  for (const double degrees : {1.0, 0.1, 0.01}) {
    CAPTURE(degrees);
    for (const Mesh& mesh : {cube(), tetrahedron(), sphere_mesh(12, 16, 0)}) {
      const Count count = grazing_self_hits(lit_mesh(mesh), degrees / 57.29577951, scaled(20'000));
      CHECK(count.self_hits == 0);
      CHECK(count.children > 0);
    }
  }
}

TEST_CASE("children of hits on a sphere and on a cylinder hit nothing") {
  const Scene sphere = lit([](SceneBuilder& builder) { builder.sphere({0, 0, 0}, 1); });
  CHECK(self_hits(sphere, scaled(50'000)).self_hits == 0);
  const Scene small = lit([](SceneBuilder& builder) {
    builder.sphere({0, 0, 0}, 0.01);
    builder.polygon({{-9, -9, -9}, {9, -9, -9}, {0, 9, -9}});
  });
  const Database database = database_of(small);
  const GridFrame& frame = database.header().frame;
  Random random(43);
  Count count;
  for (std::size_t i = 0; i < scaled(20'000); ++i) {
    const Ray ray = ray_through(to_local(frame, random.direction() * 4.0), to_local(frame, random.in_box(-0.01, 0.01)));
    const Hit hit = shoot(database, ray);
    if (hit.found() && hit.primitive == 0) {
      for (const Ray& child : children_of(database, ray, hit)) {
        const Hit next = shoot(database, child);
        ++count.children;
        count.self_hits += next.found() && next.primitive == 0 ? 1 : 0;
      }
    }
  }
  CHECK(count.self_hits == 0);
  CHECK(count.children > 0);
}

TEST_CASE("children of hits on the outside of a cylinder do not hit it") {
  const Scene scene = lit([](SceneBuilder& builder) { builder.cone({0, 0, -1}, 0.5, {0.2, 0.1, 1}, 0.5); });
  const Database database = database_of(seen_from(scene, 1));
  const GridFrame& frame = database.header().frame;
  Random random(44);
  std::size_t self_hits = 0, outside = 0;
  for (std::size_t i = 0; i < scaled(50'000); ++i) {
    const double angle = 6.28 * random.unit();  // never through the open ends
    const Vec3d from{4 * std::cos(angle), 4 * std::sin(angle), random.between(-0.8, 0.8)};
    const Ray ray = ray_through(to_local(frame, from), to_local(frame, random.in_box(-0.4, 0.4)));
    const Hit hit = shoot(database, ray);
    if (hit.found()) {
      ++outside;
      for (const Ray& child : children_of(database, ray, hit)) {
        self_hits += shoot(database, child).found() ? 1 : 0;
      }
    }
  }
  CHECK(self_hits == 0);
  CHECK(outside > 0);
}

TEST_CASE("two sheets a ten-thousandth apart stay separate") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({.position = {0.3, 0.2, 5}});
  builder.material(mirror);
  for (const double z : {0.0, 1e-4}) {
    builder.polygon({{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}});
  }
  const Database database = database_of(seen_from(scene, 1));
  const GridFrame& frame = database.header().frame;
  Random random(45);
  std::size_t passed = 0, blocked_above = 0, between = 0;
  for (std::size_t i = 0; i < scaled(20'000); ++i) {
    const Vec3d at{random.between(-0.45, 0.45), random.between(-0.45, 0.45), 5e-5};
    const Ray down = ray_through(to_local(frame, at), to_local(frame, {at.x, at.y, -1}));
    const Hit lower = shoot(database, down);
    for (const Ray& child : children_of(database, down, lower)) {
      ++between;  // the shadow ray and the reflected one
      passed += shoot(database, child).found() ? 0 : 1;
    }
    const Ray from_above = ray_through(to_local(frame, {at.x, at.y, 1}), to_local(frame, at));
    for (const Ray& child : children_of(database, from_above, shoot(database, from_above))) {
      blocked_above += shoot(database, child).found() ? 1 : 0;
    }
  }
  CHECK(passed == 0);
  CHECK(blocked_above == 0);
  CHECK(between == 2 * scaled(20'000));
}

}  // namespace self_hits_test
