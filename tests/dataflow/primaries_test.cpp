#include "dataflow/primaries.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/database.h"
#include "core/traversal.h"
#include "dataflow/balance.h"
#include "tests/support/small_scenes.h"

using namespace dmpc;
using dataflow::Primaries;
using dataflow::PrimaryRun;

TEST_CASE("a node starts the rays of its runs, in order, once") {
  const std::vector<PrimaryRun> runs = {{3, 2}, {10, 1}, {20, 3}};
  nodes::MemoryPlan plan;
  Primaries::add_needs(plan, runs.size());
  nodes::LocalMemory memory(plan);
  Primaries primaries(memory, runs);
  CHECK(primaries.left() == 6);
  for (const std::uint64_t number : {3U, 4U, 10U, 20U, 21U, 22U}) {
    CHECK(primaries.take() == number);
  }
  CHECK(primaries.empty());
  CHECK_THROWS_AS(primaries.take(), core::InternalError);
}

TEST_CASE("a node may have no primary ray") {
  nodes::MemoryPlan plan;
  Primaries::add_needs(plan, 0);
  nodes::LocalMemory memory(plan);
  CHECK(Primaries(memory, {}).empty());
}

TEST_CASE("every primary ray is dealt once, to the owner of the cell in which it enters, and the sky is spread") {
  core::Scene scene = tests::mirrors_and_glass();
  scene.view.at = {4, -3, 2};  // half of the picture is sky
  const core::Database database = core::build_database(scene, {});
  const core::GridFrame& frame = database.header().frame;
  const core::Camera camera(scene.view, frame, 30, 20, 3);
  const dataflow::Bsp bsp = dataflow::equal_size_bsp(core::grid_size(frame), dataflow::axes_facing(camera), 5);
  const auto runs = dataflow::deal_primaries(camera, frame, bsp);
  std::vector<int> dealt(camera.pixel_count() * 3);
  std::vector<int> sky(5);
  for (std::uint32_t node = 0; node < 5; ++node) {
    for (const PrimaryRun& run : runs[node]) {
      for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
        ++dealt[number];
        const auto pixel = static_cast<std::uint32_t>(number / 3);
        const auto passage = core::first_passage(camera.primary_ray(pixel, static_cast<std::uint32_t>(number % 3)), frame);
        CHECK((!passage || bsp.owner_of(passage->cell) == nodes::NodeId{node}));
        sky[node] += passage ? 0 : 1;
      }
    }
  }
  CHECK(dealt == std::vector<int>(dealt.size(), 1));
  for (const int of_node : sky) {
    CHECK(of_node > 0);
    CHECK(of_node <= static_cast<int>(dealt.size()) / 5);
  }
}
