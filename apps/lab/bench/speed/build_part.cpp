#include <algorithm>
#include <deque>
#include <iostream>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/edge/table/rounds.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/rival.h"
#include "core/database/database.h"

namespace dmpc::apps {
namespace {

/// Ours, and two of Embree's.
constexpr std::size_t builder_count = 3;

/// A scene that all build on so many threads.
struct BuildMatch {
  const core::Scene* scene = nullptr;
  const core::Database* database = nullptr;  ///< has what Embree is given
  std::uint32_t threads = 1;
  std::size_t first_comparison = 0;  ///< of two
};

class BuildBench {
 public:
  BuildBench(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results)
      : settings_(settings), interrupt_(interrupt), results_(results) {}

  void measure() {
    prepare();
    const std::size_t count = matches_.size() * builder_count, rounds = settings_.rounds_of(SpeedPart::build);
    Progress progress(std::cerr, stderr_is_terminal(), "databases:", "builds");
    round_by_round(rounds, count, progress, [&](std::size_t index) {
      interrupt_.check();
      time(matches_[index / builder_count], index % builder_count);
    });
  }

 private:
  void prepare() {
    for (const std::string& name : settings_.scenes_of(SpeedPart::build)) {
      interrupt_.check();
      const core::Scene& scene = scenes_.emplace_back(settings_.load(settings_.picture_of(SpeedPart::build, name)));
      const core::Database& database = databases_.emplace_back(core::build_database(scene, {}));
      for (const std::uint32_t threads : settings_.thread_counts) {
        matches_.push_back({&scene, &database, threads, results_.size()});
        add_comparison(name, threads, "Embree robust");
        add_comparison(name, threads, "Embree fast of high quality");
      }
    }
  }

  void add_comparison(const std::string& scene, std::uint32_t threads, const char* rival) {
    results_.push_back({.part = SpeedPart::build,
                        .scene = scene,
                        .what = "build",
                        .threads = threads,
                        .subject = "database",
                        .rival = rival,
                        .unit = "s"});
  }

  void time(const BuildMatch& match, std::size_t builder) {
    if (builder == 0) {
      const double seconds = seconds_on(match.threads, own_times(*match.scene, match.threads));
      results_[match.first_comparison].subject_figures.push_back(seconds);
      results_[match.first_comparison + 1].subject_figures.push_back(seconds);
      return;
    }
    const EmbreeMode mode = builder == 1 ? EmbreeMode::robust : EmbreeMode::fast;
    const EmbreeQuality quality = builder == 1 ? EmbreeQuality::medium : EmbreeQuality::high;
    const EmbreeRival rival(match.database->primitives(), mode, quality, match.threads);
    const double seconds = std::max(seconds_on(match.threads, rival.build_times()), 1e-9);
    results_[match.first_comparison + builder - 1].rival_figures.push_back(seconds);
  }

  static Times own_times(const core::Scene& scene, std::uint32_t threads) {
    DoubleStopwatch stopwatch;
    const core::Database database = core::build_database(scene, {.threads = threads});
    return stopwatch.lap();
  }
  /// On one thread both times are the same, but for what else the machine does.
  static double seconds_on(std::uint32_t threads, const Times& times) {
    return threads == 1 ? times.processor_seconds : times.wall_seconds;
  }

  const SpeedSettings& settings_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  std::deque<core::Scene> scenes_;
  std::deque<core::Database> databases_;
  std::vector<BuildMatch> matches_;
};

}  // namespace

void measure_build(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  BuildBench(settings, interrupt, results).measure();
}

}  // namespace dmpc::apps
