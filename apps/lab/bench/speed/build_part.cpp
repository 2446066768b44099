#include <algorithm>
#include <array>
#include <deque>
#include <iostream>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/embree_tree.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "core/database/database.h"

namespace dmpc::apps {
namespace {

/// One of Embree's trees.
struct RivalTree {
  const char* name;
  EmbreeMode mode;
  EmbreeQuality quality;
};
constexpr std::array<RivalTree, 2> rival_trees = {{{"Embree robust", EmbreeMode::robust, EmbreeQuality::medium},
                                                   {"Embree fast of high quality", EmbreeMode::fast, EmbreeQuality::high}}};

/// On one thread both times are the same, but for what else the machine does.
std::vector<double> seconds_on(std::uint32_t threads, const Times& times) {
  return {std::max(threads == 1 ? times.processor_seconds : times.wall_seconds, 1e-9)};
}

Times own_times(const core::Scene& scene, std::uint32_t threads) {
  DoubleStopwatch stopwatch;
  const core::Database database = core::build_database(scene, {.threads = threads});
  return stopwatch.lap();
}

/// All that build `scene`, whose `database` has what Embree is given, on so many threads. Both outlive the matches.
void add_builders(const std::string& name, const core::Scene& scene, const core::Database& database, std::uint32_t threads,
                  const Interrupt& interrupt, Matches& matches) {
  const std::size_t own = matches.add([&scene, &interrupt, threads] {
    interrupt.check();
    return seconds_on(threads, own_times(scene, threads));
  });
  for (const RivalTree& tree : rival_trees) {
    const std::size_t rival = matches.add([&database, &tree, &interrupt, threads] {
      interrupt.check();
      return seconds_on(threads, EmbreeTree(database.primitives(), tree.mode, tree.quality, threads).build_times());
    });
    matches.compare(own, rival,
                    {.part = SpeedPart::build,
                     .scene = name,
                     .what = "build",
                     .threads = threads,
                     .subject = "database",
                     .rival = tree.name,
                     .unit = "s"});
  }
}

}  // namespace

void measure_build(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  std::deque<core::Scene> scenes;
  std::deque<core::Database> databases;
  Matches matches(results);
  for (const std::string& name : settings.scenes_of(SpeedPart::build)) {
    interrupt.check();
    const core::Scene& scene = scenes.emplace_back(settings.load(settings.picture_of(SpeedPart::build, name)));
    const core::Database& database = databases.emplace_back(core::build_database(scene, {}));
    for (const std::uint32_t threads : settings.thread_counts) {
      add_builders(name, scene, database, threads, interrupt, matches);
    }
  }
  Progress progress(std::cerr, stderr_is_terminal(), "databases:", "builds");
  matches.measure(settings.rounds_of(SpeedPart::build), progress);
}

}  // namespace dmpc::apps
