#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/progress.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/path_distance.h"
#include "apps/lab/bench/speed/path_scene.h"
#include "apps/lab/bench/speed/plain_path_renderer.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// One of ours, and the plain path tracer on as many threads.
struct PathContender {
  const char* name;
  Strategy strategy;
  std::uint32_t count;  ///< of nodes, and of the rival's threads
};
constexpr std::array<PathContender, 2> path_contenders{
    {{"replicated on 1 node", Strategy::replicated, 1}, {"svm on 2 nodes", Strategy::svm, 2}}};

/// Behind the name of a scene that is lit and polished.
constexpr const char* lit_suffix = " with balls of light and metal";

std::string path_rival_name(const PathContender& contender) { return "plain paths on " + counted(contender.count, "thread"); }

/// The renders of one scene.
class PathsBench {
 public:
  PathsBench(const std::string& scene, const Subject& subject, const Interrupt& interrupt, std::vector<Comparison>& results)
      : scene_(scene), interrupt_(interrupt), results_(results), subject_(subject), plain_(subject_) {}

  void measure(std::size_t rounds) {
    Matches matches(results_);
    for (const PathContender& contender : path_contenders) {
      const std::size_t rival = matches.add([&] { return figures_of(render_plain(contender.count)); });
      const std::size_t ours = matches.add([&] { return figures_of(render_ours(contender)); });
      Comparison comparison = comparison_of("render", contender.name, path_rival_name(contender), "s");
      comparison.threads = contender.count;
      comparison.detail = clock_names.back();
      matches.compare(ours, rival, comparison, 1);
    }
    Progress progress(std::cerr, stderr_is_terminal(), scene_ + " beside a plain path tracer:", "renders");
    matches.measure(rounds, progress);
    compare_pictures();
  }

 private:
  Comparison comparison_of(const char* what, const std::string& subject, const std::string& rival, const char* unit) const {
    return {.part = SpeedPart::paths, .scene = scene_, .what = what, .subject = subject, .rival = rival, .unit = unit};
  }

  Times render_plain(std::uint32_t threads) {
    interrupt_.check();
    picture_.reset();
    DoubleStopwatch stopwatch;
    picture_ = plain_.render(threads);
    return stopwatch.lap();
  }

  Times render_ours(const PathContender& contender) {
    const StrategyOptions options{.strategy = contender.strategy, .computer = {.node_count = contender.count}};
    const TimedRender one = render_timed(options, subject_.database, subject_.settings, interrupt_);
    const Account account = account_of(one.report);
    core::expect(!film_ || film_->hash() == account.film.hash(), "all computers render one film");
    film_ = account.film;
    rays_ = account.operations.ray_count();
    return one.times;
  }

  /// After a round.
  void compare_pictures() {
    core::expect(picture_.has_value() && film_.has_value(), "what is compared has been rendered");
    results_.push_back(comparison_of("rays", "ours", "plain paths", "rays")
                           .once(static_cast<double>(rays_), static_cast<double>(picture_->rays)));
    const PathDistance distance = path_distance(*picture_, *film_, scene_);
    results_.push_back(
        comparison_of("distance", "plain paths to ours", "noise", "root mean square").once(distance.apart, distance.noise));
  }

  std::string scene_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  const Subject& subject_;
  PlainPathRenderer plain_;
  std::optional<PlainPicture> picture_;
  std::optional<core::Film> film_;
  std::uint64_t rays_ = 0;
};

}  // namespace

void measure_paths(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::paths)) {
    const PictureOptions picture = settings.picture_of(SpeedPart::paths, scene);
    core::Scene plain = settings.load(picture), lit = plain;
    light_and_polish(lit);
    const auto measure = [&](core::Scene shown, const std::string& name) {
      interrupt.check();
      const Subject subject = build_subject(std::move(shown), picture);
      if (subject.database.records().textured > 0) {
        std::cerr << "dmpc: " << name << " has textures, of which the plain path tracer knows nothing: left out of part paths\n";
      } else {
        PathsBench(name, subject, interrupt, results).measure(settings.rounds_of(SpeedPart::paths));
      }
    };
    measure(std::move(plain), scene);
    measure(std::move(lit), scene + lit_suffix);
  }
}

}  // namespace dmpc::apps
