// One picture: whatever the strategy, the nodes, the pages and the schedule, the film equals the reference renderer's to the last
// bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "apps/lab/bench/stability/cells.h"
#include "core/base/units.h"
#include "dataflow/run.h"
#include "svm/run.h"
#include "tests/support/covering_faces.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/pairwise.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace one_picture_test {

namespace {

using namespace dmpc;

constexpr std::size_t page_sizes[] = {512, 1024, 4096, 65536};
constexpr std::uint32_t node_counts[] = {1, 2, 3, 7, 8, 64};
constexpr std::uint32_t in_flights[] = {1, 64};
constexpr std::uint32_t item_sides[] = {0, 1, 3, 16};
/// Nodes for each that renders.
constexpr std::uint32_t nodes_a_worker[] = {1, 2, 64};
/// Shares of the database in the cache; 0 stands for one page.
constexpr double cache_shares[] = {0.0, 0.05, 1.0};

using tests::outcome_of;
using tests::scaled_edge;
using tests::Subject;

/// A scene's databases by structure and page size.
class Subjects {
 public:
  Subjects(const core::Scene& scene, const Subject::Size& size) {
    core::BuildOptions options = apps::several_macro_cells(scene);
    for (const core::Structure structure : {core::Structure::grid, core::Structure::extents}) {
      for (const std::size_t page_size : page_sizes) {
        options.structure = structure;
        options.page_size_bytes = page_size;
        const auto made = subjects_.try_emplace({structure, page_size}, scene, size, options).first;
        CHECK(made->second.outcome() == subjects_.begin()->second.outcome());
      }
    }
  }
  const Subject& with(core::Structure structure, std::size_t page_size_bytes) const {
    return subjects_.at({structure, page_size_bytes});
  }

 private:
  std::map<std::pair<core::Structure, std::size_t>, Subject> subjects_;
};

/// Strategies by number.
svm::Report run_paged(std::size_t strategy, const Subject& subject, const svm::RunOptions& options) {
  return strategy == 0   ? run_svm(subject, options)
         : strategy == 1 ? run_replicated(subject, options)
                         : run_forest(subject, options);
}

/// Every pair of choices occurs in some run.
void check_pairwise(const core::Scene& scene, const Subject::Size& size) {
  const Subjects subjects(scene, size);
  const auto rows = tests::pairwise({std::size(node_counts), std::size(page_sizes), std::size(cache_shares),
                                     std::size(in_flights), std::size(item_sides), 3, std::size(nodes_a_worker), 2, 3, 3});
  for (const auto& row : rows) {
    const bool is_forest = row[5] == 2, is_one_tree = is_forest || row[7] == 1;
    const Subject& subject = subjects.with(is_one_tree ? core::Structure::extents : core::Structure::grid, page_sizes[row[1]]);
    svm::RunOptions options;
    options.computer.node_count = node_counts[row[0]];
    options.pages.in_flight = in_flights[row[3]];
    options.pages.work_item_side = item_sides[row[4]];
    options.pages.work_donor = row[8] == 1 && item_sides[row[4]] > 0 ? svm::WorkDonor::host : svm::WorkDonor::ring;
    options.pages.pixel_shares = row[8] == 2 ? svm::PixelShares::interleaved : svm::PixelShares::submaps;
    options.pages.worker_count = core::ceil_divide(node_counts[row[0]], nodes_a_worker[row[6]]);
    if (row[5] == 0) {
      const double frames = cache_shares[row[2]] * static_cast<double>(subject.database().page_count());
      options.pages.cache_pages = std::max(1U, static_cast<std::uint32_t>(frames));
      options.pages.homes = row[9] == 0 ? svm::PageHomes::spread : row[9] == 1 ? svm::PageHomes::host : svm::PageHomes::tree;
      options.pages.resident_percent = row[9] == 2 ? 50 : 0;
    }
    CAPTURE(options.computer.node_count);
    CAPTURE(subject.database().page_size());
    CAPTURE(*options.pages.in_flight);
    CAPTURE(options.pages.work_item_side);
    CAPTURE(*options.pages.worker_count);
    CAPTURE(name_of(options.pages.work_donor));
    CAPTURE(name_of(options.pages.pixel_shares));
    CAPTURE(name_of(options.pages.homes));
    CAPTURE(options.pages.cache_pages.value_or(0));
    CAPTURE(row[5]);
    CAPTURE(is_one_tree);
    CHECK(outcome_of(run_paged(row[5], subject, options)) == subject.outcome());
  }
}

/// Every strategy on any number of nodes, dataflow also with one ray a message, the least credits and no queue.
void check_strategies(const Subject& subject, std::initializer_list<std::uint32_t> counts = {1, 2, 3, 5, 8, 16, 64}) {
  for (const std::uint32_t nodes : counts) {
    CAPTURE(nodes);
    const tests::Outcome svm = outcome_of(run_svm(subject, {.computer = {.node_count = nodes}}));
    CHECK(svm == subject.outcome());
    CHECK(svm == outcome_of(run_replicated(subject, {.computer = {.node_count = nodes}})));
    CHECK(svm == outcome_of(run_dataflow(subject, {.computer = {.node_count = nodes}})));
    const dataflow::RunOptions least{.computer = {.node_count = nodes},
                                     .rays = {.ray_batch = 1, .ray_credits = nodes % 2, .queue_packets = 0}};
    CHECK(svm == outcome_of(run_dataflow(subject, least)));
  }
}

/// Twenty times as far from what is looked at, and as large in the picture.
core::Scene from_far_away(core::Scene scene) {
  scene.view.from = scene.view.at + (scene.view.from - scene.view.at) * 20.0;
  scene.view.angle_degrees /= 20;
  return scene;
}

}  // namespace

TEST_CASE("every kind of primitive, many lights, what is concave and a teapot give one picture in every pair of choices") {
  check_pairwise(tests::mirrors_and_glass(), {scaled_edge(40), scaled_edge(32)});
  check_pairwise(tests::thousand_lights(), {scaled_edge(12), scaled_edge(12)});
  check_pairwise(tests::built_in("gears-1"), {scaled_edge(16), scaled_edge(16)});
  check_pairwise(tests::built_in("teapot-4"), {scaled_edge(32), scaled_edge(32)});
}

TEST_CASE("what only mesh files say of surfaces gives one picture in every pair of choices, and by every strategy") {
  check_pairwise(tests::mesh_surfaces(), {scaled_edge(40), scaled_edge(32)});
  check_strategies(Subject(tests::mesh_surfaces(), {scaled_edge(24), scaled_edge(24)}));
}

TEST_CASE("interleaved pixels, with pages at home at the host or with the nodes, give one picture by every strategy of pixels") {
  for (const char* const name : {"teapot-4", "rings-2"}) {
    const Subject grid(tests::built_in(name), {.width = scaled_edge(23), .height = scaled_edge(17), .samples = 2},
                       {.page_size_bytes = 512});
    const Subject extents(tests::built_in(name), {.width = scaled_edge(23), .height = scaled_edge(17), .samples = 2},
                          {.page_size_bytes = 512, .structure = core::Structure::extents});
    for (const std::uint32_t nodes : {1U, 2U, 5U, 8U}) {
      for (const std::uint32_t side : {0U, 3U}) {
        CAPTURE(name);
        CAPTURE(nodes);
        CAPTURE(side);
        svm::RunOptions options{.computer = {.node_count = nodes},
                                .pages = {.work_item_side = side, .pixel_shares = svm::PixelShares::interleaved}};
        CHECK(outcome_of(run_replicated(grid, options)) == grid.outcome());
        CHECK(outcome_of(run_forest(extents, options)) == grid.outcome());
        for (const svm::PageHomes homes : {svm::PageHomes::spread, svm::PageHomes::host, svm::PageHomes::tree}) {
          CAPTURE(name_of(homes));
          options.pages.homes = homes;
          options.pages.cache_pages = 2;
          CHECK(outcome_of(run_svm(grid, options)) == grid.outcome());
          CHECK(outcome_of(run_svm(extents, options)) == grid.outcome());
        }
      }
    }
  }
}

TEST_CASE("svm, replicated and dataflow give one film on a coarse grid, and one on a fine one") {
  for (const core::Scene& scene : {tests::mirrors_and_glass(), tests::glass_on_floor(true, true)}) {
    CAPTURE(scene.name);
    for (const Subject& subject :
         tests::on_two_grids(scene, {.width = scaled_edge(20), .height = scaled_edge(16), .samples = 2})) {
      check_strategies(subject);
    }
  }
}

TEST_CASE("one tree of extents gives the film of the grid, wherever the eye is, by every strategy") {
  for (const core::Scene& scene : {tests::built_in("gears-1"), tests::mirrors_and_glass(), tests::built_in("teapot-4"),
                                   from_far_away(tests::built_in("teapot-4")), from_far_away(tests::built_in("balls-3"))}) {
    CAPTURE(scene.name);
    const Subject::Size size{.width = scaled_edge(20), .height = scaled_edge(16), .samples = 2};
    core::BuildOptions options = apps::several_macro_cells(scene);
    const Subject grid(scene, size, options);
    options.structure = core::Structure::extents;
    const Subject extents(scene, size, options);
    CHECK(extents.outcome() == grid.outcome());
    check_strategies(extents, {3, 16});
    for (const std::uint32_t nodes : {1U, 2U, 3U, 7U, 16U}) {
      CAPTURE(nodes);
      CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = nodes}})) == grid.outcome());
    }
  }
}

TEST_CASE("refined samples give one picture, whoever renders it on any number of nodes") {
  const Subject subject(tests::mirrors_and_glass(), {.width = 24, .height = 20, .samples = 2, .refinement = {.error = 0.02}});
  REQUIRE(subject.outcome().rays[0] > 3 * 24 * 20);
  check_strategies(subject, {1, 3, 8});
  for (const std::uint32_t side : {0U, 1U, 8U, 20U}) {
    CAPTURE(side);
    CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 5}, .pages = {.work_item_side = side}})) == subject.outcome());
    const svm::PageOptions assigned{.work_item_side = std::max(side, 1U), .work_donor = svm::WorkDonor::host};
    CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 5}, .pages = assigned})) == subject.outcome());
    const svm::PageOptions interleaved{.work_item_side = side, .pixel_shares = svm::PixelShares::interleaved};
    CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 8}, .pages = interleaved})) == subject.outcome());
  }
  const Subject extents(tests::mirrors_and_glass(), {.width = 24, .height = 20, .samples = 2, .refinement = {.error = 0.02}},
                        {.page_size_bytes = 512, .structure = core::Structure::extents});
  CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = 5}})) == subject.outcome());
}

TEST_CASE("refined samples give one picture when rays of later passes come in many packets") {
  const Subject subject(tests::built_in("balls-2"), {.width = 70, .height = 64, .samples = 2, .refinement = {.error = 0.004}});
  CHECK(outcome_of(run_dataflow(subject, {.computer = {.node_count = 3}})) == subject.outcome());
  CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 1}})) == subject.outcome());
}

TEST_CASE("a cutoff gives one picture, with fewer rays than without") {
  const core::Scene scene = tests::mirrors_and_glass();
  const Subject exact(scene, {.width = 24, .height = 20}), cut(scene, {.width = 24, .height = 20, .cutoff = 0.05});
  CHECK(cut.outcome().rays[1] < exact.outcome().rays[1]);
  check_strategies(cut, {1, 5});
}

TEST_CASE("an ambient light, which every hit shows without a ray, gives one picture, with the rays of any other") {
  core::Scene scene = tests::mirrors_and_glass();
  tests::add_textured_walls(scene);
  const Subject dark(scene, {.width = 24, .height = 20, .samples = 2});
  scene.ambient = {0.5, 0.25, 0.75};
  const Subject subject(scene, {.width = 24, .height = 20, .samples = 2});
  CHECK(subject.outcome().film_hash != dark.outcome().film_hash);
  CHECK(subject.outcome().rays == dark.outcome().rays);
  check_strategies(subject, {1, 3, 16});
  const Subject extents(scene, {.width = 24, .height = 20, .samples = 2},
                        {.page_size_bytes = 512, .structure = core::Structure::extents});
  CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = 5}})) == subject.outcome());
}

TEST_CASE("twenty runs on 64 nodes give one picture" * doctest::test_suite("slow")) {
  const Subject subject(tests::mirrors_and_glass(), {scaled_edge(64), scaled_edge(64)});
  for (int run = 0; run < 20; ++run) {
    CAPTURE(run);
    CHECK(outcome_of(run_svm(subject, {.computer = {.node_count = 64}})) == subject.outcome());
  }
}

TEST_CASE("films keep their bits from build to build, compiler to compiler and machine to machine") {
  struct Known {
    std::string name;
    std::uint64_t hash;
  };
  for (const Known& known : {Known{"teapot-4", 0xaa25395e510fcce7ULL}, Known{"gears-1", 0x8b954917453db5eaULL},
                             Known{"balls-2", 0xf6e0cad02efa7124ULL}, Known{"rings-1", 0x7bbeba19b06a60c7ULL},
                             Known{"mount-3", 0x45c0374a28a80515ULL}, Known{"tree-4", 0x40db51157be47a11ULL}}) {
    CAPTURE(known.name);
    CHECK(Subject(tests::built_in(known.name), {32, 32}).outcome().film_hash == known.hash);
  }
}

}  // namespace one_picture_test
