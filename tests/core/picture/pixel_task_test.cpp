#include "core/picture/pixel_task.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/lab/bench/stability/mesh.h"
#include "core/base/expect.h"
#include "tests/support/shooting.h"

namespace pixel_task_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// Holds one record, the one fetched last, for one question.
class LastRecord {
 public:
  explicit LastRecord(const Database& database) : all_(database.bytes()) {}
  const std::byte* find(Address address) {
    const bool held = address == held_;
    held_ = no_address;
    return held ? all_.find(address) : nullptr;
  }
  void fetch(Address address) { held_ = address; }

 private:
  LocalRecords all_;
  Address held_ = no_address;
};

/// A glass ball in a box of mirrors under three lights.
Scene hall_of_mirrors() {
  Scene scene;
  SceneBuilder builder(scene);
  for (const double x : {-0.5, 0.0, 0.5}) {
    builder.light({.position = {x, 0.9, 0.3}});
  }
  builder.material({.specular = 0.9, .shine = 5});
  add(scene, cube());
  builder.material({.specular = 0.5, .transmittance = 0.5, .refraction_index = 1.3});
  builder.sphere({0, 0, -0.4}, 0.3);
  scene.view = {.from = {0.1, 0.2, 0.9}, .at = {0, 0, -0.4}, .up = {0, 1, 0}};
  return scene;
}

RenderSettings settings_of(const Database& database, const Scene& scene, int samples, int depth_max) {
  return {database.header(), Camera(scene.view, database.header().frame, 4, 4, samples), {.depth_max = depth_max}};
}

/// Runs a pixel to its end over memory for one record; counts how often it had to wait.
PixelSums starved(const Database& database, const RenderSettings& settings, std::uint32_t pixel, Operations& operations,
                  int& waits) {
  LastRecord records(database);
  GridTracer<LastRecord> tracer(records, database.header(), {});
  std::vector<HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  PixelTask task(stack);
  task.start(pixel, settings.first_samples(), settings, operations);
  for (;;) {
    switch (task.run(tracer, settings, operations)) {
      case TaskState::finished:
        return task.sums();
      case TaskState::absent:
        ++waits;
        records.fetch(task.absent());
        break;
      case TaskState::more:
        break;
    }
  }
}

PixelSums fed(const Database& database, const RenderSettings& settings, std::uint32_t pixel, Operations& operations) {
  LocalRecords records(database.bytes());
  GridTracer<LocalRecords> tracer(records, database.header(), {});
  std::vector<HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  PixelTask task(stack);
  task.start(pixel, settings.first_samples(), settings, operations);
  while (task.run(tracer, settings, operations) != TaskState::finished) {
  }
  return task.sums();
}

}  // namespace

TEST_CASE("a pixel that waits for every record gets the same light and counts the same work") {
  const Scene scene = hall_of_mirrors();
  const Database database = database_of(scene);
  const RenderSettings settings = settings_of(database, scene, 2, 6);
  Operations once, often;
  int waits = 0;
  for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
    CHECK(fed(database, settings, pixel, once) == starved(database, settings, pixel, often, waits));
  }
  CHECK(waits > 0);
  CHECK(once.rays == often.rays);
  CHECK(once.cell_steps == often.cell_steps);
  CHECK(once.shadings == often.shadings);
}

TEST_CASE("a stack of a hit a depth is enough, a smaller one is refused") {
  const Scene scene = hall_of_mirrors();
  const Database database = database_of(scene);
  for (int depth = 1; depth <= 8; ++depth) {
    Operations operations;
    CHECK_NOTHROW(fed(database, settings_of(database, scene, 1, depth), 5, operations));
  }
  std::vector<HitState> stack(4);
  PixelTask task(stack);
  Operations operations;
  CHECK_THROWS_AS(task.start(0, {}, settings_of(database, scene, 1, 5), operations), InternalError);
}

TEST_CASE("rays that hit nothing bring the background, each sample to its plane") {
  Scene scene;
  SceneBuilder(scene).background({0.25, 0.5, 0.75});
  const Database database = database_of(scene);
  Operations operations;
  const PixelSums sums = fed(database, settings_of(database, scene, 4, 5), 3, operations);
  CHECK(sums.plane[0] == to_fixed({0.75F, 1.5F, 2.25F}));
  CHECK(sums.plane[1] == to_fixed({0.25F, 0.5F, 0.75F}));
  CHECK(operations.rays[0] == 4);
}

TEST_CASE("where the background shows no tracer is asked, and rays count and leave light as if it were") {
  const Scene scene = hall_of_mirrors();
  const Database database = database_of(scene);
  RenderSettings settings = settings_of(database, scene, 3, 5);
  settings.header.background = {0.25F, 0.5F, 0.75F};
  BackgroundTiles::Bits bits{};
  bits[16] = std::uint64_t{1} << 32U;  // pixel 6 of 4x4: 16 tiles a pixel
  settings.background = BackgroundTiles(settings.camera, bits);
  LastRecord nothing(database);
  GridTracer<LastRecord> tracer(nothing, database.header(), {});
  std::vector<HitState> stack(5);
  PixelTask task(stack);
  Operations operations;
  task.start(6, settings.first_samples(), settings, operations);
  for (int ray = 0; ray < 3; ++ray) {
    CHECK(task.run(tracer, settings, operations) == TaskState::more);
  }
  CHECK(task.run(tracer, settings, operations) == TaskState::finished);
  CHECK(task.sums().plane[0] == to_fixed({0.5F, 1, 1.5F}));
  CHECK(task.sums().plane[1] == to_fixed({0.25F, 0.5F, 0.75F}));
  CHECK(operations.rays[0] == 3);
  CHECK(operations.skipped.background == 3);
  CHECK(operations.cell_steps == 0);
  task.start(5, settings.first_samples(), settings, operations);
  CHECK(task.run(tracer, settings, operations) == TaskState::absent);
  settings = settings.with_every_ray_traced();
  task.start(6, settings.first_samples(), settings, operations);
  CHECK(task.run(tracer, settings, operations) == TaskState::absent);
}

TEST_CASE("one call ends at most one ray") {
  const Scene scene = hall_of_mirrors();
  const Database database = database_of(scene);
  const RenderSettings settings = settings_of(database, scene, 1, 5);
  LocalRecords records(database.bytes());
  GridTracer<LocalRecords> tracer(records, database.header(), {});
  std::vector<HitState> stack(5);
  PixelTask task(stack);
  Operations operations;
  task.start(6, settings.first_samples(), settings, operations);
  std::uint64_t calls = 0;
  while (task.run(tracer, settings, operations) != TaskState::finished) {
    ++calls;
  }
  CHECK(calls == operations.rays[0] + operations.rays[1] + operations.rays[2] + operations.rays[3]);
  CHECK(operations.primary_hits + operations.secondary_hits == operations.shadings);
}

}  // namespace pixel_task_test
