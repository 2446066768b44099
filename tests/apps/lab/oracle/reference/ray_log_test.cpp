#include "apps/lab/oracle/reference/ray_log.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/apps/lab/oracle/reference/workbench.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::ray_log_test {
namespace {

using apps::LoggedRay;
using apps::ProductLog;
using apps::RayLog;
using core::RayKind;

bool same_way(const RayLog& a, const RayLog& b) {
  return std::equal(a.rays.begin(), a.rays.end(), b.rays.begin(), b.rays.end(), [](const LoggedRay& one, const LoggedRay& other) {
    return one.path == other.path && one.agrees_with(other);
  });
}

TEST_CASE("both renderers' logs name the same rays alike and in the same order") {
  const Workbench bench(mirrors_and_glass(), 24);
  std::uint32_t alike = 0;
  for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
    alike += same_way(bench.logger.log_of(pixel), bench.reference_log_of_rays(pixel)) ? 1 : 0;
  }
  CHECK(alike > bench.pixel_count() * 49 / 50);
}

TEST_CASE("no two rays of a pixel have the same path, and every ray's maker hit") {
  const Workbench bench(mirrors_and_glass(), 16);
  for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
    const ProductLog log = bench.logger.log_of(pixel);
    std::set<std::uint64_t> paths;
    for (const LoggedRay& ray : log.rays) {
      REQUIRE(paths.insert(ray.path).second);
      REQUIRE((ray.kind == RayKind::primary) == (ray.maker == 0));
      REQUIRE((ray.maker == 0 || log.find(ray.maker)->hit));
    }
  }
}

TEST_CASE("the product's log has the rays and the light of its renderer") {
  const Workbench bench(mirrors_and_glass(), 16);
  core::LocalRecords records(bench.database.bytes());
  core::GridTracer tracer(records, bench.settings.header, core::Skips{});
  core::Operations operations;
  const core::Film film = core::render(tracer, bench.settings, operations);
  std::uint64_t rays = 0;
  for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
    const ProductLog log = bench.logger.log_of(pixel);
    REQUIRE(log.radiance == film.radiance(pixel));
    REQUIRE(log.shots.size() == log.rays.size());
    rays += log.rays.size();
  }
  CHECK(rays == operations.rays[0] + operations.rays[1] + operations.rays[2] + operations.rays[3]);
}

TEST_CASE("a shot in world coordinates is the accurate renderer's ray but for rounding") {
  const Workbench bench(mirrors_and_glass(), 8);
  const apps::ReferenceRay shot = bench.logger.log_of(20).shots.front(), right = bench.primary(20);
  CHECK(length(shot.origin - right.origin) < 1e-5);
  CHECK(length(shot.direction - right.direction) < 1e-6);
}

TEST_CASE("two lights in one place are told apart by their order") {
  core::Scene scene;
  scene.view.from = {0, 0, 5};
  scene.lights = {{{1, 2, 3}}, {{1, 2, 3}}};
  core::SceneBuilder builder(scene);
  builder.polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}});
  const Workbench bench(scene, 1);
  const ProductLog log = bench.logger.log_of(0);
  REQUIRE(log.rays.size() == 3);
  CHECK(log.rays[1].light == 0);
  CHECK(log.rays[2].light == 1);
  CHECK(same_way(log, bench.reference_log_of_rays(0)));
}

TEST_CASE("a ray that hits another body goes by another path from there on") {
  const core::Scene scene = mirrors_and_glass();
  core::Scene other = scene;
  std::swap(other.objects[0], other.objects[1]);
  const Workbench bench(scene, 8), swapped(other, 8);
  const RayLog a = bench.reference_log_of_rays(60), b = swapped.reference_log_of_rays(60);
  REQUIRE(a.rays.size() > 1);
  CHECK(a.rays[0].path == b.rays[0].path);
  CHECK_FALSE(a.rays[0].agrees_with(b.rays[0]));
  CHECK(b.find(a.rays[1].path) == nullptr);
}

TEST_CASE("each primitive of the database is one body, in order") {
  for (const char* name : {"rings-1-t1", "teapot-3", "jacks-2", "mount-3"}) {
    CAPTURE(std::string(name));
    const Workbench bench(built_in(name), 1);
    const std::vector<std::uint32_t> bodies = apps::bodies_of_primitives(bench.reference, bench.database);
    for (std::uint32_t primitive = 0; primitive < bodies.size(); ++primitive) {
      REQUIRE(bodies[primitive] == primitive);
    }
  }
}

TEST_CASE("a triangle that only double precision can see is no primitive, and those after it keep their bodies") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (const double at : {0.4, 0.6}) {  // in two places: about one of them floats would see it
    builder.polygon({{at, at, at}, {at + 1e-12, at, at}, {at, at + 1e-12, at}});
  }
  builder.sphere({0, 0, 1}, 0.5);
  const Workbench bench(scene, 1);
  CHECK(bench.reference.bodies.size() == 4);
  CHECK(apps::bodies_of_primitives(bench.reference, bench.database) == std::vector<std::uint32_t>{0, 3});
}

}  // namespace
}  // namespace dmpc::tests::ray_log_test
