#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/completed_process.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/database/conversion.h"
#include "core/database/parallel.h"
#include "core/database/shading/light_spheres.h"

namespace dmpc::apps {
namespace {

using Kind = RunnerKind;
using S = Strategy;

struct PlainContender {
  std::uint32_t count;                              ///< number of threads or nodes
  std::optional<Strategy> strategy = std::nullopt;  ///< nothing: the plain renderer
  RunnerKind runner = RunnerKind::threads;
  bool is_command = false;  ///< also timed as a whole command, and among the main ones
  TracerChoice tracer = TracerChoice::grid;
};
constexpr std::array<PlainContender, 17> plain_contenders = {{{1},
                                                              {2},
                                                              {1, S::svm, Kind::threads, true},
                                                              {2, S::svm, Kind::threads, true},
                                                              {2, S::svm, Kind::pool},
                                                              {8, S::svm},
                                                              {64, S::svm, Kind::threads, true},
                                                              {64, S::svm, Kind::pool, true},
                                                              {2, S::dataflow},
                                                              {2, S::dataflow, Kind::pool},
                                                              {64, S::dataflow},
                                                              {64, S::dataflow, Kind::pool, true},
                                                              {8, S::forest},
                                                              {8, S::forest, Kind::pool},
                                                              {2, S::replicated},
                                                              {2, S::replicated, Kind::threads, false, TracerChoice::embree},
                                                              {64, S::svm, Kind::virtual_time}}};
constexpr std::array<PlainContender, 4> path_contenders = {{{1}, {2}, {1, S::replicated}, {2, S::svm}}};

/// "svm on 64 nodes, pool".
std::string name_of(const PlainContender& contender) {
  return contender.strategy ? std::string(apps::name_of(*contender.strategy)) + " on " + counted(contender.count, "node") +
                                  (contender.runner == Kind::threads ? "" : std::string(", ") + apps::name_of(contender.runner)) +
                                  (contender.tracer == TracerChoice::grid ? "" : ", Embree")
                            : "plain on " + counted(contender.count, "thread");
}

StrategyOptions strategy_of(const PlainContender& contender) {
  StrategyOptions options{
      .strategy = *contender.strategy, .computer = {.node_count = contender.count}, .tracer = contender.tracer};
  options.runner.kind = contender.runner;
  choose_pool(contender.runner, options.computer);
  if (contender.runner == Kind::virtual_time) {
    choose_machine(options);
  }
  return options;
}

/// Processor time of all children that have been waited for.
double children_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds_of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

bool has_curved(const core::Database& database) {
  const auto& leaves = database.records().leaves;
  return leaves[static_cast<std::size_t>(core::PrimitiveKind::sphere)] +
             leaves[static_cast<std::size_t>(core::PrimitiveKind::cone)] >
         0;
}

class PlainBench {
 public:
  /// `forest` is the scene as that strategy has it; nullptr if no contender needs it. The arguments outlive it.
  PlainBench(SpeedPart part, const std::string& scene, const Subject& subject, const Subject* forest,
             const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results)
      : part_(part),
        scene_(scene),
        subject_(subject),
        forest_(forest),
        settings_(settings),
        interrupt_(interrupt),
        results_(results),
        is_curved_(has_curved(subject.database)),
        plain_(subject) {}

  /// The first two contenders are the plain renderer on 1 and on 2 threads.
  void measure(std::span<const PlainContender> all) {
    Matches matches(results_);
    for (const PlainContender& contender : all) {
      matches.add([&] { return figures_of(render(contender)); });
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t baseline = part_ == SpeedPart::paths ? all[i].count - 1 : 1;
      matches.compare_timed(i, baseline, comparison_of("render", all[i], all[baseline]));
    }
    for (const PlainContender& contender : all) {
      if (contender.is_command) {
        matches.compare_timed(matches.add([&] { return figures_of_command(contender); }), 1,
                              comparison_of("command", contender, all[1]));
      }
    }
    Progress progress(std::cerr, stderr_is_terminal(), scene_ + " beside a plain renderer:", "renders");
    matches.measure(settings_.rounds_of(part_), progress);
    compare_pictures();
  }

  void compare_builds(const Times& ours) {
    Comparison builds = comparison_of("build", "database", "Embree robust of high quality", "s");
    builds.figures = {{ours.wall_seconds}, {plain_.build_times().wall_seconds}};
    builds.processor = {{ours.processor_seconds}, {plain_.build_times().processor_seconds}};
    results_.push_back(builds);
  }

 private:
  Comparison comparison_of(const char* what, const std::string& subject, const std::string& baseline, const char* unit) const {
    return {.part = part_,
            .scene = scene_,
            .what = std::string(what) + (is_curved_ ? ", curved" : ""),
            .subject = subject,
            .baseline = baseline,
            .unit = unit};
  }
  Comparison comparison_of(const char* what, const PlainContender& contender, const PlainContender& baseline) const {
    Comparison comparison = comparison_of(what, name_of(contender), name_of(baseline), "s");
    comparison.threads = contender.count;
    comparison.is_main =
        what == std::string("render") && (contender.is_command || part_ == SpeedPart::paths) && contender.strategy;
    return comparison;
  }

  /// Called after a round.
  void compare_pictures() {
    core::expect(picture_.has_value() && film_.has_value(), "what is compared has been rendered");
    results_.push_back(
        comparison_of("rays", "ours", "plain", "rays").once(static_cast<double>(rays_), static_cast<double>(picture_->rays)));
    if (part_ == SpeedPart::paths) {
      const PathDistance distance = path_distance(*picture_, *film_, scene_);
      results_.push_back(
          comparison_of("distance", "plain to ours", "noise", "root mean square").once(distance.apart, distance.noise));
    } else {
      results_.push_back(comparison_of("distance", "plain to ours", "1/255", "root mean square")
                             .once(distance_to_ours(*picture_, *film_, scene_), plain_error_max));
    }
  }

  Times render(const PlainContender& contender) {
    interrupt_.check();
    return contender.strategy ? render_ours(contender) : render_plain(contender.count);
  }

  Times render_plain(std::uint32_t threads) {
    picture_.reset();
    DoubleStopwatch stopwatch;
    picture_ = plain_.render(threads);
    return stopwatch.lap();
  }

  Times render_ours(const PlainContender& contender) {
    const Subject& subject = contender.strategy == Strategy::forest ? *forest_ : subject_;
    const TimedRender one = render_timed(strategy_of(contender), subject.database, subject.settings, interrupt_);
    const Account account = account_of(one.report);
    if (contender.tracer == TracerChoice::grid) {  // Embree rounds in its own way: `dmpc check` judges its hits
      core::expect(!film_ || film_->hash() == account.film.hash(), "all computers render one film");
      film_ = account.film;
      rays_ = account.operations.ray_count();
    }
    return one.times;
  }

  /// Returns the time that the command takes beyond the fastest of some that render 8x8 pixels, which start, load and build as it
  /// does. The fastest is used since a load during such a run would count for the picture.
  std::vector<double> figures_of_command(const PlainContender& contender) const {
    constexpr Resolution least_size{8, 8};
    constexpr int least_runs = 3;
    Times least = times_of_command(contender, least_size);
    for (int more = 1; more < least_runs; ++more) {
      const Times times = times_of_command(contender, least_size);
      least = {std::min(least.wall_seconds, times.wall_seconds), std::min(least.processor_seconds, times.processor_seconds)};
    }
    const Times all = times_of_command(contender, *settings_.picture_of(part_, scene_).resolution);
    std::vector<double> figures = {all.wall_seconds - least.wall_seconds, all.processor_seconds - least.processor_seconds};
    std::replace_if(
        figures.begin(), figures.end(), [](double figure) { return figure <= 0; }, no_figure);
    return figures;
  }

  Times times_of_command(const PlainContender& contender, const Resolution& size) const {
    const double before = children_seconds();
    Stopwatch stopwatch;
    const CompletedProcess ended =
        run_process(settings_.program,
                    {"render", scene_, "--quiet", "--samples=1", std::string("--strategy=") + apps::name_of(*contender.strategy),
                     std::string("--runner=") + apps::name_of(contender.runner), "--nodes=" + std::to_string(contender.count),
                     "--resolution=" + std::to_string(size.width) + "x" + std::to_string(size.height), "-o",
                     (folder_ / "picture.exr").string()},
                    interrupt_);
    if (ended.status != 0) {
      throw core::InputError(settings_.program.string() + " was to be timed and ended with status " +
                             std::to_string(ended.status) + (ended.complaint.empty() ? "" : ", saying: " + ended.complaint));
    }
    return {stopwatch.lap(), children_seconds() - before};
  }

  SpeedPart part_;
  std::string scene_;
  const Subject& subject_;
  const Subject* forest_;
  const SpeedSettings& settings_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  bool is_curved_;  ///< the scene has spheres or cones
  PlainRenderer plain_;
  ScratchFolder folder_;
  std::optional<PlainPicture> picture_;
  std::optional<core::Film> film_;
  std::uint64_t rays_ = 0;
};

/// Also reports it.
bool is_left_out(const Subject& subject, const std::string& scene, SpeedPart part) {
  const bool is_textured = subject.database.records().textured > 0;
  if (is_textured) {
    std::cerr << "dmpc: " << scene << " has textures, of which the plain renderer knows nothing: left out of part "
              << apps::name_of(part) << '\n';
  }
  return is_textured;
}

constexpr double light_share = 0.05, roughness = 0.3;

void polish(core::Material& material) {
  const double mirrored = material.specular_max() * material.mirror;
  if (mirrored > 0 && !material.microfacets.are_there()) {
    material.microfacets = {.roughness = roughness, .metallic = mirrored / (mirrored + material.diffuse)};
  }
}

}  // namespace

void light_and_polish(core::Scene& scene) {
  for (core::Material& material : scene.materials) {
    polish(material);
  }
  const core::Box box = core::bounds_of(scene, core::Parallel(1));
  if (!box.empty()) {
    core::make_lights_spheres(scene, light_share * 2 * length(box.half()));
  }
}

void measure_plain(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::plain)) {
    interrupt.check();
    const PictureOptions picture = settings.picture_of(SpeedPart::plain, scene);
    core::Scene loaded = settings.load(picture), again = loaded;
    DoubleStopwatch stopwatch;
    const Subject subject = build_subject(std::move(loaded), picture);
    const Times build_times = stopwatch.lap();
    if (!is_left_out(subject, scene, SpeedPart::plain)) {
      const Subject forest = build_subject_quietly(std::move(again), picture, usual_database(Strategy::forest));
      PlainBench bench(SpeedPart::plain, scene, subject, &forest, settings, interrupt, results);
      bench.compare_builds(build_times);
      bench.measure(plain_contenders);
    }
  }
}

void measure_paths(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::paths)) {
    const PictureOptions picture = settings.picture_of(SpeedPart::paths, scene);
    core::Scene plain = settings.load(picture), lit = plain;
    light_and_polish(lit);
    const auto measure = [&](core::Scene shown, const std::string& name) {
      interrupt.check();
      const Subject subject = build_subject(std::move(shown), picture);
      if (!is_left_out(subject, name, SpeedPart::paths)) {
        PlainBench(SpeedPart::paths, name, subject, nullptr, settings, interrupt, results).measure(path_contenders);
      }
    };
    measure(std::move(plain), scene);
    measure(std::move(lit), scene + " with balls of light and metal");
  }
}

}  // namespace dmpc::apps
