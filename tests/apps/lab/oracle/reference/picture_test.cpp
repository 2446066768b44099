#include "apps/lab/oracle/reference/picture.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::reference_picture_test {
namespace {

using apps::ReferencePicture;
using core::Vec3d;

ReferencePicture reference(const core::Scene& scene, int side, std::uint32_t samples = 1, const core::ShadeOptions& shade = {},
                           const apps::Attendance& attendance = {}) {
  const apps::ReferenceScene doubled = apps::reference_scene(scene);
  const apps::ReferenceFinder finder(doubled, scene.view.from);
  return render_accurately(doubled, finder, apps::ReferenceCamera(scene.view, side, side),
                           apps::SamplePattern::of_product(samples), shade, attendance);
}

core::Film of_product(const core::Scene& scene, int side, int samples, const core::ShadeOptions& shade) {
  const core::Database database = core::build_database(scene, {});
  const core::RenderSettings settings{database.header(), core::Camera(scene.view, database.header().frame, side, side, samples),
                                      shade};
  core::LocalRecords records(database.bytes());
  core::GridTracer tracer(records, settings.header, core::Skips{});
  core::Operations operations;
  return core::render(tracer, settings, operations);
}

/// Pixels with a channel that is off by more than 1e-4.
int differing(const core::Scene& scene, int side, int samples, const core::ShadeOptions& shade = {}) {
  const ReferencePicture picture = reference(scene, side, static_cast<std::uint32_t>(samples), shade);
  const core::Film film = of_product(scene, side, samples, shade);
  int count = 0;
  for (std::uint32_t pixel = 0; pixel < picture.radiance.size(); ++pixel) {
    const Vec3d off = film.radiance(pixel) - picture.radiance[pixel];
    count += std::fabs(off.x) > 1e-4 || std::fabs(off.y) > 1e-4 || std::fabs(off.z) > 1e-4 ? 1 : 0;
  }
  return count;
}

TEST_CASE("the picture is the product's but for rounding") {
  for (const char* name : {"balls-2", "gears-2", "jacks-2", "lattice-3", "mount-4", "mount-3-t2", "rings-2", "rings-1-t1",
                           "shells-3", "sombrero-1", "teapot-4", "tetra-4", "tree-5"}) {
    CAPTURE(std::string(name));
    const core::Scene scene = built_in(name);
    CHECK(differing(scene, 48, 1, {.depth_max = 2}) <= 11);  // out of 2304
    CHECK(differing(scene, 48, 1, {.convention = core::Convention::paper, .depth_max = 2}) <= 11);
    // Each small ball that a ray is mirrored by multiplies what float lost before.
    CHECK(differing(scene, 48, 1) <= 46);
  }
}

TEST_CASE("the picture is the product's with its samples, too") { CHECK(differing(mirrors_and_glass(), 32, 4) <= 8); }

TEST_CASE("one core renders the bits that all cores render") {
  const core::Scene scene = mirrors_and_glass();
  const ReferencePicture all = reference(scene, 24, 3);
  tbb::task_arena alone(1);
  const ReferencePicture one = alone.execute([&] { return reference(scene, 24, 3); });
  CHECK(one.radiance == all.radiance);
  CHECK(one.rays == all.rays);
  CHECK(all.rays > 24 * 24 * 3);
}

TEST_CASE("progress ends with all rows") {
  std::vector<std::uint64_t> reported;
  reference(mirrors_and_glass(), 20, 1, {}, {.progress = [&](std::uint64_t done, std::uint64_t) { reported.push_back(done); }});
  REQUIRE(reported.size() > 2);
  CHECK(reported.front() == 0);
  CHECK(reported.back() == 20);
}

TEST_CASE("a stop ends the picture") {
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(reference(mirrors_and_glass(), 20, 1, {}, {.stop = source.get_token()}), apps::Interrupted);
}

}  // namespace
}  // namespace dmpc::tests::reference_picture_test
