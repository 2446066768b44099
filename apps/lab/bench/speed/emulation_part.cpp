#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/question_ring.h"
#include "apps/lab/bench/speed/smallest_item.h"
#include "apps/lab/study/engine/timed_render.h"
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

/// Of an item, in microseconds.
constexpr std::array<double, 8> works_us = {0.5, 1, 2, 4, 8, 16, 32, 64};

/// Work alone that takes long enough to be timed.
QuestionRing ring_of(double work_us, double step_seconds, bool is_quick) {
  QuestionRing ring{.steps = static_cast<std::uint64_t>(1e-6 * work_us / step_seconds)};
  ring.items_a_node = static_cast<std::uint32_t>((is_quick ? 40e3 : 120e3) / work_us / ring.node_count);
  return ring;
}

/// Whatever nodes compute: how much work an item it takes for 64 of them to cost little more.
void measure_items(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  Progress progress(std::cerr, stderr_is_terminal(), "items of 64 nodes:", "runs");
  const double step_seconds = seconds_a_step();
  Matches matches(results);
  for (const double work_us : works_us) {
    const QuestionRing ring = ring_of(work_us, step_seconds, settings.is_quick);
    const auto add = [&matches, &interrupt, ring](const std::function<Times()>& times) {
      return matches.add([&interrupt, ring, times] {
        interrupt.check();
        return std::vector{1e6 * figures_of(times()).back() / static_cast<double>(ring.item_count())};
      });
    };
    const std::size_t alone = add([ring] { return times_of_work_alone(ring); });
    for (const RunnerKind runner : {RunnerKind::threads, RunnerKind::pool}) {
      matches.compare(add([ring, runner] { return times_of(ring, runner); }), alone,
                      {.part = SpeedPart::emulation,
                       .scene = "questions",
                       .what = item_comparison,
                       .detail = clock_names.back(),
                       .threads = ring.node_count,
                       .subject = std::string("64 nodes, ") + name_of(runner),
                       .rival = "work alone",
                       .unit = "us"});
    }
  }
  matches.measure(settings.rounds_of(SpeedPart::emulation), progress);
}

}  // namespace

void measure_emulation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::emulation)) {
    Progress progress(std::cerr, stderr_is_terminal(), scene + " emulated:", "renders");
    const Subject subject = settings.subject_of(SpeedPart::emulation, scene);
    std::optional<std::uint64_t> film_hash;
    Matches matches(results);
    for (const Computer& computer : computers) {
      matches.add([&] {
        const TimedRender one =
            render_timed(strategy_of(computer, subject.database), subject.database, subject.settings, interrupt);
        const std::uint64_t hash = account_of(one.report).film.hash();
        film_hash = film_hash.value_or(hash);
        core::expect(film_hash == hash, "all computers render one film");
        return figures_of(one.times);
      });
    }
    for (const Pairing& pairing : pairings) {
      matches.compare_timed(pairing.subject, pairing.rival,
                            {.part = SpeedPart::emulation,
                             .scene = scene,
                             .what = pairing.what,
                             .threads = computers[pairing.subject].node_count,
                             .subject = pairing.subject_name,
                             .rival = pairing.rival_name,
                             .unit = "s"});
    }
    matches.measure(settings.rounds_of(SpeedPart::emulation), progress);
  }
  measure_items(settings, interrupt, results);
}

}  // namespace dmpc::apps
