#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>
#include <string>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/progress.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/question_ring.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t cache_node_count = 8;
/// Of the database, in percent, in each node's cache. The first is the rival of the others.
constexpr std::array<int, 4> cache_percents = {100, 25, 10, 5};

StrategyOptions with_cache(int percent, const core::Database& database) {
  const auto pages = std::ceil(static_cast<double>(database.page_count()) * percent / 100);
  StrategyOptions options{.strategy = Strategy::svm, .computer = {.node_count = cache_node_count}};
  options.pages.cache_pages = static_cast<std::uint32_t>(std::max(pages, 1.0));
  return options;
}

void measure_caches(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt,
                    std::vector<Comparison>& results) {
  Progress progress(std::cerr, stderr_is_terminal(), scene + " emulated:", "renders");
  const Subject subject = settings.subject_of(SpeedPart::emulation, scene);
  std::optional<std::uint64_t> film_hash;
  Matches matches(results);
  for (const int percent : cache_percents) {
    const std::size_t number = matches.add([&, percent] {
      const TimedRender one = render_timed(with_cache(percent, subject.database), subject.database, subject.settings, interrupt);
      const std::uint64_t hash = account_of(one.report).film.hash();
      film_hash = film_hash.value_or(hash);
      core::expect(film_hash == hash, "all caches give one film");
      return figures_of(one.times);
    });
    if (number > 0) {
      matches.compare_timed(number, 0,
                            {.part = SpeedPart::emulation,
                             .scene = scene,
                             .what = "cache",
                             .threads = cache_node_count,
                             .subject = std::to_string(percent) + " %",
                             .rival = "100 %",
                             .unit = "s"});
    }
  }
  matches.measure(settings.rounds_of(SpeedPart::emulation), progress);
}

/// Of an item, in microseconds.
constexpr std::array<double, 8> works_us = {0.5, 1, 2, 4, 8, 16, 32, 64};

/// Work alone that takes long enough to be timed.
QuestionRing ring_of(double work_us, double step_seconds, bool is_quick) {
  QuestionRing ring{.steps = static_cast<std::uint64_t>(1e-6 * work_us / step_seconds)};
  ring.items_a_node = static_cast<std::uint32_t>((is_quick ? 40e3 : 120e3) / work_us / ring.node_count);
  return ring;
}

/// Whatever nodes compute: how much work an item it takes for 64 of them to cost little more. After E. Slaughter and others,
/// "Task Bench" (SC 2020): minimum effective task granularity.
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
                       .what = "work an item",
                       .detail = shortest(work_us) + " us",
                       .threads = ring.node_count,
                       .subject = std::string("64 nodes, ") + name_of(runner),
                       .rival = "work alone",
                       .unit = "us of processors"});
    }
  }
  matches.measure(settings.rounds_of(SpeedPart::emulation), progress);
}

}  // namespace

void measure_emulation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::emulation)) {
    measure_caches(scene, settings, interrupt, results);
  }
  measure_items(settings, interrupt, results);
}

}  // namespace dmpc::apps
