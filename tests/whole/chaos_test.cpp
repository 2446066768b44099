// One picture under chaos: whatever a seed does to packets, nodes, links and credits, the film equals the reference renderer's.
//
// A seed chooses the picture, the number of nodes, their bounds, the ranks they are on, and whether it is made in parts
// (tests/support/chaos_case.h). A run checks its laws of conservation itself. tests/chaos has more seeds tried, by the variables
// DMPC_CHAOS_FIRST and DMPC_CHAOS_SEEDS of the environment.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/picture/film/partial_picture.h"
#include "dataflow/ranks.h"
#include "dataflow/run.h"
#include "nodes/chaos.h"
#include "nodes/ranks/rank_links.h"
#include "svm/forest/strategy.h"
#include "svm/ranks.h"
#include "svm/run.h"
#include "tests/support/chaos_case.h"
#include "tests/support/chaos_coverage.h"
#include "tests/support/environment.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_chaos_test {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t few_seeds = 5, many_seeds = 20;
#else
constexpr std::uint64_t few_seeds = 35, many_seeds = 140;
#endif

/// A page of the largest size with its header, or any other packet.
constexpr std::size_t page_packet_bytes_max = 65536 + 64;

/// Small enough to render hundreds of times.
const Subject& subject() { return chaos_subject(0); }

/// Keeps what there is when light has come `every` times, and then stops the run.
class StoppingKeeper {
 public:
  explicit StoppingKeeper(std::uint32_t every) : every_(every) {}

  core::Continuation continuation(const std::optional<core::PartialPicture>& start) {
    return {start ? &*start : nullptr, [this] { return ++asked_ % every_ == 0; },
            [this](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
              kept.emplace(core::partial_picture(film, pass, done));
              stop_.request_stop();
            }};
  }
  std::stop_token token() const { return stop_.get_token(); }

  std::optional<core::PartialPicture> kept;

 private:
  std::uint32_t every_;
  std::uint32_t asked_ = 0;
  std::stop_source stop_;
};

svm::Report run_svm(const Subject& subject, const svm::RunOptions& options, const std::stop_token& stop) {
  return svm::run_svm(subject.database(), subject.settings(), options, stop);
}
svm::Report run_replicated(const Subject& subject, const svm::RunOptions& options, const std::stop_token& stop) {
  return svm::run_replicated(subject.database(), subject.settings(), options, stop);
}
svm::Report run_forest(const Subject& subject, const svm::RunOptions& options, const std::stop_token& stop) {
  return svm::run_forest(subject.database(), subject.settings(), options, stop);
}
dataflow::Report run_dataflow(const Subject& subject, const dataflow::RunOptions& options, const std::stop_token& stop) {
  return dataflow::run_dataflow(subject.database(), subject.settings(), options, stop);
}

std::uint32_t credits_of(const svm::Plan& plan) { return plan.request_credits + plan.film_credits; }
std::uint32_t credits_of(const dataflow::Plan& plan) {
  return plan.ray_credits + plan.ray_slots + plan.host_credits + plan.film_credits;
}

/// What chaos did in a run.
template <class Report>
void cover_damage(Coverage& covered, const Report& report) {
  std::uint64_t packets_delayed = report.host.held, quanta_sat_out = 0;
  for (const auto& node : report.nodes) {
    packets_delayed += node.counters.held;
    quanta_sat_out += node.counters.sat_out;
  }
  auto calm = report.plan.request;
  calm.computer.chaos.reset();
  calm.computer.ranks = nullptr;
  covered.count("there was a packet held back", packets_delayed > 0);
  covered.count("there was a node that sat out", quanta_sat_out > 0);
  covered.count("there was a credit taken away", credits_of(report.plan) < credits_of(make_plan(calm)));
}

/// What another rank does while rank 0 runs with such options.
void follow(const svm::RunOptions& /*options*/, nodes::RankLinks& links) {
  svm::WorkerCallbacks callbacks;
  callbacks.strategies.push_back(svm::forest_strategy());
  svm::follow(links, {}, callbacks);
}
void follow(const dataflow::RunOptions& /*options*/, nodes::RankLinks& links) { dataflow::follow(links, {}); }

/// On ranks, of which some seeds have several: late frames on the way, as well. A computer that is modelled has none.
template <class Options, class Run>
auto run_on_ranks(const ChaosCase& one, Options options, const Run& run, const std::stop_token& stop) {
  const std::uint32_t ranks = options.computer.machine ? 1 : one.rank_count();
  if (ranks == 1) {
    return run(one.subject(), options, stop);
  }
  const Subject& subject = one.subject();  // made before there are threads
  const nodes::LoopbackTrouble trouble{.seed = one.seed(), .late_polls_max = static_cast<std::uint32_t>(one.seed() % 8)};
  const auto run_here = [&](nodes::Fabric& fabric) {
    nodes::RankLinks links(fabric);
    std::optional<decltype(run(subject, options, stop))> report;
    if (fabric.rank() == 0) {
      Options own = options;
      own.computer.ranks = &links;
      report.emplace(run(subject, own, stop));
    } else {
      follow(options, links);
    }
    return report;
  };
  auto results = on_ranks(ranks, trouble, run_here, nodes::frame_bytes_for(page_packet_bytes_max));
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
  }
  REQUIRE(results.front().value);
  return std::move(**results.front().value);
}

/// The whole picture in one run.
template <class Options, class Run, class Strategy>
void check_whole(ChaosCase& one, Coverage& covered, const Options& options, const Run& run, const Strategy& strategy) {
  const auto report = run_on_ranks(one, options, run, {});
  REQUIRE(outcome_of(report) == one.subject().outcome());
  cover_damage(covered, report);
  cover(covered, report, strategy);
}

/// How often light comes to the host in the first part: travelling rays send theirs in few packets.
std::uint32_t part_of(const ChaosCase& one, const svm::Strategy& /*strategy*/) { return one.part(); }
std::uint32_t part_of(const ChaosCase& one, Rays /*strategy*/) { return 1 + one.part() % 4; }

/// Each run goes on where the one before was stopped, with options of its own.
template <class MakeOptions, class Run, class Strategy>
void check_parts(ChaosCase& one, Coverage& covered, const MakeOptions& options_of, const Run& run, const Strategy& strategy) {
  std::optional<core::PartialPicture> start;
  for (std::uint32_t round = 0;; ++round) {
    StoppingKeeper keeper(part_of(one, strategy) << std::min(round, 16U));  // so that few runs make a picture
    auto options = options_of(one, round);
    options.continuation = keeper.continuation(start);
    const auto report = run_on_ranks(one, options, run, keeper.token());
    cover_damage(covered, report);
    cover(covered, report, strategy);
    if (report.end == nodes::RunEnd::finished) {
      REQUIRE(report.film.hash() == one.subject().outcome().film_hash);
      covered.count("there was a part that went on", round > 0);
      return;
    }
    REQUIRE(keeper.kept);
    start = std::move(keeper.kept);
  }
}

/// From so many seeds on each kind of case has come.
constexpr std::uint64_t seeds_of_all_kinds = 140;

/// `run` renders what a seed stands for.
template <class MakeOptions, class Run, class Strategy>
void check_seeds(const Strategy& strategy, const MakeOptions& options_of, const Run& run, std::uint64_t wanted,
                 core::Structure structure = core::Structure::grid) {
  const std::uint64_t first = number_from_environment("DMPC_CHAOS_FIRST", 1);
  const std::uint64_t count = number_from_environment("DMPC_CHAOS_SEEDS", wanted);
  Coverage covered(name_of(strategy));
  for (std::uint64_t seed = first; seed - first < count; ++seed) {
    CAPTURE(seed);
    ChaosCase one(seed, structure);
    CAPTURE(one);
    INFO("again: tests/chaos --seeds=1 --first=", seed);
    const auto options = options_of(one, 0);
    cover(covered, one);
    cover(covered, one, options, strategy);
    if (one.is_in_parts()) {
      check_parts(one, covered, options_of, run, strategy);
    } else {
      check_whole(one, covered, options, run, strategy);
    }
  }
  CHECK(covered.missed("DMPC_CHAOS_SEEDS", count >= seeds_of_all_kinds, "there was") == std::vector<std::string>());
}

template <class Run>
void check_pages(const svm::Strategy* strategy, const Run& run, std::uint64_t seeds,
                 core::Structure structure = core::Structure::grid) {
  const auto options_of = [strategy](ChaosCase& one, std::uint32_t round) { return one.page_options(strategy, round); };
  check_seeds(*strategy, options_of, run, seeds, structure);
}

void check_svm(std::uint64_t seeds) { check_pages(svm::svm_strategy(), run_svm, seeds); }
void check_replicated(std::uint64_t seeds) { check_pages(svm::replicated_strategy(), run_replicated, seeds); }
void check_forest(std::uint64_t seeds) { check_pages(svm::forest_strategy(), run_forest, seeds, core::Structure::extents); }

void check_dataflow(std::uint64_t seeds, core::Structure structure = core::Structure::grid) {
  check_seeds(
      Rays(), [](ChaosCase& one, std::uint32_t round) { return one.ray_options(round); }, run_dataflow, seeds, structure);
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

TEST_CASE("chaos: any seed leaves svm its picture") { check_svm(few_seeds); }

TEST_CASE("chaos: any seed leaves replicated its picture") { check_replicated(few_seeds); }

TEST_CASE("chaos: any seed leaves forest its picture") { check_forest(few_seeds); }

TEST_CASE("chaos: any seed leaves dataflow its picture") { check_dataflow(few_seeds); }

TEST_CASE("chaos: any seed leaves svm and dataflow the picture of voxels") {
  check_pages(svm::svm_strategy(), run_svm, few_seeds / 2, core::Structure::voxels);
  check_dataflow(few_seeds / 2, core::Structure::voxels);
}

TEST_CASE("many seeds of chaos leave every strategy its picture" * doctest::test_suite("slow")) {
  check_svm(many_seeds);
  check_replicated(many_seeds);
  check_forest(many_seeds * 3 / 2);
  check_dataflow(many_seeds);
}

TEST_CASE("under chaos a node uses exactly the memory of its plan, the packets held back included") {
  using Chaos = std::optional<nodes::Chaos>;
  const core::Database& database = subject().database();
  const core::RenderSettings& settings = subject().settings();
  check_memory(
      [&](Chaos chaos) { return svm::run_svm(database, settings, {.computer = {.node_count = 3, .chaos = chaos}}, {}); });
  check_memory(
      [&](Chaos chaos) { return svm::run_replicated(database, settings, {.computer = {.node_count = 3, .chaos = chaos}}, {}); });
  check_memory([&](Chaos chaos) {
    if (chaos) {
      chaos->shrinks_credits = false;  // with fewer credits a node takes less
    }
    return dataflow::run_dataflow(database, settings, {.computer = {.node_count = 3, .chaos = chaos}}, {});
  });
}

TEST_CASE("under chaos mailboxes stay as large as the credits that were planned without it") {
  const svm::PlanRequest calm{
      .page_count = 200, .computer = {.node_count = 4}, .pages = {.in_flight = 8}, .width = 8, .height = 8};
  svm::PlanRequest disturbed = calm;
  std::uint32_t fewest = svm::make_plan(calm).request_credits;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    disturbed.computer.chaos = nodes::Chaos{.seed = seed};
    const svm::Plan plan = svm::make_plan(disturbed);
    CHECK(plan.node_mailbox.small_slots == svm::make_plan(calm).node_mailbox.small_slots);
    CHECK(plan.node_mailbox.bulk_slots == svm::make_plan(calm).node_mailbox.bulk_slots);
    CHECK(plan.host_mailbox.bulk_slots == svm::make_plan(calm).host_mailbox.bulk_slots);
    fewest = std::min(fewest, plan.request_credits);
  }
  CHECK(fewest == 1);
}

}  // namespace dmpc::tests::whole_chaos_test
