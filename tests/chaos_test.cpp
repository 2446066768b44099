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

#include "core/database.h"
#include "core/render.h"
#include "nodes/chaos.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"

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

/// A scene small enough to render hundreds of times, and its picture by the reference renderer.
class Subject {
 public:
  Subject(const core::Scene& scene, int side)
      : database_(core::build_database(scene, {.page_size_bytes = 512})),
        settings_{database_.header(), core::Camera(scene.view, database_.header().frame, side, side, 1), {}} {
    core::LocalRecords records(database_.bytes());
    core::GridTracer tracer(records, database_.header(), core::TraversalOptions{});
    core::Operations operations;
    hash_ = core::render(tracer, settings_, operations).hash();
    rays_ = operations.rays;
  }

  svm::Report run(svm::Strategy strategy, const svm::RunOptions& options) const {
    return strategy == svm::Strategy::svm ? svm::run_svm(database_, settings_, options, {})
                                          : svm::run_replicated(database_, settings_, options, {});
  }
  bool is_right(const svm::Report& report) const { return report.film.hash() == hash_ && report.operations().rays == rays_; }

 private:
  core::Database database_;
  core::RenderSettings settings_;
  std::uint64_t hash_ = 0;
  decltype(core::Operations::rays) rays_{};
};

/// The computer that a seed stands for: few nodes or many, a cache of one page or of some, one pixel in flight or several.
svm::RunOptions options_of(std::uint64_t seed, svm::Strategy strategy) {
  constexpr std::uint32_t node_counts[] = {2, 3, 5, 8};
  nodes::ChaosStream draws(core::mix(seed));
  svm::RunOptions options{.node_count = node_counts[draws.below(std::size(node_counts))]};
  options.in_flight = 1 + draws.below(8);
  options.work_item_side = draws.below(4);
  if (strategy == svm::Strategy::svm) {
    options.cache_pages = 1 + draws.below(16);
  }
  options.chaos = nodes::chaos_of(seed);
  return options;
}

/// What chaos did in all runs together.
struct Damage {
  std::uint64_t packets_held = 0, quanta_sat_out = 0, runs_with_fewer_credits = 0;

  void add(const svm::Report& report, const svm::Plan& planned) {
    packets_held += report.host.held;
    for (const svm::NodeReport& node : report.nodes) {
      packets_held += node.counters.held;
      quanta_sat_out += node.counters.sat_out;
    }
    runs_with_fewer_credits +=
        report.plan.request_credits < planned.request_credits || report.plan.film_credits < planned.film_credits ? 1 : 0;
  }
};

void check_seeds(const Subject& subject, svm::Strategy strategy) {
  const std::uint64_t first = from_environment("DMPC_CHAOS_FIRST", 1);
  const std::uint64_t count = from_environment("DMPC_CHAOS_SEEDS", seeds_by_default);
  Damage damage;
  for (std::uint64_t seed = first; seed - first < count; ++seed) {
    CAPTURE(seed);
    const svm::RunOptions options = options_of(seed, strategy);
    const svm::Report report = subject.run(strategy, options);
    REQUIRE(subject.is_right(report));
    svm::PlanRequest calm = report.plan.request;
    calm.chaos.reset();
    damage.add(report, svm::make_plan(calm));
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

}  // namespace

TEST_CASE("chaos: any seed leaves svm its picture") { check_seeds(Subject(mirrors_and_glass(), 16), svm::Strategy::svm); }

TEST_CASE("chaos: any seed leaves replicated its picture") {
  check_seeds(Subject(mirrors_and_glass(), 16), svm::Strategy::replicated);
}

TEST_CASE("under chaos a node uses exactly the memory of its plan, the packets held back included") {
  const Subject subject(mirrors_and_glass(), 8);
  for (const svm::Strategy strategy : {svm::Strategy::svm, svm::Strategy::replicated}) {
    const svm::Report calm = subject.run(strategy, {.node_count = 3});
    const svm::Report disturbed = subject.run(strategy, {.node_count = 3, .chaos = storm});
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(disturbed.nodes[i].memory_used.bytes == disturbed.nodes[i].memory_planned.bytes);
      CHECK(disturbed.nodes[i].memory_used.total() == calm.nodes[i].memory_used.total() + disturbed.plan.held_bytes);
    }
    CHECK(disturbed.plan.held_bytes > 0);
    CHECK(calm.plan.held_bytes == 0);
  }
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
