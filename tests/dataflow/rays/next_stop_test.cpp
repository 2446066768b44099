#include "dataflow/rays/next_stop.h"

#include <doctest/doctest.h>

#include <cstring>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/trace/traversal.h"
#include "dataflow/distribution.h"
#include "dataflow/regions/balance.h"
#include "tests/support/small_scenes.h"
#include "tests/support/surroundings.h"

namespace next_stop_test {

using namespace dmpc;
using core::Traced;
using dataflow::next_stop;

namespace {

/// A hat of which many columns are empty, cut into regions of equal size.
struct Hat {
  explicit Hat(std::uint32_t region_count)
      : scene(tests::built_in("sombrero-1")),
        database(core::build_database(scene, apps::several_macro_cells(scene))),
        settings{database.header(), core::Camera(scene.view, database.header().frame, 24, 24, 1), {}},
        distribution(dataflow::distribute(database, settings,
                                          dataflow::equal_size_bsp(core::grid_size(settings.header.frame),
                                                                   dataflow::axes_facing(settings.camera), region_count))) {}
  const dataflow::Regions& bsp() const { return distribution.regions; }
  dataflow::Surroundings known() const { return tests::surroundings(bsp(), distribution.proxy); }
  /// Which regions are empty, and no more.
  dataflow::Surroundings marks() const { return tests::surroundings(bsp(), unknown); }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
  dataflow::Distribution distribution;
  core::DatabasePart unknown = core::proxy_of(database, 0);
};

/// How a ray ends.
struct End {
  Traced traced = Traced::left;
  core::Hit hit;
  std::uint32_t owners_asked = 0;

  bool operator==(const End& other) const {
    return traced == other.traced && std::memcmp(&hit.t, &other.hit.t, sizeof(hit.t)) == 0 &&
           hit.primitive == other.hit.primitive;
  }
};

/// Takes a ray from region to region to its end, past those of which the surroundings tell that it meets nothing there.
End end_of(const Hat& hat, const core::Ray& ray, core::Passage passage, const dataflow::Surroundings& surroundings) {
  core::Operations operations;
  for (End end;; ++end.owners_asked) {
    const dataflow::NextStop stop = next_stop(ray, passage, surroundings, std::nullopt, operations);
    end.traced = stop.traced;
    end.hit = stop.passage.best;
    if (stop.traced != Traced::left) {
      return end;
    }
    const core::DatabasePart& part = hat.distribution.parts[stop.region];
    core::LocalRecords records(part.bytes);
    core::Cursor cursor = core::arrive(stop.passage);
    end.traced = core::trace(ray, cursor, records, part.header, {}, operations);
    end.hit = cursor.best;
    if (end.traced != Traced::left) {
      return end;
    }
    passage = core::passage_of(cursor);
  }
}

}  // namespace

TEST_CASE("regions that hold nothing are marked, and only those") {
  const Hat hat(24);
  std::uint32_t empty = 0;
  for (std::uint32_t region = 0; region < 24; ++region) {
    const bool holds_nothing = core::extract(hat.database, hat.bsp().region_at(region)).primitive_copies == 0;
    CHECK(hat.bsp().is_empty(region) == holds_nothing);
    empty += holds_nothing ? 1 : 0;
  }
  CHECK(empty > 4);
  CHECK(empty < 20);
}

TEST_CASE("a ray that passes empty regions ends with the bits that it has when every owner is asked") {
  const Hat hat(24);
  const core::GridFrame& frame = hat.settings.header.frame;
  const core::Corner size = core::grid_size(frame);
  const dataflow::Regions unmarked =
      dataflow::equal_size_bsp(core::grid_size(frame), dataflow::axes_facing(hat.settings.camera), 24);
  const dataflow::Surroundings nothing_known = tests::surroundings(unmarked, hat.unknown);
  apps::Random random(20'261);
  std::uint32_t asked = 0, asked_of_all = 0, hits = 0;
  for (int i = 0; i < 4000; ++i) {
    core::Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = static_cast<double>(size[axis]) * double{frame.finest_cell};
      ray.origin[axis] = static_cast<float>(core::plane_at(frame, axis, 0) + extent * (1.6 * random.unit() - 0.3));
      ray.direction[axis] = i % 5 == static_cast<int>(axis) ? 0.0F : static_cast<float>(2 * random.unit() - 1);
    }
    if (const auto first = core::first_passage(ray, frame)) {
      const End end = end_of(hat, ray, *first, hat.marks()), expected = end_of(hat, ray, *first, nothing_known);
      CHECK(end == expected);
      asked += end.owners_asked;
      asked_of_all += expected.owners_asked;
      hits += end.traced == Traced::hit ? 1 : 0;
    }
  }
  CHECK(hits > 50);
  CHECK(asked < asked_of_all / 4 * 3);
}

TEST_CASE("a ray that passes regions where the proxy says that it meets nothing ends with the same bits and asks few owners") {
  const Hat hat(24);
  const core::GridFrame& frame = hat.settings.header.frame;
  const core::DatabasePart coarse = core::proxy_of(hat.database, 3000);
  REQUIRE(coarse.record_bytes < hat.distribution.proxy.record_bytes);
  apps::Random random(20'262);
  std::uint32_t asked = 0, asked_coarsely = 0, asked_by_marks = 0, hits = 0;
  for (int i = 0; i < 4000; ++i) {
    core::Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = static_cast<double>(core::grid_size(frame)[axis]) * double{frame.finest_cell};
      ray.origin[axis] = static_cast<float>(core::plane_at(frame, axis, 0) + extent * (1.6 * random.unit() - 0.3));
      ray.direction[axis] = i % 5 == static_cast<int>(axis) ? 0.0F : static_cast<float>(2 * random.unit() - 1);
    }
    ray.t_max = i % 3 == 0 ? static_cast<float>(random.unit()) : ray.t_max;
    if (const auto first = core::first_passage(ray, frame)) {
      const End expected = end_of(hat, ray, *first, hat.marks());
      const End fine = end_of(hat, ray, *first, hat.known());
      const End rough = end_of(hat, ray, *first, tests::surroundings(hat.bsp(), coarse));
      CHECK(fine == expected);
      CHECK(rough == expected);
      asked += fine.owners_asked;
      asked_coarsely += rough.owners_asked;
      asked_by_marks += expected.owners_asked;
      hits += expected.traced == Traced::hit ? 1 : 0;
    }
  }
  CHECK(hits > 50);
  CHECK(asked < asked_coarsely);
  CHECK(asked_coarsely < asked_by_marks);
  CHECK(asked < asked_by_marks / 2);
}

TEST_CASE("a ray stops in the region of who asks, whatever the proxy says") {
  const Hat hat(24);
  std::uint32_t stopped = 0;
  for (std::uint32_t pixel = 0; pixel < hat.settings.camera.pixel_count(); ++pixel) {
    const core::Ray ray = hat.settings.camera.primary_ray(pixel, 0);
    if (const auto first = core::first_passage(ray, hat.settings.header.frame)) {
      core::Operations operations;
      const std::uint32_t here = hat.bsp().region_index_of(first->cell);
      const dataflow::NextStop stop = next_stop(ray, *first, hat.known(), nodes::NodeId{here}, operations);
      CHECK(stop.traced == Traced::left);
      CHECK(stop.region == here);
      CHECK(operations.bvh_node_reads == 0);
      ++stopped;
    }
  }
  CHECK(stopped > 50);
}

TEST_CASE("a ray that enters a region with records stops there, and nothing is counted") {
  const Hat hat(1);
  const core::Ray ray = hat.settings.camera.primary_ray(300, 0);
  const auto first = core::first_passage(ray, hat.settings.header.frame);
  REQUIRE(first.has_value());
  core::Operations operations;
  const dataflow::NextStop stop = next_stop(ray, *first, hat.marks(), std::nullopt, operations);
  CHECK(stop.traced == Traced::left);
  CHECK(stop.region == 0);
  CHECK(stop.passage.cell == first->cell);
  CHECK(operations.cell_steps == 0);
}

TEST_CASE("where empty regions are not skipped none is marked") {
  const Hat hat(1);
  const dataflow::Regions unmarked =
      dataflow::equal_size_bsp(core::grid_size(hat.settings.header.frame), dataflow::axes_facing(hat.settings.camera), 24);
  core::RenderSettings settings = hat.settings;
  settings.skips.empty_regions = false;
  const dataflow::Distribution plain = dataflow::distribute(hat.database, settings, unmarked);
  for (std::uint32_t region = 0; region < 24; ++region) {
    CHECK_FALSE(plain.regions.is_empty(region));
  }
}

TEST_CASE("a candidate that lies in an empty region is proved there") {
  const Hat hat(24);
  const core::GridFrame& frame = hat.settings.header.frame;
  std::uint32_t proved = 0;
  for (std::uint32_t pixel = 0; pixel < hat.settings.camera.pixel_count(); ++pixel) {
    const core::Ray ray = hat.settings.camera.primary_ray(pixel, 0);
    auto passage = core::first_passage(ray, frame);
    if (passage && hat.bsp().is_empty(hat.bsp().region_index_of(passage->cell))) {
      passage->best.primitive = 7;
      passage->best.t = static_cast<float>(passage->t_enter);
      core::Operations operations;
      proved += next_stop(ray, *passage, hat.marks(), std::nullopt, operations).traced == Traced::hit ? 1 : 0;
    }
  }
  CHECK(proved > 0);
}

}  // namespace next_stop_test
