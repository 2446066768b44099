#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/edge/table/rounds.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// One computer. Pages are svm's.
struct Computer {
  Strategy strategy;
  std::uint32_t node_count;
  double cache_share;  ///< of the database, in each node's cache
};
constexpr std::array<Computer, 8> computers = {{{Strategy::svm, 2, 1},
                                                {Strategy::svm, 8, 1},
                                                {Strategy::svm, 64, 1},
                                                {Strategy::svm, 8, 0.25},
                                                {Strategy::svm, 8, 0.1},
                                                {Strategy::svm, 8, 0.05},
                                                {Strategy::dataflow, 2, 1},
                                                {Strategy::dataflow, 64, 1}}};

/// Two computers, by their places, one held against the other.
struct Pairing {
  std::size_t subject, rival;
  const char* what;
  const char* subject_name;
  const char* rival_name;
};
constexpr std::array<Pairing, 6> pairings = {{{2, 0, "nodes", "svm on 64 nodes", "svm on 2 nodes"},
                                              {1, 0, "nodes", "svm on 8 nodes", "svm on 2 nodes"},
                                              {7, 6, "nodes", "dataflow on 64 nodes", "dataflow on 2 nodes"},
                                              {3, 1, "cache", "25 %", "100 %"},
                                              {4, 1, "cache", "10 %", "100 %"},
                                              {5, 1, "cache", "5 %", "100 %"}}};

StrategyOptions strategy_of(const Computer& computer, const core::Database& database) {
  StrategyOptions options{.strategy = computer.strategy, .computer = {.node_count = computer.node_count}};
  if (computer.strategy == Strategy::svm) {
    const auto pages = std::ceil(static_cast<double>(database.page_count()) * computer.cache_share);
    options.pages.cache_pages = static_cast<std::uint32_t>(std::max(pages, 1.0));
  }
  return options;
}

/// The renders of one scene.
class EmulationBench {
 public:
  EmulationBench(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt,
                 std::vector<Comparison>& results)
      : interrupt_(interrupt),
        results_(results),
        first_(results.size()),
        subject_(settings.subject_of(SpeedPart::emulation, scene)) {
    for (const Pairing& pairing : pairings) {
      add_timed({.part = SpeedPart::emulation,
                 .scene = scene,
                 .what = pairing.what,
                 .threads = computers[pairing.subject].node_count,
                 .subject = pairing.subject_name,
                 .rival = pairing.rival_name,
                 .unit = "s"},
                results_);
    }
  }

  void measure(std::size_t computer) {
    const Times times = render(computers[computer]);
    for (std::size_t i = 0; i < pairings.size(); ++i) {
      if (pairings[i].subject == computer || pairings[i].rival == computer) {
        note(times, pairings[i].rival == computer, &results_[first_ + 2 * i]);
      }
    }
  }

 private:
  Times render(const Computer& computer) {
    const ReadyRun run =
        make_ready(strategy_of(computer, subject_.database), subject_.database, subject_.settings, interrupt_.token());
    interrupt_.check();
    DoubleStopwatch stopwatch;
    const Report report = run.start([](std::uint32_t, std::uint32_t) {}, interrupt_.token());
    const Times times = stopwatch.lap();
    interrupt_.check();
    const std::uint64_t hash = account_of(report).film.hash();
    core::expect(film_hash_.value_or(hash) == hash, "all computers render one film");
    film_hash_ = hash;
    return times;
  }

  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  std::size_t first_;
  Subject subject_;
  std::optional<std::uint64_t> film_hash_;
};

}  // namespace

void measure_emulation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const std::size_t rounds = settings.rounds_of(SpeedPart::emulation);
  for (const std::string& scene : settings.scenes_of(SpeedPart::emulation)) {
    Progress progress(std::cerr, stderr_is_terminal(), scene + " emulated:", "renders");
    EmulationBench bench(scene, settings, interrupt, results);
    round_by_round(rounds, computers.size(), progress, [&](std::size_t index) { bench.measure(index); });
  }
}

}  // namespace dmpc::apps
