#include "apps/lab/oracle/reference/step_audit.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/lab/oracle/reference/tracer.h"
#include "tests/apps/lab/oracle/reference/workbench.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/small_scenes.h"
#include "tests/support/text.h"

namespace dmpc::tests::step_audit_test {
namespace {

using apps::Audit;
using apps::ProductLog;
using core::RayKind;

struct Audited : Workbench {
  Audited(const core::Scene& given, int side) : Audited(given, given, side) {}
  Audited(const core::Scene& given, const core::Scene& for_reference, int side)
      : Workbench(given, for_reference, side), audit(database, settings.shade, reference, finder) {}

  Audit of(std::uint32_t pixel) const { return audit.of(logger.log_of(pixel), primary(pixel)); }
  /// What is wrong with a log that `change` falsified.
  template <class Change>
  std::string error_of(std::uint32_t pixel, const Change& change) const {
    ProductLog log = logger.log_of(pixel);
    change(log);
    return audit.of(log, primary(pixel)).error;
  }
  /// A pixel whose first hit is mirrored, with a ray of this kind.
  std::uint32_t pixel_with(RayKind kind) const {
    for (std::uint32_t pixel = 0; pixel < pixel_count(); ++pixel) {
      for (const apps::LoggedRay& ray : logger.log_of(pixel).rays) {
        if (ray.kind == kind) {
          return pixel;
        }
      }
    }
    return 0;
  }

  apps::StepAudit audit;
};

/// The first ray of a kind.
std::size_t index_of(const ProductLog& log, RayKind kind) {
  std::size_t index = 0;
  while (log.rays[index].kind != kind) {
    ++index;
  }
  return index;
}

TEST_CASE("every step of the product is right but for rounding, in glass and where surfaces have what only mesh files say, too") {
  std::vector<core::Scene> scenes = {mirrors_and_glass(), mesh_surfaces()};
  for (const char* name : {"balls-3", "gears-1", "jacks-2", "lattice-3", "mount-3", "rings-2", "shells-3", "sombrero-1",
                           "teapot-4", "tetra-3", "tree-5"}) {
    scenes.push_back(built_in(name));
  }
  for (const core::Scene& scene : scenes) {
    CAPTURE(scene.name);
    const Audited bench(scene, 24);
    for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
      CAPTURE(pixel);
      const Audit audit = bench.of(pixel);
      REQUIRE(audit.error == "");
      REQUIRE(audit.doubts.size() == bench.logger.log_of(pixel).rays.size());
    }
  }
}

TEST_CASE("a ray with another direction, start, weight or end is found") {
  const Audited bench(mirrors_and_glass(), 24);
  for (const RayKind kind : {RayKind::primary, RayKind::reflected, RayKind::refracted, RayKind::shadow}) {
    const std::uint32_t pixel = bench.pixel_with(kind);
    const auto falsified = [&](const auto& change) {
      return bench.error_of(pixel, [&](ProductLog& log) { change(log.shots[index_of(log, kind)]); });
    };
    CHECK(contains(falsified([](apps::ReferenceRay& ray) {
                     ray.direction = normalize(ray.direction + core::Vec3d{1e-4, 0, 0});
                   }),
                   "off by"));
    CHECK(contains(falsified([](apps::ReferenceRay& ray) { ray.origin.y += 1e-3; }), "off by"));
    CHECK(contains(falsified([](apps::ReferenceRay& ray) { ray.weight = ray.weight + core::Vec3d{0, 1e-3, 0}; }), "off by"));
  }
  CHECK(contains(bench.error_of(bench.pixel_with(RayKind::shadow),
                                [](ProductLog& log) { log.shots[index_of(log, RayKind::shadow)].t_max *= 0.9; }),
                 "another end"));
}

TEST_CASE("a ray too many and a ray too few are found") {
  const Audited bench(mirrors_and_glass(), 24);
  const std::uint32_t pixel = bench.pixel_with(RayKind::reflected);
  const auto forget = [](ProductLog& log) {
    const auto at = static_cast<std::ptrdiff_t>(index_of(log, RayKind::shadow));
    log.rays.erase(log.rays.begin() + at);
    log.shots.erase(log.shots.begin() + at);
  };
  CHECK(contains(bench.error_of(pixel, forget), "is missing"));
  const auto mistake = [](ProductLog& log) { log.shots[index_of(log, RayKind::reflected)].kind = RayKind::refracted; };
  CHECK(contains(bench.error_of(pixel, mistake), "should not be there"));
}

TEST_CASE("an answer that no ray beside it has is found") {
  const Audited bench(mirrors_and_glass(), 24);
  const auto miss = [](ProductLog& log) { log.rays.front().hit = false; };
  CHECK(contains(bench.error_of(bench.pixel_with(RayKind::reflected), miss), "no ray has"));
}

TEST_CASE("a hit on the far side of a ball is found, though all that follows from it is right") {
  core::Scene scene;
  scene.view.from = {0.1, 0, 5};
  scene.lights = {{{1, 2, 5}}};
  core::SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  const Audited bench(scene, 1);
  const auto cross = [&](ProductLog& log) {
    log.rays.resize(1);
    log.shots.resize(1);
    apps::ReferenceRay behind = log.shots.front();
    behind.origin = behind.origin + behind.direction * (log.rays.front().t + 1e-3);
    log.rays.front().t += 1e-3 + distance_to(bench.reference.bodies[0], behind).value();
    const apps::ReferenceTracer tracer(bench.reference, bench.finder, bench.settings.shade);
    for (const apps::ReferenceRay& ray : tracer.spawned(log.shots.front(), {log.rays.front().t, 0})) {
      log.rays.push_back({.path = log.rays.size(), .maker = log.rays.front().path, .kind = ray.kind, .light = ray.light});
      log.rays.back().hit = bench.finder.any(ray).found();
      log.shots.push_back(ray);
    }
    REQUIRE(log.rays.size() == 2);
  };
  CHECK(bench.of(0).error == "");
  CHECK(bench.error_of(0, cross) == "a primary ray of depth 1 that hits its body where no ray does that runs beside it");
}

TEST_CASE("shading by another material is found") {
  const core::Scene scene = mirrors_and_glass();
  core::Scene shinier = scene;
  for (core::Material& material : shinier.materials) {
    material.shine += 1;
  }
  const Audited bench(scene, shinier, 24);
  std::uint32_t found = 0;
  for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
    found += contains(bench.of(pixel).error, "a shadow ray") ? 1 : 0;
  }
  CHECK(found > 20);
}

/// Glass triangles, one so far below the other.
core::Scene pane(std::initializer_list<double> heights) {
  core::Scene scene;
  scene.view = {.from = {0.1, 0.2, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 20};
  scene.background = {0.2, 0.3, 0.4};
  core::SceneBuilder builder(scene);
  builder.material({.diffuse = 0.1, .transmittance = 0.8, .refraction_index = 1.5});
  for (const double height : heights) {
    builder.polygon({{-1, -1, height}, {1, -1, height}, {0, 1, height}});
  }
  return scene;
}

TEST_CASE("a start beyond a face that is left out is found, however near the face is to the surface left") {
  CHECK(Audited(pane({0}), 1).of(0).error == "");
  CHECK(contains(Audited(pane({0}), pane({0, -1e-7}), 1).of(0).error, "a refracted ray of depth 2 that starts behind something"));
}

TEST_CASE("what lies between a far eye and the start of its ray is found") {
  const auto far = [](std::initializer_list<double> heights) {
    core::Scene scene = pane(heights);
    scene.view.from = {0.1, 0.2, 500};
    scene.view.angle_degrees = 0.2;
    return scene;
  };
  CHECK(Audited(far({0}), 1).of(0).error == "");
  CHECK(Audited(far({0}), far({0, 400}), 1).of(0).error == "a primary ray of depth 1 that starts behind something");
}

/// A ball seen from above that ends there on the right.
core::Scene ball_to(double x) {
  core::Scene scene;
  scene.view = {.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 20};
  core::SceneBuilder builder(scene);
  builder.sphere({x - 1, 0, 0}, 1);
  return scene;
}

TEST_CASE("what is farther off than sixteen pixels is wrong, whatever was said") {
  constexpr int side = 96;  // a pixel is 0.0186 wide
  constexpr std::uint32_t middle = side / 2 * side + side / 2;
  const auto audit_of = [](double end) {
    const Workbench bench(ball_to(0.1), ball_to(end), side);
    const apps::StepAudit audit(bench.database, bench.settings.shade, bench.reference, bench.finder, 100);
    return audit.of(bench.logger.log_of(middle), bench.primary(middle));
  };
  CHECK(audit_of(-0.15).is_warned);
  CHECK(audit_of(-0.15).error == "");
  CHECK(contains(audit_of(-0.6).error, "whose answer no ray has"));
}

TEST_CASE("a ray that misses everything is right") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.sphere({50, 0, 0}, 1);
  const Audit audit = Audited(scene, 1).of(0);
  CHECK(audit.error == "");
  CHECK(audit.doubts.size() == 1);
}

}  // namespace
}  // namespace dmpc::tests::step_audit_test
