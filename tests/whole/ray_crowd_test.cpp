// Where hits of a crowded picture send one of two rays, every strategy sends the same one.
#include <doctest/doctest.h>

#include "tests/support/film_of.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"

namespace dmpc::tests::ray_crowd_test {

TEST_CASE("every strategy chooses the same rays of a crowded picture") {
  const core::Scene scene = mirrors_and_glass();
  const core::Database database = core::build_database(scene, {.structure = core::Structure::extents});
  core::RenderSettings settings{database.header(),
                                core::Camera(scene.view, database.header().frame, 20, 20, 2),
                                {.one_child_from = 2, .depth_max = 8, .first_samples = 2}};
  core::Operations operations, of_both;
  const std::uint64_t expected = film_of(database, settings, operations).hash();
  settings.shade.one_child_from = 0;
  CHECK(film_of(database, settings, of_both).hash() != expected);
  CHECK(operations.rays[1] + operations.rays[2] < of_both.rays[1] + of_both.rays[2]);
  settings.shade.one_child_from = 2;
  CHECK(svm::run_svm(database, settings, {.computer = {.node_count = 3}}, {}).film.hash() == expected);
  CHECK(svm::run_forest(database, settings, {.computer = {.node_count = 3}}, {}).film.hash() == expected);
  CHECK(svm::run_replicated(database, settings, {.computer = {.node_count = 2}}, {}).film.hash() == expected);
  CHECK(dataflow::run_dataflow(database, settings, {.computer = {.node_count = 3}}, {}).film.hash() == expected);
  for (core::Skip skip : core::all_skips) {
    settings.skips = {};
    settings.skips.*skip.is_on = false;
    CHECK(svm::run_replicated(database, settings, {.computer = {.node_count = 1}}, {}).film.hash() == expected);
  }
}

}  // namespace dmpc::tests::ray_crowd_test
