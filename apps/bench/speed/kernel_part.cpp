#include "apps/bench/speed/kernel_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>

#include "apps/bench/speed/crew.h"
#include "apps/bench/speed/recording.h"
#include "apps/bench/speed/rival.h"
#include "apps/bench/speed/warm_pager.h"
#include "apps/scene/subject.h"
#include "apps/system/progress.h"
#include "apps/system/stopwatch.h"
#include "apps/table/rounds.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Who traces: our grid over records in an array, or through a pager; Embree.
enum class Contender : std::uint8_t { grid, paged_grid, robust, fast };
constexpr std::array<const char*, 4> contender_names = {"grid", "paged grid", "Embree robust", "Embree fast"};
constexpr std::array<Query, 2> queries = {Query::closest, Query::any};

/// Threads take turns at pieces of so many rays: no thread gets the hard part of a picture.
constexpr std::size_t piece_rays = 512;

const char* name_of(Query query) { return query == Query::closest ? "closest hit" : "any hit"; }

/// Asks about each ray, and counts the hits.
template <core::Records R>
std::uint64_t trace_by_grid(std::span<const core::Ray> rays, R& records, const core::DatabaseHeader& header) {
  core::GridTracer<R> tracer(records, header, {});
  core::Operations operations;
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    core::Cursor cursor;
    hits += tracer.trace(ray, cursor, operations) == core::Traced::hit ? 1 : 0;
  }
  return hits;
}

/// What came of some rays.
struct RaysTraced {
  std::uint64_t hits = 0;
  double seconds = 0;  ///< processor time of the thread that had most to do
};

/// A scene, its rays, and everybody who traces them.
class Arena {
 public:
  Arena(const std::string& scene, const SpeedSettings& settings)
      : name_(scene),
        subject_(subject_of(scene, settings)),
        recording_(record_rays(subject_.database, subject_.settings, settings.rays_max())),
        robust_(subject_.database.primitives(), EmbreeMode::robust, EmbreeQuality::high),
        fast_(subject_.database.primitives(), EmbreeMode::fast, EmbreeQuality::high) {
    for (std::uint32_t i = 0; i < settings.thread_counts.back(); ++i) {
      pagers_.push_back(std::make_unique<WarmPager>(subject_.database, subject_.settings));
    }
  }

  const std::string& name() const { return name_; }
  bool has(RayClass ray_class) const { return !recording_.of(ray_class).empty(); }
  std::size_t ray_count(RayClass ray_class) const { return recording_.of(ray_class).size(); }

  /// What tells a query from another one to our grid is the rays' kind.
  void ask(RayClass ray_class, Query query) {
    for (core::Ray& ray : recording_.rays[static_cast<std::size_t>(ray_class)]) {
      ray.kind = query == Query::any ? core::RayKind::shadow : core::RayKind::primary;
    }
  }

  /// All rays of the class.
  RaysTraced trace(Contender contender, RayClass ray_class, Query query, std::uint32_t threads) {
    const std::span<const core::Ray> rays = recording_.of(ray_class);
    std::vector<RaysTraced> shares(threads);
    on_threads(threads, [&](std::size_t thread) {
      ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
      std::uint64_t hits = 0;
      for (std::size_t first = thread * piece_rays; first < rays.size(); first += threads * piece_rays) {
        hits += trace_piece(contender, rays.subspan(first, std::min(piece_rays, rays.size() - first)), query, thread);
      }
      shares[thread] = {hits, stopwatch.lap()};
    });
    return std::accumulate(shares.begin(), shares.end(), RaysTraced{}, [](const RaysTraced& a, const RaysTraced& b) {
      return RaysTraced{a.hits + b.hits, std::max(a.seconds, b.seconds)};
    });
  }

 private:
  static Subject subject_of(const std::string& scene, const SpeedSettings& settings) {
    const PictureOptions picture = settings.picture_of(SpeedPart::kernel, scene);
    return build_subject(settings.load(picture), picture);
  }

  std::uint64_t trace_piece(Contender contender, std::span<const core::Ray> rays, Query query, std::size_t thread) {
    switch (contender) {
      case Contender::grid: {
        core::LocalRecords records(subject_.database.bytes());
        return trace_by_grid(rays, records, subject_.settings.header);
      }
      case Contender::paged_grid:
        return trace_by_grid(rays, pagers_[thread]->pager(), subject_.settings.header);
      case Contender::robust:
        return robust_.trace(rays, query);
      case Contender::fast:
        break;
    }
    return fast_.trace(rays, query);
  }

  std::string name_;
  Subject subject_;
  Recording recording_;
  EmbreeRival robust_, fast_;
  std::vector<std::unique_ptr<WarmPager>> pagers_;  ///< a node each, by thread
};

/// Rays that all contenders trace one after the other.
struct Match {
  Arena* arena = nullptr;
  RayClass ray_class{};
  Query query{};
  std::uint32_t threads = 1;
  std::size_t first_comparison = 0;  ///< of its four: each grid with each Embree
  std::array<std::uint64_t, 4> hits{};
};

class KernelBench {
 public:
  KernelBench(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results)
      : settings_(settings), interrupt_(interrupt), results_(results) {}

  void measure() {
    prepare();
    const std::size_t count = matches_.size() * contender_names.size(), rounds = settings_.rounds_of(SpeedPart::kernel);
    Progress progress(std::cerr, stderr_is_terminal(), "kernel:", "measurements");
    round_by_round(rounds, count, [&](std::size_t round, std::size_t index) {
      interrupt_.check();
      progress.update(round * count + index, rounds * count);
      time(matches_[index / contender_names.size()], index % contender_names.size());
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

  void add_matches(Arena& arena) {
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
    for (const Contender ours : {Contender::grid, Contender::paged_grid}) {
      for (const Contender rival : {Contender::robust, Contender::fast}) {
        results_.push_back({.part = SpeedPart::kernel,
                            .scene = match.arena->name(),
                            .what = name_of(match.query),
                            .detail = apps::name_of(match.ray_class),
                            .threads = match.threads,
                            .subject = contender_names[static_cast<std::size_t>(ours)],
                            .rival = contender_names[static_cast<std::size_t>(rival)],
                            .unit = "Mray/s"});
      }
    }
  }

  void time(Match& match, std::size_t contender) {
    Arena& arena = *match.arena;
    arena.ask(match.ray_class, match.query);
    const RaysTraced traced =
        arena.trace(Contender{static_cast<std::uint8_t>(contender)}, match.ray_class, match.query, match.threads);
    match.hits[contender] = traced.hits;
    note(match, contender, static_cast<double>(arena.ray_count(match.ray_class)) / std::max(traced.seconds, 1e-9) / 1e6);
  }

  /// Each of ours is in two comparisons, and so is each rival.
  void note(const Match& match, std::size_t contender, double figure) {
    const bool is_rival = contender >= 2;
    for (std::size_t other = 0; other < 2; ++other) {
      const std::size_t pair = is_rival ? 2 * other + (contender - 2) : 2 * contender + other;
      Comparison& comparison = results_[match.first_comparison + pair];
      (is_rival ? comparison.rival_figures : comparison.subject_figures).push_back(figure);
    }
  }

  /// Embree names other rays that graze, or that meet the triangle they start on; more would mean that they were not asked the
  /// same.
  static void check_hits(const Match& match) {
    const auto rays = static_cast<double>(match.arena->ray_count(match.ray_class));
    core::expect(match.hits[0] == match.hits[1], "our grid hits as much through the pager as without it");
    for (const std::size_t rival : {2U, 3U}) {
      const double apart = static_cast<double>(match.hits[rival]) - static_cast<double>(match.hits[0]);
      core::expect(std::fabs(apart) <= 0.02 * rays + 16, "Embree hits about as much as our grid");
    }
  }

  const SpeedSettings& settings_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  std::deque<Arena> arenas_;
  std::vector<Match> matches_;
};

}  // namespace

void measure_kernel(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  KernelBench(settings, interrupt, results).measure();
}

}  // namespace dmpc::apps
