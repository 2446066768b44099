// One picture under chaos: whatever a seed does to packets, nodes, links and credits, the film equals the reference renderer's.
//
// A run checks its laws of conservation itself. tests/chaos has more seeds tried, by the variables DMPC_CHAOS_FIRST and
// DMPC_CHAOS_SEEDS of the environment.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string>

#include "dataflow/run.h"
#include "nodes/chaos.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t seeds_by_default = 30;
#else
constexpr std::uint64_t seeds_by_default = 200;
#endif

/// A whole number from the environment, or `standard`.
std::uint64_t from_environment(const char* name, std::uint64_t standard) {
  const char* const text = std::getenv(name);
  return text == nullptr ? standard : std::stoull(text);
}

/// Small enough to render hundreds of times.
const Subject& subject() {
  static const Subject subject(mirrors_and_glass(), {16, 16}, {.page_size_bytes = 512});
  return subject;
}

/// The same in passes, by every fourth seed.
const Subject& refined() {
  static const Subject refined(mirrors_and_glass(), {.width = 12, .height = 9, .samples = 2, .refinement = {.error = 0.03}},
                               {.page_size_bytes = 512});
  return refined;
}
const Subject& subject_of(std::uint64_t seed) { return seed % 4 == 3 ? refined() : subject(); }

/// The draws that choose the computer of a seed: few nodes or many, with starved bounds or ample ones.
nodes::ChaosStream draws_of(std::uint64_t seed) { return nodes::ChaosStream(core::mix(seed)); }

std::uint32_t node_count(nodes::ChaosStream& draws) {
  constexpr std::uint32_t node_counts[] = {2, 3, 5, 8};
  return node_counts[draws.below(std::size(node_counts))];
}

/// With one pixel in flight or several.
svm::RunOptions options_of(std::uint64_t seed, nodes::ChaosStream& draws) {
  svm::RunOptions options{.node_count = node_count(draws)};
  options.in_flight = 1 + draws.below(8);
  options.work_item_side = draws.below(4);
  options.chaos = nodes::chaos_of(seed);
  return options;
}

/// With a cache of one page or of some.
svm::Report run_svm(std::uint64_t seed) {
  nodes::ChaosStream draws = draws_of(seed);
  svm::RunOptions options = options_of(seed, draws);
  options.cache_pages = 1 + draws.below(16);
  return svm::run_svm(subject_of(seed).database(), subject_of(seed).settings(), options, {});
}

svm::Report run_replicated(std::uint64_t seed) {
  nodes::ChaosStream draws = draws_of(seed);
  return svm::run_replicated(subject_of(seed).database(), subject_of(seed).settings(), options_of(seed, draws), {});
}

/// With one ray a message or more, with no credits between nodes, one or more, and with short queues or long ones.
dataflow::Report run_dataflow(std::uint64_t seed) {
  constexpr std::optional<std::uint32_t> ray_credits[] = {0, 1, std::nullopt}, queue_packets[] = {0, 1, 2, std::nullopt};
  nodes::ChaosStream draws = draws_of(seed);
  dataflow::RunOptions options{.node_count = node_count(draws)};
  const std::uint32_t ray_batch = draws.below(11);
  if (ray_batch > 0) {
    options.ray_batch = ray_batch;
  }
  options.ray_credits = ray_credits[draws.below(std::size(ray_credits))];
  options.queue_packets = queue_packets[draws.below(std::size(queue_packets))];
  options.balance = {.balance = draws.chance(50) ? dataflow::Balance::subsampled : dataflow::Balance::equal_size, .subsample = 4};
  options.chaos = nodes::chaos_of(seed);
  return dataflow::run_dataflow(subject_of(seed).database(), subject_of(seed).settings(), options, {});
}

std::uint32_t credits_of(const svm::Plan& plan) { return plan.request_credits + plan.film_credits; }
std::uint32_t credits_of(const dataflow::Plan& plan) { return plan.ray_credits + plan.host_credits + plan.film_credits; }

/// What chaos did in all runs together.
struct Damage {
  std::uint64_t packets_held = 0, quanta_sat_out = 0, runs_with_fewer_credits = 0;

  template <class Report>
  void add(const Report& report) {
    packets_held += report.host.held;
    for (const auto& node : report.nodes) {
      packets_held += node.counters.held;
      quanta_sat_out += node.counters.sat_out;
    }
    auto calm = report.plan.request;
    calm.chaos.reset();
    runs_with_fewer_credits += credits_of(report.plan) < credits_of(make_plan(calm)) ? 1 : 0;
  }
};

/// `run` renders the subject on the computer of a seed.
template <class Run>
void check_seeds(Run run) {
  const std::uint64_t first = from_environment("DMPC_CHAOS_FIRST", 1);
  const std::uint64_t count = from_environment("DMPC_CHAOS_SEEDS", seeds_by_default);
  Damage damage;
  for (std::uint64_t seed = first; seed - first < count; ++seed) {
    CAPTURE(seed);
    const auto report = run(seed);
    REQUIRE(outcome_of(report) == subject_of(seed).outcome());
    damage.add(report);
  }
  CHECK(damage.packets_held >= count);
  CHECK((damage.quanta_sat_out > 0 || count < 20));
  CHECK((damage.runs_with_fewer_credits > 0 || count < 20));
}

/// Some chaos that does everything often.
constexpr nodes::Chaos storm{.seed = 11,
                             .held_percent = 70,
                             .delay_quanta_max = 30,
                             .slow_link_percent = 30,
                             .slow_node_percent = 30,
                             .shrinks_credits = true};

/// `run` renders a small scene on 3 nodes, disturbed or not.
template <class Run>
void check_memory(Run run) {
  const auto calm = run(std::nullopt), disturbed = run(storm);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(disturbed.nodes[i].memory_used.bytes == disturbed.nodes[i].memory_planned.bytes);
    CHECK(disturbed.nodes[i].memory_used.total() == calm.nodes[i].memory_used.total() + disturbed.plan.held_bytes);
  }
  CHECK(disturbed.plan.held_bytes > 0);
  CHECK(calm.plan.held_bytes == 0);
}

}  // namespace

TEST_CASE("chaos: any seed leaves svm its picture") { check_seeds(run_svm); }

TEST_CASE("chaos: any seed leaves replicated its picture") { check_seeds(run_replicated); }

TEST_CASE("chaos: any seed leaves dataflow its picture") { check_seeds(run_dataflow); }

TEST_CASE("under chaos a node uses exactly the memory of its plan, the packets held back included") {
  using Chaos = std::optional<nodes::Chaos>;
  const core::Database& database = subject().database();
  const core::RenderSettings& settings = subject().settings();
  check_memory([&](Chaos chaos) { return svm::run_svm(database, settings, {.node_count = 3, .chaos = chaos}, {}); });
  check_memory([&](Chaos chaos) { return svm::run_replicated(database, settings, {.node_count = 3, .chaos = chaos}, {}); });
  check_memory([&](Chaos chaos) {
    if (chaos) {
      chaos->shrinks_credits = false;  // with fewer credits a node takes less
    }
    return dataflow::run_dataflow(database, settings, {.node_count = 3, .chaos = chaos}, {});
  });
}

TEST_CASE("under chaos mailboxes stay as large as the credits that were planned without it") {
  const svm::PlanRequest calm{.page_count = 200, .node_count = 4, .in_flight = 8, .width = 8, .height = 8};
  svm::PlanRequest disturbed = calm;
  std::uint32_t fewest = svm::make_plan(calm).request_credits;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    disturbed.chaos = nodes::Chaos{.seed = seed};
    const svm::Plan plan = svm::make_plan(disturbed);
    CHECK(plan.node_mailbox.small_slots == svm::make_plan(calm).node_mailbox.small_slots);
    CHECK(plan.node_mailbox.bulk_slots == svm::make_plan(calm).node_mailbox.bulk_slots);
    CHECK(plan.host_mailbox.bulk_slots == svm::make_plan(calm).host_mailbox.bulk_slots);
    fewest = std::min(fewest, plan.request_credits);
  }
  CHECK(fewest == 1);
}

}  // namespace dmpc::tests
