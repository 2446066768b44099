#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iostream>
#include <string>

#include "apps/frontend/system/progress.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/kernel_arena.h"
#include "apps/lab/bench/speed/part.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::array<Query, 2> queries = {Query::closest, Query::any};

constexpr std::array our_contenders = {Contender::grid, Contender::paged_grid, Contender::bundles, Contender::paged_bundles};
constexpr std::array embree_contenders = {Contender::robust, Contender::fast};

const char* name_of(Query query) { return query == Query::closest ? "closest hit" : "any hit"; }

/// Rays that all contenders trace in turn.
struct Match {
  KernelArena& arena;
  RayClass ray_class;
  Query query;
  std::uint32_t threads;
  bool is_main;                                       ///< on the fewest threads
  std::array<std::uint64_t, contender_count> hits{};  ///< of each in the last round

  double ray_count() const { return static_cast<double>(arena.ray_count(ray_class)); }
  std::uint64_t hits_of(Contender contender) const { return hits[static_cast<std::size_t>(contender)]; }

  /// Returns millions of rays a second.
  double speed_of(Contender contender) {
    const RaysTraced traced = arena.trace(contender, ray_class, query, threads);
    hits[static_cast<std::size_t>(contender)] = traced.hits;
    return ray_count() / std::max(traced.seconds, 1e-9) / 1e6;
  }
};

/// Embree differs for rays that graze, or that meet the triangle on which they start; a larger difference would mean different
/// queries.
void check_hits(const Match& match) {
  const std::uint64_t hits = match.hits_of(Contender::grid);
  for (const Contender subject : our_contenders) {
    core::expect(match.hits_of(subject) == hits, "our grid hits as much through the pager and in bundles as without them");
  }
  for (const Contender baseline : embree_contenders) {
    const double apart = static_cast<double>(match.hits_of(baseline)) - static_cast<double>(hits);
    core::expect(std::fabs(apart) <= 0.02 * match.ray_count() + 16, "Embree hits about as much as our grid");
  }
}

/// Adds all contenders of one match, which outlives them.
void add_contenders(Match& match, const Interrupt& interrupt, Matches& matches) {
  std::array<std::size_t, contender_count> numbers{};
  for (std::size_t i = 0; i < contender_count; ++i) {
    numbers[i] = matches.add([&match, &interrupt, contender = Contender{static_cast<std::uint8_t>(i)}] {
      interrupt.check();
      return std::vector{match.speed_of(contender)};
    });
  }
  for (const Contender subject : our_contenders) {
    for (const Contender baseline : embree_contenders) {
      matches.compare(numbers[static_cast<std::size_t>(subject)], numbers[static_cast<std::size_t>(baseline)],
                      {.part = SpeedPart::kernel,
                       .scene = match.arena.name(),
                       .what = name_of(match.query),
                       .detail = apps::name_of(match.ray_class),
                       .threads = match.threads,
                       .subject = apps::name_of(subject),
                       .baseline = apps::name_of(baseline),
                       .unit = "Mray/s",
                       .is_main = subject == Contender::paged_bundles && baseline == Contender::robust && match.is_main});
    }
  }
}

void add_matches(KernelArena& arena, const SpeedSettings& settings, std::deque<Match>& matches) {
  for (const std::uint32_t threads : settings.thread_counts) {
    for (std::size_t i = 0; i < ray_class_count; ++i) {
      const auto ray_class = RayClass{static_cast<std::uint8_t>(i)};
      for (const Query query : queries) {
        if (arena.has(ray_class)) {
          matches.push_back({arena, ray_class, query, threads, threads == settings.thread_counts.front()});
        }
      }
    }
  }
}

void record_all(const SpeedSettings& settings, const Interrupt& interrupt, std::deque<KernelArena>& arenas) {
  Progress progress(std::cerr, stderr_is_terminal(), "recording rays:", "scenes");
  const std::vector<std::string> scenes = settings.scenes_of(SpeedPart::kernel);
  for (const std::string& scene : scenes) {
    interrupt.check();
    progress.update(arenas.size(), scenes.size());
    arenas.emplace_back(scene, settings);
  }
}

}  // namespace

void measure_kernel(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  std::deque<KernelArena> arenas;
  record_all(settings, interrupt, arenas);
  std::deque<Match> all;
  Matches matches(results);
  for (KernelArena& arena : arenas) {
    add_matches(arena, settings, all);
  }
  for (Match& match : all) {
    add_contenders(match, interrupt, matches);
  }
  Progress progress(std::cerr, stderr_is_terminal(), "kernel:", "measurements");
  matches.measure(settings.rounds_of(SpeedPart::kernel), progress);
  std::for_each(all.begin(), all.end(), check_hits);
}

}  // namespace dmpc::apps
