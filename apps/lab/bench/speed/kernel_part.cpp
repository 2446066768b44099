#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iostream>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/table/rounds.h"
#include "apps/lab/bench/speed/kernel_arena.h"
#include "apps/lab/bench/speed/parts.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::array<Query, 2> queries = {Query::closest, Query::any};

/// Who is held against whom.
struct Pair {
  Contender subject, rival;
};
constexpr std::array<Pair, 10> pairs = {{{Contender::grid, Contender::robust},
                                         {Contender::grid, Contender::fast},
                                         {Contender::paged_grid, Contender::robust},
                                         {Contender::paged_grid, Contender::fast},
                                         {Contender::bundles, Contender::robust},
                                         {Contender::bundles, Contender::fast},
                                         {Contender::bundles, Contender::robust_packets},
                                         {Contender::paged_bundles, Contender::robust},
                                         {Contender::paged_bundles, Contender::fast},
                                         {Contender::paged_bundles, Contender::robust_packets}}};

const char* name_of(Query query) { return query == Query::closest ? "closest hit" : "any hit"; }

/// Rays that all contenders trace one after the other.
struct Match {
  KernelArena* arena = nullptr;
  RayClass ray_class{};
  Query query{};
  std::uint32_t threads = 1;
  std::size_t first_comparison = 0;  ///< of those of its pairs
  std::array<std::uint64_t, contender_count> hits{};

  std::uint64_t hits_of(Contender contender) const { return hits[static_cast<std::size_t>(contender)]; }
};

class KernelBench {
 public:
  KernelBench(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results)
      : settings_(settings), interrupt_(interrupt), results_(results) {}

  void measure() {
    prepare();
    const std::size_t count = matches_.size() * contender_count, rounds = settings_.rounds_of(SpeedPart::kernel);
    Progress progress(std::cerr, stderr_is_terminal(), "kernel:", "measurements");
    round_by_round(rounds, count, progress, [&](std::size_t index) {
      interrupt_.check();
      time(matches_[index / contender_count], Contender{static_cast<std::uint8_t>(index % contender_count)});
    });
    std::for_each(matches_.begin(), matches_.end(), check_hits);
  }

 private:
  void prepare() {
    Progress progress(std::cerr, stderr_is_terminal(), "recording rays:", "scenes");
    const std::vector<std::string> scenes = settings_.scenes_of(SpeedPart::kernel);
    for (const std::string& scene : scenes) {
      interrupt_.check();
      progress.update(arenas_.size(), scenes.size());
      add_matches(arenas_.emplace_back(scene, settings_));
    }
  }

  void add_matches(KernelArena& arena) {
    for (const std::uint32_t threads : settings_.thread_counts) {
      for (std::size_t i = 0; i < ray_class_count; ++i) {
        const auto ray_class = RayClass{static_cast<std::uint8_t>(i)};
        for (const Query query : queries) {
          if (arena.has(ray_class)) {
            matches_.push_back({&arena, ray_class, query, threads, results_.size()});
            add_comparisons(matches_.back());
          }
        }
      }
    }
  }

  void add_comparisons(const Match& match) {
    for (const Pair& pair : pairs) {
      results_.push_back({.part = SpeedPart::kernel,
                          .scene = match.arena->name(),
                          .what = name_of(match.query),
                          .detail = apps::name_of(match.ray_class),
                          .threads = match.threads,
                          .subject = apps::name_of(pair.subject),
                          .rival = apps::name_of(pair.rival),
                          .unit = "Mray/s"});
    }
  }

  void time(Match& match, Contender contender) {
    const RaysTraced traced = match.arena->trace(contender, match.ray_class, match.query, match.threads);
    match.hits[static_cast<std::size_t>(contender)] = traced.hits;
    const auto rays = static_cast<double>(match.arena->ray_count(match.ray_class));
    note(match, contender, rays / std::max(traced.seconds, 1e-9) / 1e6);
  }

  /// In every pair that the contender is one of.
  void note(const Match& match, Contender contender, double figure) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      Comparison& comparison = results_[match.first_comparison + i];
      if (pairs[i].subject == contender) {
        comparison.subject_figures.push_back(figure);
      } else if (pairs[i].rival == contender) {
        comparison.rival_figures.push_back(figure);
      }
    }
  }

  /// Embree names other rays that graze, or that meet the triangle they start on; more would mean that they were not asked the
  /// same.
  static void check_hits(const Match& match) {
    const std::uint64_t ours = match.hits_of(Contender::grid);
    const auto rays = static_cast<double>(match.arena->ray_count(match.ray_class));
    for (const Pair& pair : pairs) {
      core::expect(match.hits_of(pair.subject) == ours, "our grid hits as much through the pager and in bundles as without them");
      const double apart = static_cast<double>(match.hits_of(pair.rival)) - static_cast<double>(ours);
      core::expect(std::fabs(apart) <= 0.02 * rays + 16, "Embree hits about as much as our grid");
    }
  }

  const SpeedSettings& settings_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  std::deque<KernelArena> arenas_;
  std::vector<Match> matches_;
};

}  // namespace

void measure_kernel(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  KernelBench(settings, interrupt, results).measure();
}

}  // namespace dmpc::apps
