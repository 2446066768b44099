#include "svm/frames.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "svm/forest/strategy.h"
#include "tests/support/walk.h"

namespace svm_frames_test {

using namespace dmpc;
using tests::Walk;

namespace {

svm::Report run_alone(const Walk& walk, const svm::Strategy& strategy, std::size_t frame, const svm::RunOptions& options) {
  return svm::run_by(strategy, walk.database, walk.frames[frame], options, {});
}

svm::RunOptions one_by_one(std::uint32_t node_count, std::optional<nodes::Machine> machine = std::nullopt) {
  return {.computer = {.node_count = node_count, .machine = std::move(machine)},
          .pages = {.cache_pages = 40, .in_flight = 1, .work_item_side = 0}};
}

}  // namespace

TEST_CASE("each frame has the film of a run of it alone, by pages, copies and questions, on threads, a pool and a machine") {
  const Walk walk(24);
  const Walk tree(24, {.page_size_bytes = 512, .structure = core::Structure::extents});
  const std::vector<const svm::Strategy*> strategies = {svm::svm_strategy(), svm::replicated_strategy(), svm::forest_strategy()};
  for (const svm::Strategy* const strategy : strategies) {
    const Walk& of = strategy == svm::forest_strategy() ? tree : walk;
    for (const int way : {0, 1, 2, 3}) {
      svm::RunOptions options{.computer = {.node_count = 3}};
      options.computer.pool_threads = way == 1 ? std::optional(2U) : std::nullopt;
      options.computer.machine = way == 2 ? std::optional(nodes::Machine{}) : std::nullopt;
      options.computer.chaos = way == 3 ? std::optional(nodes::chaos_of(7)) : std::nullopt;
      svm::Frames frames(*strategy, of.database, of.frames[0], options, {});
      for (std::size_t i = 0; i < of.frames.size(); ++i) {
        CAPTURE(strategy->name());
        CAPTURE(way);
        CAPTURE(i);
        const svm::Report report = frames.render(of.frames[i], {});
        CHECK(report.film.hash() == run_alone(of, *strategy, i, {.computer = {.node_count = 2}}).film.hash());
        CHECK(report.pixels_done == 24U * 24U);
      }
    }
  }
}

TEST_CASE("the first frame of several is the run of it alone, to the last event") {
  const Walk walk(24);
  const svm::RunOptions options = one_by_one(4, nodes::Machine{});
  const svm::Report alone = run_alone(walk, *svm::svm_strategy(), 0, options);
  const svm::Report first =
      svm::Frames(*svm::svm_strategy(), walk.database, walk.frames[0], options, {}).render(walk.frames[0], {});
  CHECK(first.virtual_time->hash == alone.virtual_time->hash);
  CHECK(first.virtual_time->total_ns == alone.virtual_time->total_ns);
}

TEST_CASE("nodes that keep nothing but what they had do the same again for the same frame, to the last event") {
  const Walk walk(24);
  svm::RunOptions options = one_by_one(4, nodes::Machine{});
  options.pages.cache_pages.reset();
  svm::Frames frames(*svm::replicated_strategy(), walk.database, walk.frames[0], options, {});
  const svm::Report first = frames.render(walk.frames[0], {});
  const svm::Report again = frames.render(walk.frames[0], {});
  CHECK(again.virtual_time->hash == first.virtual_time->hash);
  CHECK(again.virtual_time->total_ns == first.virtual_time->total_ns);
  CHECK(again.operations().ray_count() == first.operations().ray_count());
  CHECK(nodes::total(again.sent()).packets == nodes::total(first.sent()).packets);
}

TEST_CASE("what a node has fetched it does not fetch again where its cache has room for all: a still frame has no fault") {
  const Walk walk(24);
  svm::RunOptions options = one_by_one(4);
  options.pages.cache_pages = 1U << 20U;
  svm::Frames frames(*svm::svm_strategy(), walk.database, walk.frames[0], options, {});
  const svm::Report cold = frames.render(walk.frames[0], {});
  const svm::Report still = frames.render(walk.frames[0], {});
  const svm::Report moved = frames.render(walk.frames[1], {});
  CHECK(cold.pages().faults > 100);
  CHECK(still.pages().faults == 0);
  CHECK(still.pages().references == cold.pages().references);
  CHECK(moved.pages().faults > 0);
  CHECK(moved.pages().faults < cold.pages().faults / 4);
}

TEST_CASE(
    "frames that are refined choose their samples as alone, whoever assigns the work, and the host that has all pages serves "
    "each") {
  Walk walk(16);
  for (core::RenderSettings& settings : walk.frames) {
    settings.camera = core::Camera(walk.scene.view, walk.database.header().frame, 16, 16, 2);
    settings.refinement = {.error = 0.02, .samples_max = 64};
  }
  const svm::Report alone = run_alone(walk, *svm::svm_strategy(), 0, {.computer = {.node_count = 2}});
  CHECK(alone.refinement.passes > 1);
  for (const svm::WorkDonor donor : {svm::WorkDonor::ring, svm::WorkDonor::host}) {
    const svm::RunOptions options{
        .computer = {.node_count = 3},
        .pages = {.cache_pages = 9, .homes = svm::PageHomes::host, .work_item_side = 2, .work_donor = donor}};
    svm::Frames frames(*svm::svm_strategy(), walk.database, walk.frames[0], options, {});
    for (int i = 0; i < 3; ++i) {
      const svm::Report report = frames.render(walk.frames[0], {});
      CHECK(report.film.hash() == alone.film.hash());
      CHECK(report.refinement.passes == alone.refinement.passes);
      CHECK(report.pages().faults == report.host_pages_served);
    }
  }
}

}  // namespace svm_frames_test
