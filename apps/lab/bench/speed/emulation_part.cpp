#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>

#include "apps/frontend/system/progress.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t cache_node_count = 8;
/// Size of each node's cache in percent of the database. The first is the baseline of the others.
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
                             .baseline = "100 %",
                             .unit = "s",
                             .is_main = percent == cache_percents.back()});
    }
  }
  matches.measure(settings.rounds_of(SpeedPart::emulation), progress);
}

}  // namespace

void measure_emulation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::emulation)) {
    measure_caches(scene, settings, interrupt, results);
  }
}

}  // namespace dmpc::apps
