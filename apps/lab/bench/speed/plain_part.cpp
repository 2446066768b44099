#include <array>
#include <iostream>
#include <optional>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t rival_threads = 2;
constexpr const char* rival_name = "plain on 2 threads";

/// One of those that render.
struct Contender {
  const char* name;
  std::uint32_t count;                              ///< of threads, or of nodes
  std::optional<Strategy> strategy = std::nullopt;  ///< nothing: it is the plain renderer
  RunnerKind runner = RunnerKind::threads;
};
/// The first is the rival of all.
constexpr std::array<Contender, 10> contenders = {{{rival_name, rival_threads},
                                                   {"plain on 1 thread", 1},
                                                   {"svm on 1 node", 1, Strategy::svm},
                                                   {"svm on 2 nodes", 2, Strategy::svm},
                                                   {"svm on 8 nodes", 8, Strategy::svm},
                                                   {"svm on 64 nodes", 64, Strategy::svm},
                                                   {"dataflow on 2 nodes", 2, Strategy::dataflow},
                                                   {"dataflow on 64 nodes", 64, Strategy::dataflow},
                                                   {"replicated on 2 nodes", 2, Strategy::replicated},
                                                   {"svm on 64 nodes, virtual", 64, Strategy::svm, RunnerKind::virtual_time}}};

StrategyOptions strategy_of(const Contender& contender) {
  StrategyOptions options{.strategy = *contender.strategy, .computer = {.node_count = contender.count}};
  options.runner.kind = contender.runner;
  if (contender.runner == RunnerKind::virtual_time) {
    choose_machine(options);
  }
  return options;
}

/// A scene with its times of building.
struct TimedSubject {
  Subject subject;
  Times build_times;

  TimedSubject(core::Scene scene, const PictureOptions& picture, DoubleStopwatch stopwatch = {})
      : subject(build_subject(std::move(scene), picture)), build_times(stopwatch.lap()) {}
};

/// The renders of one scene.
class PlainBench {
 public:
  PlainBench(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt,
             std::vector<Comparison>& results)
      : scene_(scene),
        interrupt_(interrupt),
        results_(results),
        timed_(loaded(scene, settings), settings.picture_of(SpeedPart::plain, scene)) {}

  bool is_textured() const { return timed_.subject.database.records().textured > 0; }

  void measure(std::size_t rounds) {
    plain_.emplace(timed_.subject);
    Matches matches(results_);
    for (const Contender& contender : contenders) {
      const std::size_t number =
          matches.add([&] { return figures_of(contender.strategy ? render_ours(contender) : render_plain(contender.count)); });
      matches.compare_timed(number, 0, comparison_of("render", contender.name, rival_name, contender.count));
    }
    compare_builds();
    Progress progress(std::cerr, stderr_is_terminal(), scene_ + " beside a plain renderer:", "renders");
    matches.measure(rounds, progress);
    compare_pictures();
  }

 private:
  static core::Scene loaded(const std::string& scene, const SpeedSettings& settings) {
    return settings.load(settings.picture_of(SpeedPart::plain, scene));
  }

  Comparison comparison_of(const char* what, const char* subject, const char* rival, std::uint32_t count) const {
    return {.part = SpeedPart::plain,
            .scene = scene_,
            .what = what,
            .threads = count,
            .subject = subject,
            .rival = rival,
            .unit = "s"};
  }

  void compare_builds() {
    Comparison builds = comparison_of("build", "database", "Embree robust of high quality", 0);
    const std::vector<double> ours = figures_of(timed_.build_times), theirs = figures_of(plain_->build_times());
    for (std::size_t clock = 0; clock < clock_names.size(); ++clock) {
      builds.detail = clock_names[clock];
      builds.subject_figures = {ours[clock]};
      builds.rival_figures = {theirs[clock]};
      results_.push_back(builds);
    }
  }

  /// After a round.
  void compare_pictures() {
    core::expect(picture_.has_value() && film_.has_value(), "what is compared has been rendered");
    add("rays", "ours", "plain", "rays", static_cast<double>(rays_), static_cast<double>(picture_->rays));
    add("distance", "plain to ours", "1/255", "root mean square", distance_to_ours(*picture_, *film_, scene_), plain_error_max);
  }

  void add(const char* what, const char* subject, const char* rival, const char* unit, double ours, double theirs) {
    Comparison& once = results_.emplace_back(comparison_of(what, subject, rival, 0));
    once.unit = unit;
    once.subject_figures = {ours};
    once.rival_figures = {theirs};
  }

  Times render_plain(std::uint32_t threads) {
    interrupt_.check();
    picture_.reset();
    DoubleStopwatch stopwatch;
    picture_ = plain_->render(threads);
    return stopwatch.lap();
  }

  Times render_ours(const Contender& contender) {
    const Subject& subject = timed_.subject;
    const TimedRender one = render_timed(strategy_of(contender), subject.database, subject.settings, interrupt_);
    const Account account = account_of(one.report);
    core::expect(!film_ || film_->hash() == account.film.hash(), "all computers render one film");
    film_ = account.film;
    rays_ = account.operations.ray_count();
    return one.times;
  }

  std::string scene_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  TimedSubject timed_;
  std::optional<PlainRenderer> plain_;
  std::optional<PlainPicture> picture_;
  std::optional<core::Film> film_;
  std::uint64_t rays_ = 0;
};

}  // namespace

void measure_plain(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::plain)) {
    interrupt.check();
    PlainBench bench(scene, settings, interrupt, results);
    if (bench.is_textured()) {
      std::cerr << "dmpc: " << scene << " has textures, of which the plain renderer knows nothing: left out of part plain\n";
    } else {
      bench.measure(settings.rounds_of(SpeedPart::plain));
    }
  }
}

}  // namespace dmpc::apps
