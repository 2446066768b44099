#include "core/picture/bundle_task.h"

#include <doctest/doctest.h>

#include <memory>
#include <numeric>
#include <vector>

#include "apps/lab/bench/stability/rays.h"
#include "core/base/expect.h"
#include "core/picture/camera/background.h"
#include "core/picture/render.h"
#include "tests/support/film_of.h"
#include "tests/support/same_sums.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace picture_bundle_task_test {

using namespace dmpc;
using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr int tiled_side = 24;

struct TiledPicture {
  explicit TiledPicture(const Scene& scene, int samples = 1, const ShadeOptions& shade = {})
      : database(database_of(scene)),
        settings{database.header(), Camera(scene.view, database.header().frame, tiled_side, tiled_side, samples), shade} {}

  Database database;
  RenderSettings settings;
};

/// Runs a task to its end; counts how often it had to wait.
template <class Records>
int run_to_end(BundleTask& task, Records& records, const RenderSettings& settings, Operations& operations) {
  GridTracer<Records> tracer(records, settings.header, settings.skips);
  for (int waits = 0;;) {
    switch (task.run(tracer, settings, operations)) {
      case TaskState::finished:
        return waits;
      case TaskState::absent:
        ++waits;
        if constexpr (requires { records.fetch(task.absent()); }) {
          records.fetch(task.absent());
        }
        break;
      case TaskState::more:
        CHECK(task.rays_ended() <= bundle_rays_max);
        break;
    }
  }
}

/// The picture in tiles of `width` pixels side by side.
template <class Records>
Film tiled(const TiledPicture& subject, std::uint32_t width, Operations& operations, int& waits) {
  Film film(tiled_side, tiled_side);
  Records records = [&] {
    if constexpr (std::is_same_v<Records, LocalRecords>) {
      return LocalRecords(subject.database.bytes());
    } else {
      return apps::OneRecord(subject.database.bytes());
    }
  }();
  std::vector<BundleHit> stack(static_cast<std::size_t>(subject.settings.shade.depth_max));
  const auto task = std::make_unique<BundleTask>(stack);
  for (std::uint32_t first = 0; first < tiled_side * tiled_side; first += width) {
    std::vector<std::uint32_t> pixels(std::min<std::uint32_t>(width, tiled_side * tiled_side - first));
    std::iota(pixels.begin(), pixels.end(), first);
    const std::vector<SampleStep> steps(pixels.size(), SampleStep::first());
    task->start(pixels, steps, subject.settings, operations);
    waits += run_to_end(*task, records, subject.settings, operations);
    for (std::uint32_t place = 0; place < task->pixel_count(); ++place) {
      film.deposit(task->pixel(place), task->sums(place));
    }
  }
  return film;
}

void check_same_picture(const TiledPicture& subject, std::uint32_t width) {
  CAPTURE(width);
  Operations alone, together;
  int waits = 0;
  CHECK(same_sums(tiled<LocalRecords>(subject, width, together, waits), film_of(subject.database, subject.settings, alone)));
  CHECK(together.rays == alone.rays);
  CHECK(together.primary_hits == alone.primary_hits);
  CHECK(together.secondary_hits == alone.secondary_hits);
  CHECK(together.shadow_blocked == alone.shadow_blocked);
  CHECK(together.shadings == alone.shadings);
  CHECK(together.texture_lookups == alone.texture_lookups);
  CHECK(together.tile_reads == alone.tile_reads);
  CHECK(together.rays_cut == alone.rays_cut);
  CHECK(together.skipped.unlit == alone.skipped.unlit);
  CHECK(together.skipped.zero_terms == alone.skipped.zero_terms);
  CHECK(together.skipped.background == alone.skipped.background);
}

}  // namespace

TEST_CASE("pixels in bundles are the picture, whatever the bundles' width") {
  for (const auto& scene : {everything(), built_in("teapot-3"), built_in("tetra-3")}) {
    const TiledPicture subject(scene);
    for (const std::uint32_t width : {1U, 2U, 7U, 16U}) {
      check_same_picture(subject, width);
    }
  }
}

TEST_CASE("samples of several pixels share a bundle, and more than 16 go on in rounds") {
  const Scene scene = everything();
  check_same_picture(TiledPicture(scene, 2), 8);
  check_same_picture(TiledPicture(scene, 2), 16);
  check_same_picture(TiledPicture(scene, 5), 3);
  check_same_picture(TiledPicture(scene, 5), 16);
  check_same_picture(TiledPicture(scene, 16), 1);
  check_same_picture(TiledPicture(scene, 17), 1);
  check_same_picture(TiledPicture(scene, 40), 1);
}

/// Notes how many rays the bundles have that it is asked to trace.
struct CountingTracer {
  bool trace(RayBundle& bundle, Operations& operations) {
    if (bundle.rays[0].kind == RayKind::primary && bundle.stage == RayBundle::Stage::start) {
      primary.push_back(bundle.count);
    }
    return grid.trace(bundle, operations);
  }
  const std::byte* find(Address address) { return grid.find(address); }

  GridTracer<LocalRecords> grid;
  std::vector<std::uint32_t> primary;
};

TEST_CASE("pixels that are to have different samples share bundles, all but the last of which are full, with the light of each") {
  const TiledPicture subject(everything(), 2);
  const std::vector<std::uint32_t> pixels{5, 29, 30, 301, 302};
  const std::vector<SampleStep> steps{{1, 2}, {0, 3}, {1, 3}, {2, 5}, {1, 2}};  // 2, 8, 6, 28 and 2 samples
  LocalRecords records(subject.database.bytes());
  CountingTracer tracer{GridTracer<LocalRecords>(records, subject.settings.header, subject.settings.skips), {}};
  std::vector<BundleHit> stack(5);
  std::vector<HitState> lone_stack(5);
  const auto task = std::make_unique<BundleTask>(stack);
  PixelTask alone(lone_stack);
  Operations operations;
  task->start(pixels, steps, subject.settings, operations);
  while (task->run(tracer, subject.settings, operations) != TaskState::finished) {
  }
  CHECK(tracer.primary == std::vector<std::uint32_t>{16, 16, 14});
  for (std::uint32_t place = 0; place < pixels.size(); ++place) {
    CHECK(task->sums(place) ==
          render_pixel(alone, pixels[place], steps[place].samples(2), tracer.grid, subject.settings, operations));
  }
}

TEST_CASE("bundles follow the paper's convention, depths, cutoffs and skips that are off") {
  const Scene scene = everything();
  check_same_picture(TiledPicture(scene, 1, {.convention = Convention::paper}), 16);
  check_same_picture(TiledPicture(scene, 1, {.depth_max = 1}), 16);
  check_same_picture(TiledPicture(scene, 1, {.depth_max = 9}), 16);
  check_same_picture(TiledPicture(scene, 1, {.cutoff = 0.1, .radiance_bound = radiance_bound(scene, 5)}), 16);
  TiledPicture without(scene);
  without.settings.skips = no_skips();
  check_same_picture(without, 16);
}

TEST_CASE("a picture without lights, and one of a thousand, come in bundles, too") {
  Scene dark = built_in("teapot-3");
  dark.lights.clear();
  check_same_picture(TiledPicture(dark), 16);
  check_same_picture(TiledPicture(thousand_lights()), 16);
}

TEST_CASE("pixels known to show the background are not traced, alone or beside others") {
  TiledPicture subject(built_in("tetra-3"));
  subject.settings.background = find_background(subject.database, subject.settings.camera);
  check_same_picture(subject, 16);
  Operations operations;
  int waits = 0;
  tiled<LocalRecords>(subject, 16, operations, waits);
  CHECK(operations.skipped.background > 100);
}

TEST_CASE("bundles that wait for every record give the same light, count the same work and look up as often") {
  const TiledPicture subject(everything(), 1, {.pixel_share = 1});
  Operations once, often;
  int never = 0, waits = 0;
  CHECK(same_sums(tiled<LocalRecords>(subject, 16, once, never), tiled<apps::OneRecord>(subject, 16, often, waits)));
  CHECK(never == 0);
  CHECK(waits > 1000);
  CHECK(once.tile_reads > 2 * once.texture_lookups);
  CHECK(once.tile_reads == often.tile_reads);
  CHECK(once.rays == often.rays);
  check_same_traversal(once, often);
  CHECK(once.skipped.bundles == often.skipped.bundles);
  CHECK(once.bundles == often.bundles);
}

TEST_CASE("more pixels than a bundle has rays are refused, as is a stack of less than a hit a depth") {
  const TiledPicture subject(built_in("teapot-3"), 2);
  std::vector<BundleHit> stack(5), small(4);
  BundleTask task(stack), lacking(small);
  Operations operations;
  const std::vector<std::uint32_t> all(bundle_rays_max + 1);
  const std::vector<SampleStep> all_steps(all.size(), SampleStep::first());
  const std::span<const std::uint32_t> pixels(all);
  const std::span<const SampleStep> steps(all_steps);
  CHECK_THROWS_AS(task.start(pixels, steps, subject.settings, operations), InternalError);
  CHECK_THROWS_AS(task.start(pixels.first(0), steps.first(0), subject.settings, operations), InternalError);
  CHECK_THROWS_AS(task.start(pixels.first(2), steps.first(3), subject.settings, operations), InternalError);
  CHECK_NOTHROW(task.start(pixels.first(16), steps.first(16), subject.settings, operations));
  CHECK_THROWS_AS(lacking.start(pixels.first(16), steps.first(16), subject.settings, operations), InternalError);
}

}  // namespace picture_bundle_task_test
