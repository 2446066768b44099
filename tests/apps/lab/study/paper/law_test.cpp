#include "apps/lab/study/paper/law.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::law_test {

using namespace apps;

namespace {

PaperScene scene_of(const std::array<std::uint32_t, 7>& seconds) {
  PaperScene scene = paper_scenes[0];
  scene.seconds = seconds;
  return scene;
}

}  // namespace

TEST_CASE("the law goes through a scene's two smallest machines") {
  for (const PaperScene& scene : paper_scenes) {
    if (const auto model = model_of(scene)) {
      CAPTURE(scene.title);
      for (std::size_t column = scene.base(); column < scene.base() + model_cell_count; ++column) {
        CHECK(model->seconds(paper_node_counts[column]) == doctest::Approx(scene.seconds[column]).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("the law finds the figures of times that follow it") {
  // 6400 (1 + 0.25 (N - 1) / N) node-seconds: 6400, 7200, 7600, 7800, ...
  const auto model = model_of(scene_of({6400, 3600, 1900, 975, 0, 0, 0}));
  REQUIRE(model);
  CHECK(model->one_node == doctest::Approx(6400));
  CHECK(model->dearer == doctest::Approx(0.25));
  CHECK(model->seconds(4) == doctest::Approx(1900));
  CHECK(model->seconds(8) == doctest::Approx(975));
  const auto without_one_node = model_of(scene_of({0, 3600, 1900, 975, 0, 0, 0}));
  REQUIRE(without_one_node);
  CHECK(without_one_node->one_node == doctest::Approx(6400));
}

TEST_CASE("a scene with one printed machine has no law") {
  CHECK_FALSE(model_of(paper_scenes[4]).has_value());
  CHECK(model_of(paper_scenes[3]).has_value());
}

TEST_CASE("the comparison counts all cells, those of no fit, and those of 64 nodes") {
  const Catalogue catalogue = catalogue_of(16);
  const Table table = against_model(catalogue, as_printed(catalogue));
  REQUIRE(table.rows().size() == 4);
  const std::array<std::uint64_t, 4> counts = {17, 13, 15, 2};
  for (std::size_t row = 0; row < counts.size(); ++row) {
    CHECK(std::get<std::uint64_t>(table.rows()[row][1]) == counts[row]);
    CHECK(number(table.rows()[row][2]) == doctest::Approx(0));
    CHECK(number(table.rows()[row][3]) > 0);
    CHECK(number(table.rows()[row][5]) >= number(table.rows()[row][3]));
  }
  CHECK(number(table.rows()[2][5]) < 2);  // up to 32 nodes the law is as good as this
}

TEST_CASE("without results the comparison is empty and says what is missing") {
  const Catalogue catalogue = catalogue_of(16);
  const Table table = against_model(catalogue, PaperResults(catalogue.runs.size()));
  CHECK(table.rows().empty());
  CHECK(table.notes().front() == "Unfinished: 17 cells are missing.");
}

}  // namespace dmpc::tests::law_test
