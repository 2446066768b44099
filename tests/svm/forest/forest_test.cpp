// A computer whose nodes ask each other: what is asked and answered, what it counts, and what it takes.
#include "svm/forest/forest.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/size_text.h"
#include "svm/forest/strategy.h"
#include "svm/run.h"
#include "tests/support/complaint.h"
#include "tests/support/small_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace forest_test {

using namespace dmpc;
using tests::LoneNode;
using tests::outcome_of;
using tests::Subject;

namespace {

const Subject& gears() {
  static const Subject subject(tests::built_in("gears-1"), {20, 16},
                               {.page_size_bytes = 512, .structure = core::Structure::extents});
  return subject;
}

svm::RunOptions computer_of(std::uint32_t nodes, std::optional<std::uint32_t> in_flight = std::nullopt) {
  return {.computer = {.node_count = nodes}, .pages = {.in_flight = in_flight}};
}

svm::Plan plan_of(const Subject& subject, const svm::RunOptions& options) {
  return svm::plan_of(*svm::forest_strategy(), subject.database(), subject.settings(), options);
}

/// The address of the first record of a page behind the forest.
core::Address record_of(const svm::Plan& plan, std::uint32_t page) {
  return core::Address{static_cast<std::uint32_t>((plan.request.forest_page_count + page) * plan.request.page_size_bytes /
                                                  core::record_alignment)};
}

/// The forest of node 0 of 4.
struct LoneForest {
  explicit LoneForest(std::uint32_t in_flight)
      : plan(plan_of(gears(), computer_of(4, in_flight))),
        lone(plan, 0),
        forest(lone.node, plan.pages(), gears().database().bytes()) {}

  /// About the first record of a page behind the forest, which is at home at node `page` mod 4.
  void ask(std::uint32_t slot, std::uint32_t page) {
    CHECK(forest.find(record_of(plan, page)) == nullptr);
    forest.ask(slot, core::RecordKind::tile, record_of(plan, page));
  }
  /// An answer of `owner` that brings a tile of zeros for each of the slots.
  tests::Parcel answer(std::uint32_t owner, std::initializer_list<std::uint16_t> slots) {
    tests::Parcel parcel{nodes::NodeId{owner}, nodes::NodeId{}, svm::number_of(svm::Kind::answers), {}};
    constexpr std::size_t answer_bytes = sizeof(svm::AnswerHeader) + sizeof(core::TextureTile);
    parcel.payload = std::vector<std::byte>(slots.size() * answer_bytes);
    std::byte* next = parcel.payload.data();
    for (const std::uint16_t slot : slots) {
      const svm::AnswerHeader header{slot, sizeof(core::TextureTile)};
      std::memcpy(next, &header, sizeof(header));
      next += answer_bytes;
    }
    return parcel;
  }

  svm::Plan plan;
  LoneNode lone;
  svm::Forest forest;
};

}  // namespace

TEST_CASE("what is in the forest or at home is found without asking") {
  LoneForest small(2);
  CHECK(small.forest.find(core::Address{0}) != nullptr);
  CHECK(small.forest.find(record_of(small.plan, 0)) != nullptr);
  small.forest.flush();
  CHECK(small.lone.post.parcels.empty());
  CHECK(small.forest.counters().home_hits == 2);
  CHECK(small.forest.counters().misses == 0);
}

TEST_CASE("questions wait for each other until there is nothing else to do, and go to their owners") {
  LoneForest small(5);
  for (std::uint32_t slot = 0; slot < 5; ++slot) {
    small.ask(slot, slot < 3 ? 1 : 3);
  }
  CHECK(small.lone.post.parcels.empty());
  CHECK(small.forest.pending() == 5);
  small.forest.flush();
  REQUIRE(small.lone.post.parcels.size() >= 2);
  CHECK(small.lone.post.parcels.front().target == nodes::NodeId{1});
  CHECK(small.lone.post.parcels.back().target == nodes::NodeId{3});
  CHECK(small.forest.counters().misses == 5);
  CHECK(small.forest.questions().records_asked == 5);
}

TEST_CASE("a record that an owner sends is found until its pixel has gone on, and is not a second look-up") {
  LoneForest small(2);
  small.ask(1, 2);
  small.forest.flush();
  const std::uint64_t look_ups = small.forest.counters().references;
  std::uint32_t gone_on = 0;
  small.forest.take(small.answer(2, {1}).packet(), [&](std::uint32_t slot, const core::Hit* hit) {
    CHECK(slot == 1);
    CHECK(hit == nullptr);
    CHECK(small.forest.find(record_of(small.plan, 2)) != nullptr);
    ++gone_on;
  });
  CHECK(gone_on == 1);
  CHECK(small.forest.pending() == 0);
  CHECK(small.forest.counters().references == look_ups);
  CHECK(small.forest.find(record_of(small.plan, 2)) == nullptr);
}

TEST_CASE("without credit questions wait, and leave when an answer has come") {
  LoneForest small(1);
  REQUIRE(small.plan.request_credits == 1);
  small.ask(0, 1);
  small.forest.flush();
  REQUIRE(small.lone.post.parcels.size() == 1);
  small.forest.take(small.answer(1, {0}).packet(), [&](std::uint32_t slot, const core::Hit*) { small.ask(slot, 5); });
  small.forest.flush();
  CHECK(small.lone.post.parcels.size() == 2);
}

TEST_CASE("with forest the film, the rays and all that walks do are those of replicated, on any number of nodes") {
  const core::Operations alone = run_replicated(gears(), computer_of(1), {.bundles = false}).operations();
  for (const std::uint32_t nodes : {1U, 2U, 3U, 7U, 16U}) {
    const core::Operations in_bundles = run_replicated(gears(), computer_of(nodes)).operations();
    for (const auto in_flight : {std::optional(1U), std::optional(64U), std::optional<std::uint32_t>()}) {
      CAPTURE(nodes);
      const svm::Report report = run_forest(gears(), computer_of(nodes, in_flight));
      CHECK(outcome_of(report) == gears().outcome());
      const core::Operations done = report.operations(), &expected = report.plan.pixels_a_task > 1 ? in_bundles : alone;
      CHECK(done.bvh_node_reads == expected.bvh_node_reads);
      CHECK(done.cell_steps == expected.cell_steps);
      CHECK(done.primitive_tests == expected.primitive_tests);
      CHECK(done.normal_reads == expected.normal_reads);
      CHECK(done.skipped.any_hit == expected.skipped.any_hit);
      CHECK((report.plan.pixels_a_task > 1) == (in_flight != 1U));
    }
  }
}

TEST_CASE("the questions of a bundle's rays stay together in one packet, however many others wait") {
  LoneForest small(64);
  REQUIRE(small.plan.pixels_a_task > 1);
  const core::Below below{.child = core::BvhChild::bvh_node(record_of(small.plan, 1))};
  const auto ask = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      small.forest.ask(first + i, below, count - 1 - i);
    }
  };
  ask(0, 10);
  CHECK(small.lone.post.parcels.empty());
  ask(16, 7);
  REQUIRE(small.lone.post.parcels.size() == 1);
  constexpr std::size_t each = sizeof(svm::QuestionHeader) + sizeof(core::Below);
  CHECK(small.lone.post.parcels[0].payload.size() == 10 * each);
  small.forest.flush();
  REQUIRE(small.lone.post.parcels.size() == 2);
  CHECK(small.lone.post.parcels[1].payload.size() == 7 * each);
  CHECK(core::read<svm::QuestionHeader>(small.lone.post.parcels[1].payload.data()).behind == 6);
}

TEST_CASE("every question is answered, and on one node there is none") {
  for (const std::uint32_t nodes : {1U, 2U, 5U}) {
    const svm::QuestionCounters questions = run_forest(gears(), computer_of(nodes)).questions();
    CHECK((questions.rays_asked > 0) == (nodes > 1));
    CHECK((questions.records_asked > 0) == (nodes > 1));
    CHECK(questions.rays_asked == questions.rays_answered);
    CHECK(questions.records_asked == questions.records_answered);
    CHECK(questions.answers == questions.rays_asked + questions.records_asked);
  }
}

TEST_CASE("a node of forest uses exactly the memory of its plan, with the smallest that is named too") {
  for (const std::uint32_t nodes : {1U, 3U, 16U}) {
    CAPTURE(nodes);
    svm::RunOptions options = computer_of(nodes);
    for (const svm::NodeReport& node : run_forest(gears(), options).nodes) {
      CHECK(node.memory_used.bytes == node.memory_planned.bytes);
    }
    options.computer.node_memory_bytes = svm::smallest_node_memory_bytes(plan_of(gears(), options).request);
    const svm::Report least = run_forest(gears(), options);
    CHECK(least.plan.in_flight == 1);
    CHECK(outcome_of(least) == gears().outcome());
    --*options.computer.node_memory_bytes;
    CHECK(dmpc::tests::complaint_of<core::CapacityError>([&] {
            run_forest(gears(), options);
          }).find("node_memory_bytes=" + nodes::size_text(*options.computer.node_memory_bytes + 1)) != std::string::npos);
  }
}

TEST_CASE("forest refuses a grid, and scattered records") {
  for (const core::BuildOptions& options : {core::BuildOptions{}, core::BuildOptions{.record_order = core::RecordOrder::scattered,
                                                                  .structure = core::Structure::extents}}) {
    const Subject subject(tests::built_in("tetra-3"), {2, 2}, options);
    CHECK_THROWS_AS(run_forest(subject, computer_of(2)), core::UsageError);
  }
}

TEST_CASE("with forest nodes that do not render answer those that do") {
  svm::RunOptions options = computer_of(5);
  options.pages.worker_count = 1;
  const svm::Report report = run_forest(gears(), options);
  CHECK(outcome_of(report) == gears().outcome());
  for (std::size_t node = 1; node < 5; ++node) {
    CHECK(report.nodes[node].program.work.pixels_rendered == 0);
    CHECK(report.nodes[node].program.questions.rays_answered > 0);
  }
}

}  // namespace forest_test
