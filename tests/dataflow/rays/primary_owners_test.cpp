#include "dataflow/rays/primary_owners.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/database/database.h"
#include "core/picture/camera/background.h"
#include "core/trace/traversal.h"
#include "dataflow/distribution.h"
#include "dataflow/rays/next_stop.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/regions/balance.h"
#include "tests/support/small_scenes.h"
#include "tests/support/surroundings.h"

namespace primary_owners_test {

using namespace dmpc;
using dataflow::Bsp;

namespace {

/// A hat of which many columns are empty, looked at in some way, and its regions for several computers.
struct SharedHat {
  SharedHat(const core::View& view, int side_pixels, int samples, const std::vector<std::uint32_t>& region_counts)
      : scene(tests::built_in("sombrero-1")),
        database(core::build_database(scene, apps::several_macro_cells(scene))),
        settings{.header = database.header(),
                 .camera = core::Camera(view, database.header().frame, side_pixels, side_pixels - 4, samples)} {
    settings.background = core::find_background(database, settings.camera);
    for (const std::uint32_t count : region_counts) {
      dataflow::Regions bsp =
          dataflow::equal_size_bsp(core::grid_size(settings.header.frame), dataflow::axes_facing(settings.camera), count);
      dataflow::measure_parts(database, settings, bsp);
      bsps.push_back(bsp);
    }
  }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
  std::vector<dataflow::Regions> bsps;
};

/// From region to region, as rays travel.
std::uint32_t owner_by_next_stop(const SharedHat& hat, const dataflow::Regions& bsp, std::uint32_t pixel, std::uint32_t sample) {
  const core::GridFrame& frame = hat.settings.header.frame;
  const core::Ray ray = hat.settings.camera.primary_ray(pixel, sample);
  if (const auto passage = core::first_passage(ray, frame); passage && !hat.settings.shows_background(pixel)) {
    core::Operations operations;
    const dataflow::NextStop stop = tests::next_stop_without_proxy(ray, *passage, frame, bsp, operations);
    if (stop.traced == core::Traced::left) {
      return nodes::index_of(bsp.owner_of(stop.passage.cell));
    }
  }
  std::vector<std::uint32_t> occupied;
  for (std::uint32_t node = 0; node < bsp.region_count(); ++node) {
    if (!bsp.is_empty(bsp.bsp()->region_index_of(nodes::NodeId{node}))) {
      occupied.push_back(node);
    }
  }
  return occupied[std::uint64_t{pixel} * occupied.size() / hat.settings.camera.pixel_count()];
}

/// How many rays pass regions that hold nothing in the last Bsp.
int check_owners(const SharedHat& hat) {
  dataflow::PrimaryOwners owners(hat.settings, hat.bsps);
  int passed = 0;
  for (std::uint32_t pixel = 0; pixel < hat.settings.camera.pixel_count(); ++pixel) {
    for (std::uint32_t sample = 0; sample < static_cast<std::uint32_t>(hat.settings.camera.samples()); ++sample) {
      owners.find(pixel, pixel, sample);
      for (std::size_t i = 0; i < hat.bsps.size(); ++i) {
        CHECK(owners.owners()[i] == owner_by_next_stop(hat, hat.bsps[i], pixel, sample));
      }
      const auto first = core::first_passage(hat.settings.camera.primary_ray(pixel, sample), hat.settings.header.frame);
      passed += first && hat.bsps.back().is_empty(hat.bsps.back().region_index_of(first->cell)) ? 1 : 0;
    }
  }
  return passed;
}

core::View looking(const core::Vec3d& from, const core::Vec3d& at, double angle_degrees) {
  return {.from = from, .at = at, .up = {0, 0, 1}, .angle_degrees = angle_degrees};
}

}  // namespace

TEST_CASE("a primary ray is the node's to which it is led from region to region, in every way of sharing out at once") {
  const core::View view = tests::built_in("sombrero-1").view;
  CHECK(check_owners(SharedHat(view, 40, 2, {1, 2, 3, 8, 24, 64, 100})) > 100);
}

TEST_CASE("so is one whose eye is within the grid, or that runs along planes and edges of cells") {
  int passed = 0;
  for (const core::View& view : {looking({0.1, 0.2, 0.05}, {1, 0.1, 0}, 100), looking({0, -5, 0}, {0, 0, 0}, 60),
                                 looking({0, 0, 0}, {0, 3, 0}, 80), looking({-3, -3, 0.01}, {0, 0, 0.01}, 30)}) {
    passed += check_owners(SharedHat(view, 33, 1, {16, 5, 64}));
  }
  CHECK(passed > 0);
}

TEST_CASE("runs of primary rays are counted for many computers as they are assigned to each") {
  std::vector<std::uint32_t> region_counts;
  for (std::uint32_t i = 0; i < dataflow::JointLattice::partitions_max + 5; ++i) {
    region_counts.push_back(1 + i % 9);
  }
  const SharedHat hat(tests::built_in("sombrero-1").view, 24, 3, region_counts);
  core::Pass pass(hat.settings.camera.pixel_count(), 2);
  core::PixelMask done(hat.settings.camera.pixel_count());
  std::uint64_t samples = 0;
  for (std::uint32_t pixel = 0; pixel < hat.settings.camera.pixel_count(); ++pixel) {
    pass.steps()[pixel] = {pixel % 3, pixel % 4};
    if (pixel % 7 == 3) {
      done.add(pixel);
    } else {
      samples += pass.samples(pixel).count;
    }
  }
  const core::SampleRange numbered = dataflow::numbered_samples(pass);
  const auto counts = dataflow::count_primary_runs(hat.settings, hat.bsps, pass, done);
  REQUIRE(counts.size() == hat.bsps.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto runs = dataflow::assign_primaries(hat.settings, hat.bsps[i], pass, done);
    REQUIRE(counts[i].size() == runs.size());
    std::uint64_t rays = 0;
    for (std::size_t node = 0; node < runs.size(); ++node) {
      CHECK(counts[i][node] == runs[node].size());
      for (const dataflow::PrimaryRun& run : runs[node]) {
        rays += run.count;
        CHECK(run.count > 0);
        for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
          const std::uint32_t pixel = dataflow::place_of(number, numbered), sample = dataflow::sample_of(number, numbered);
          const core::SampleRange range = pass.samples(pixel);
          CHECK_FALSE(done.has(pixel));
          CHECK((sample >= range.first && sample < range.first + range.count));
        }
        const std::uint32_t first = dataflow::place_of(run.first, numbered);
        CHECK(owner_by_next_stop(hat, hat.bsps[i], first, dataflow::sample_of(run.first, numbered)) == node);
      }
    }
    CHECK(rays == samples);
  }
}

TEST_CASE("where no region holds anything the sky is everybody's") {
  Bsp bsp = dataflow::equal_size_bsp({64, 64, 64}, {0, 1}, 4);
  for (std::uint32_t region = 0; region < 4; ++region) {
    bsp.mark_empty(region);
  }
  dataflow::SkyOwners sky(bsp, 10);
  std::vector<int> owners;
  for (std::uint32_t pixel = 0; pixel < 10; ++pixel) {
    owners.push_back(sky.owner_of(pixel));
    CHECK(sky.end() > pixel);
  }
  CHECK(owners == std::vector<int>{0, 0, 0, 1, 1, 2, 2, 2, 3, 3});
}

}  // namespace primary_owners_test
