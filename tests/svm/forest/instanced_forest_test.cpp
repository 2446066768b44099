// Base meshes, by nodes that ask each other.
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "core/database/database.h"
#include "core/picture/camera/frame_settings.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/memory_use.h"
#include "svm/forest/forest.h"
#include "svm/forest/strategy.h"
#include "svm/frames.h"
#include "svm/run.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::instanced_forest_test {
namespace {

constexpr Arrangement arrangements[] = {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident};

/// Some 18 places of two meshes.
const Subject& balls(std::size_t page_size_bytes = 512) {
  const auto of_pages = [](std::size_t bytes) {
    const int side = scaled_edge(32);
    return Subject(balls_in_places(0.3, Arrangement::deep_in_each_other, 21), {side, side, 2}, with_instances(bytes));
  };
  static const Subject small = of_pages(512), large = of_pages(4096);
  return page_size_bytes == 512 ? small : large;
}

/// So many places that not every node holds what leads into them.
const Subject& field(std::size_t page_size_bytes = 512) {
  const auto of_pages = [](std::size_t bytes) {
    const int side = scaled_edge(32);
    return Subject(field_of_balls(42, 6), {side, side, 2}, with_instances(bytes));
  };
  static const Subject small = of_pages(512), large = of_pages(4096);
  return page_size_bytes == 512 ? small : large;
}

svm::RunOptions computer_of(std::uint32_t nodes, std::optional<std::uint32_t> in_flight = std::nullopt) {
  return {.computer = {.node_count = nodes}, .pages = {.in_flight = in_flight}};
}

svm::RunOptions way_of(int number, std::uint64_t seed) {
  return {.computer = computer_of_kind(number, 2 + static_cast<std::uint32_t>(seed % 7), seed)};
}

}  // namespace

TEST_CASE("nodes that ask each other show of what is kept once what its copies show, on threads, a pool, a model, in chaos" *
          doctest::test_suite("slow")) {
  std::uint64_t seed = 40;
  for (const Arrangement arrangement : arrangements) {
    for (const double size : {0.3, 0.01}) {
      const core::Scene scene = balls_in_places(size, arrangement, ++seed);
      const int side = scaled_edge(24);
      for (const std::size_t page_size : {512U, 4096U}) {
        const Subject copies(scene, {side, side, 2}, with_copies(page_size)),
            kept(scene, {side, side, 2}, with_instances(page_size));
        REQUIRE(kept.database().records().instances > 0);
        for (int number = 0; number < 4; ++number) {
          CAPTURE(++seed);
          CAPTURE(number);
          CHECK(outcome_of(run_forest(kept, way_of(number, seed))) == copies.outcome());
        }
      }
    }
  }
}

TEST_CASE("what leads into few meshes is at every node, and of what leads into many each node has its share") {
  for (const Subject* const subject : {&balls(), &field()}) {
    const core::Database& database = subject->database();
    const svm::Plan plan = svm::plan_of(*svm::forest_strategy(), database, subject->settings(), computer_of(8));
    const bool are_few = subject == &balls();
    CHECK(svm::holds_open_pages(plan.request.open_page_count, 512) == are_few);
    const std::size_t leading = database.forest_page_count() + (are_few ? database.open_page_count() : 0);
    CHECK(plan.pages().leading_pages == leading);
    for (const svm::NodeReport& node : run_forest(*subject, computer_of(8)).nodes) {
      CHECK(node.memory_used[core::MemoryUse::home_pages] <=
            (leading + (database.page_count() - leading) / 8 + 2) * database.page_size() + 128);
    }
  }
}

TEST_CASE("of what is kept once the film, the rays and all that walks do are those of replicated, on any number of nodes") {
  const core::Skips alone{.bundles = false};
  for (const Subject* const subject : {&balls(), &field()}) {
    const core::Operations expected = run_replicated(*subject, computer_of(1), alone).operations();
    for (const std::uint32_t nodes : {1U, 2U, 5U, 16U}) {
      for (const auto in_flight : {std::optional(1U), std::optional<std::uint32_t>()}) {
        CAPTURE(nodes);
        const svm::Report report = run_forest(*subject, computer_of(nodes, in_flight));
        CHECK(outcome_of(report) == subject->outcome());
        const core::Operations done = report.operations();
        CHECK(done.bvh_node_reads == expected.bvh_node_reads);
        CHECK(done.primitive_tests == expected.primitive_tests);
        CHECK(done.normal_reads == expected.normal_reads);
        CHECK(done.skipped.any_hit == expected.skipped.any_hit);
      }
    }
  }
}

TEST_CASE("in chaos what is kept once shows the same, whatever is under way" * doctest::test_suite("slow")) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const std::size_t page_size = seed % 2 == 0 ? 512 : 4096;
    const Subject& subject = seed % 4 < 2 ? balls(page_size) : field(page_size);
    svm::RunOptions options = way_of(3, seed);
    options.pages.in_flight = seed % 3 == 0 ? std::optional(1U) : seed % 3 == 1 ? std::optional(5U) : std::nullopt;
    CHECK(outcome_of(run_forest(subject, options)) == subject.outcome());
  }
}

TEST_CASE("a node of forest uses exactly the memory of its plan where meshes are kept, with the smallest that is named too") {
  for (const Subject* const subject : {&balls(), &field()}) {
    for (const std::uint32_t nodes : {1U, 3U, 16U}) {
      CAPTURE(nodes);
      svm::RunOptions options = computer_of(nodes);
      for (const svm::NodeReport& node : run_forest(*subject, options).nodes) {
        CHECK(node.memory_used.bytes == node.memory_planned.bytes);
      }
      const svm::Plan plan = svm::plan_of(*svm::forest_strategy(), subject->database(), subject->settings(), options);
      options.computer.node_memory_bytes = svm::smallest_node_memory_bytes(plan.request);
      const svm::Report least = run_forest(*subject, options);
      CHECK(least.plan.in_flight == 1);
      CHECK(outcome_of(least) == subject->outcome());
      --*options.computer.node_memory_bytes;
      CHECK_THROWS_AS(run_forest(*subject, options), core::CapacityError);
    }
  }
}

TEST_CASE("paths, and samples that follow where a pass before has found the picture uneven, show the same of what is kept") {
  const core::Scene scene = balls_in_places(0.3, Arrangement::deep_in_each_other, 33);
  const int side = scaled_edge(16);
  const Subject::Size by_paths{.width = side,
                               .height = side,
                               .samples = 2,
                               .transport = {.kind = core::TransportKind::paths, .has_sky = true},
                               .depth_max = 3};
  const Subject::Size refined{.width = side, .height = side, .samples = 2, .refinement = {.error = 0.01, .samples_max = 64}};
  for (const Subject::Size& size : {by_paths, refined}) {
    const Subject copies(scene, size, with_copies()), kept(scene, size, with_instances());
    CHECK(outcome_of(run_forest(kept, computer_of(5))) == copies.outcome());
  }
}

TEST_CASE("frames of what is kept have the films of runs of them alone") {
  const core::Database& database = balls().database();
  std::vector<core::RenderSettings> settings;
  for (const double step : {0.0, 0.05, 0.1}) {
    core::View view = lit_scene().view;
    view.from.x += step;
    const core::Camera camera(view, database.header().frame, scaled_edge(32), scaled_edge(32), 2);
    settings.push_back(core::seen_by(camera, balls().settings(), database));
  }
  for (const int way : {0, 2, 3}) {
    const svm::RunOptions options = way_of(way, 5);
    svm::Frames frames(*svm::forest_strategy(), database, settings[0], options, {});
    for (const core::RenderSettings& frame : settings) {
      const auto alone = svm::run_replicated(database, frame, computer_of(1), {});
      CHECK(frames.render(frame, {}).film.hash() == alone.film.hash());
    }
  }
}

TEST_CASE("what a run has left undone of what is kept is done by questions, to the same picture") {
  std::optional<core::PartialPicture> half;
  svm::RunOptions options = computer_of(3);
  options.continuation.is_due = [&] { return !half; };
  options.continuation.keep = [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
    half = core::partial_picture(film, pass, done);
  };
  run_forest(balls(), options);
  REQUIRE(half);
  REQUIRE(half->missing().count() > 0);
  options = computer_of(4);
  options.continuation.start = &*half;
  const svm::Report rest = run_forest(balls(), options);
  CHECK(rest.film.hash() == balls().outcome().film_hash);
  CHECK(rest.pixels_done == half->missing().count());
}

}  // namespace dmpc::tests::instanced_forest_test
