#include "dataflow/rays/primaries.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/database/database.h"
#include "core/trace/traversal.h"
#include "dataflow/regions/balance.h"
#include "tests/support/small_scenes.h"

namespace primaries_test {

using namespace dmpc;
using dataflow::Primaries;
using dataflow::PrimaryRun;

TEST_CASE("a node starts the rays of its runs, in order, once") {
  const std::vector<PrimaryRun> runs = {{3, 2}, {10, 1}, {20, 3}};
  nodes::LocalMemory memory(Primaries::layout(runs.size(), false));
  Primaries primaries(memory, runs, {}, false);
  CHECK(primaries.left() == 6);
  for (const std::uint64_t number : {3U, 4U, 10U, 20U, 21U, 22U}) {
    CHECK(primaries.take() == number);
  }
  CHECK(primaries.empty());
  CHECK_THROWS_AS(primaries.take(), core::InternalError);
}

TEST_CASE("a node may have no primary ray") {
  nodes::LocalMemory memory(Primaries::layout(0, false));
  CHECK(Primaries(memory, {}, {}, false).empty());
}

TEST_CASE("rays of later passes come packet by packet, and each makes room for another when it is worked off") {
  nodes::LocalMemory memory(Primaries::layout(1, true));
  Primaries primaries(memory, std::vector<PrimaryRun>{{0, 1}}, {0, 2}, true);
  CHECK(primaries.take() == 0);
  CHECK(primaries.packets_worked_off() == 0);
  dataflow::AssignedPrimaries packet{.samples = {2, 2}, .count = static_cast<std::uint32_t>(packet.runs.size())};
  for (std::uint32_t i = 0; i < packet.count; ++i) {
    packet.runs[i] = {10 * i, 2};
  }
  primaries.put(packet);
  primaries.put(packet);
  CHECK_THROWS_AS(primaries.put(packet), core::InternalError);
  CHECK(primaries.samples() == core::SampleRange{2, 2});
  CHECK(primaries.left() == 4 * packet.count);
  for (std::uint32_t i = 0; i < 2 * packet.count; ++i) {
    CHECK(primaries.packets_worked_off() == 0);
    CHECK(primaries.take() == i / 2 * 10 + i % 2);
  }
  CHECK(primaries.packets_worked_off() == 1);
  CHECK(primaries.packets_worked_off() == 0);
  primaries.put(packet);
  for (std::uint32_t i = 0; i < 4 * packet.count; ++i) {
    primaries.take();
  }
  CHECK(primaries.packets_worked_off() == 2);
  CHECK(primaries.empty());
}

TEST_CASE("a ray's number tells its pixel's place and its sample") {
  CHECK(dataflow::place_of(17, {8, 4}) == 4);
  CHECK(dataflow::sample_of(17, {8, 4}) == 9);
}

TEST_CASE("every primary ray is assigned once, to the owner of the cell in which it enters, and the sky is spread") {
  core::Scene scene = tests::mirrors_and_glass();
  scene.view.at = {4, -3, 2};  // half of the picture is sky
  const core::Database database = core::build_database(scene, {});
  const core::GridFrame& frame = database.header().frame;
  const core::Camera camera(scene.view, frame, 30, 20, 3);
  const dataflow::Bsp bsp = dataflow::equal_size_bsp(core::grid_size(frame), dataflow::axes_facing(camera), 5);
  const core::RenderSettings settings{.header = database.header(), .camera = camera};
  const auto runs = dataflow::assign_primaries(settings, bsp, settings.first_pass(), core::PixelMask(camera.pixel_count()));
  std::vector<int> assigned(camera.pixel_count() * 3);
  std::vector<int> sky(5);
  for (std::uint32_t node = 0; node < 5; ++node) {
    for (const PrimaryRun& run : runs[node]) {
      for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
        ++assigned[number];
        const auto pixel = static_cast<std::uint32_t>(number / 3);
        const auto passage = core::first_passage(camera.primary_ray(pixel, static_cast<std::uint32_t>(number % 3)), frame);
        CHECK((!passage || bsp.owner_of(passage->cell) == nodes::NodeId{node}));
        sky[node] += passage ? 0 : 1;
      }
    }
  }
  CHECK(assigned == std::vector<int>(assigned.size(), 1));
  for (const int of_node : sky) {
    CHECK(of_node > 0);
    CHECK(of_node <= static_cast<int>(assigned.size()) / 5);
  }
}

TEST_CASE("square by square, every primary ray is assigned once, to whom it is assigned row by row") {
  const core::Scene scene = tests::mirrors_and_glass();
  const core::Database database = core::build_database(scene, {});
  const core::GridFrame& frame = database.header().frame;
  const core::Camera camera(scene.view, frame, 30, 18, 3);
  const dataflow::Bsp bsp = dataflow::equal_size_bsp(core::grid_size(frame), dataflow::axes_facing(camera), 5);
  const core::RenderSettings settings{.header = database.header(), .camera = camera};
  const auto owners_in = [&](const dataflow::PixelOrder& order) {
    const auto runs =
        dataflow::assign_primaries(settings, bsp, settings.first_pass(), core::PixelMask(camera.pixel_count()), {}, order);
    std::vector<std::uint32_t> owners(camera.pixel_count() * 3, 5);
    for (std::uint32_t node = 0; node < 5; ++node) {
      for (const PrimaryRun& run : runs[node]) {
        for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
          std::uint32_t& owner = owners[order.pixel_at(static_cast<std::uint32_t>(number / 3)) * 3 + number % 3];
          CHECK(owner == 5);
          owner = node;
        }
      }
    }
    return owners;
  };
  const std::vector<std::uint32_t> by_rows = owners_in({}), by_squares = owners_in(dataflow::PixelOrder::squares(30, 18));
  for (std::uint32_t ray = 0; ray < by_rows.size(); ++ray) {
    const bool enters = core::first_passage(camera.primary_ray(ray / 3, ray % 3), frame).has_value();
    CHECK((by_squares[ray] == by_rows[ray] || (!enters && by_squares[ray] < 5)));
  }
}

TEST_CASE("rays of pixels that show the background are shared out by pixel number, whatever they would enter") {
  const core::Scene scene = tests::mirrors_and_glass();
  const core::Database database = core::build_database(scene, {});
  const core::GridFrame& frame = database.header().frame;
  const core::Camera camera(scene.view, frame, 40, 30, 2);
  core::BackgroundTiles::Bits bits;
  bits.fill(~std::uint64_t{0});
  core::RenderSettings settings{.header = database.header(), .camera = camera, .background = core::BackgroundTiles(camera, bits)};
  const dataflow::Bsp bsp = dataflow::equal_size_bsp(core::grid_size(frame), dataflow::axes_facing(camera), 3);
  const core::PixelMask done(camera.pixel_count());
  const auto runs = dataflow::assign_primaries(settings, bsp, settings.first_pass(), done);
  for (std::uint32_t node = 0; node < 3; ++node) {
    REQUIRE(runs[node].size() == 1);
    CHECK(runs[node][0].first == node * 800);
    CHECK(runs[node][0].count == 800);
  }
  settings.skips.background = false;
  CHECK(dataflow::assign_primaries(settings, bsp, settings.first_pass(), done)[0].size() > 1);
}

}  // namespace primaries_test
