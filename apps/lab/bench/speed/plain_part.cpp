#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/busy_processes.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/packet_renderer.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/plain_commands.h"
#include "apps/lab/bench/speed/plain_contender.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/bench/speed/pov_rival.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/picture/film_image.h"
#include "apps/picture/image_file.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t rival_threads = 2;
constexpr const char *rival_name = "plain on 2 threads", *pov_name = "POV-Ray on 2 threads";
/// Who renders beside so many busy processes, which the plain renderer does, too.
constexpr const char* busy_name = "svm on 64 nodes, pool";
constexpr std::size_t busy_count = 8;
/// Whose command has a share that is the writing of its file, and whose ranks are held against its one process.
constexpr const char *writing_name = "svm on 2 nodes", *ranked_name = "dataflow on 2 nodes";

/// A scene with its times of building.
struct TimedSubject {
  Subject subject;
  Times build_times;

  TimedSubject(core::Scene scene, const PictureOptions& picture, DoubleStopwatch stopwatch = {})
      : subject(build_subject(std::move(scene), picture)), build_times(stopwatch.lap()) {}
};

std::string beside_others(const char* name) { return std::string(name) + ", beside " + std::to_string(busy_count) + " busy"; }

/// The renders of one scene.
class PlainBench {
 public:
  PlainBench(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt,
             std::vector<Comparison>& results)
      : scene_(scene),
        interrupt_(interrupt),
        results_(results),
        is_quick_(settings.is_quick),
        picture_options_(settings.picture_of(SpeedPart::plain, scene)),
        timed_(settings.load(picture_options_), picture_options_),
        forest_(build_subject_quietly(settings.load(picture_options_), picture_options_, usual_database(Strategy::forest))),
        commands_(settings.program, scene_, *picture_options_.resolution, interrupt) {}

  bool is_textured() const { return timed_.subject.database.records().textured > 0; }

  void measure(std::size_t rounds) {
    plain_.emplace(timed_.subject);
    packets_.emplace(timed_.subject, EmbreeMode::robust);
    fast_packets_.emplace(timed_.subject, EmbreeMode::fast);
    Matches matches(results_);
    add_renders(matches);
    add_pov(matches);
    add_commands(matches);
    add_busy(matches);
    compare_builds();
    Progress progress(std::cerr, stderr_is_terminal(), scene_ + " beside a plain renderer:", "renders");
    matches.measure(rounds, progress);
    compare_pictures();
  }

 private:
  Comparison comparison_of(const char* what, const std::string& subject, const std::string& rival, std::uint32_t count = 0,
                           const char* unit = "s") const {
    return {.part = SpeedPart::plain,
            .scene = scene_,
            .what = what,
            .threads = count,
            .subject = subject,
            .rival = rival,
            .unit = unit};
  }

  void add_renders(Matches& matches) {
    std::map<std::string, std::size_t> numbers;
    for (const PlainContender& contender : plain_contenders()) {
      const std::size_t number = numbers[contender.name] = matches.add([&] { return figures_of(render(contender)); });
      matches.compare_timed(number, 0, comparison_of("render", contender.name, rival_name, contender.count));
    }
    for (const PlainPair& pair : plain_pairs()) {
      matches.compare_timed(numbers.at(pair.subject), numbers.at(pair.rival), comparison_of("pair", pair.subject, pair.rival));
    }
  }

  void add_pov(Matches& matches) {
    if (!is_quick_ && PovRival::is_installed()) {
      pov_.emplace(timed_.subject);
      const std::size_t number = matches.add([this] { return figures_of(pov_->render(rival_threads, interrupt_)); });
      matches.compare_timed(number, 0, comparison_of("render", pov_name, rival_name, rival_threads));
    }
  }

  /// Behind the renders, of which one leaves the film that is written.
  void add_commands(Matches& matches) {
    for (const PlainContender& contender : command_contenders()) {
      const std::size_t number = matches.add([&] { return commands_.figures_of_command(contender); });
      matches.compare_timed(number, 0, comparison_of("command", contender.name, rival_name, contender.count));
      if (contender.name == std::string(writing_name)) {
        const std::size_t writing = matches.add([this] { return figures_of_writing(); });
        Comparison share = comparison_of("writing", "picture file", std::string(writing_name) + ", whole command");
        share.detail = clock_names.back();
        matches.compare(writing, number, share, 3);
      }
    }
    if (!is_quick_) {
      add_ranks(matches);
    }
  }

  void add_ranks(Matches& matches) {
    if (const std::string reason = commands_.why_no_ranks(); !reason.empty()) {
      std::cerr << "dmpc: " << scene_ << ": dataflow over ranks is left out of part plain: " << reason << '\n';
      return;
    }
    const PlainContender& ranked = contender_named(ranked_name);
    const auto add = [&](bool is_over_ranks) {
      return matches.add([&, is_over_ranks] { return std::vector{commands_.render_seconds(ranked, is_over_ranks)}; });
    };
    const std::size_t process = add(false), ranks = add(true);
    Comparison comparison = comparison_of("ranks", std::string(ranked_name) + ", 2 ranks", ranked_name);
    comparison.detail = clock_names.front();
    matches.compare(ranks, process, comparison);
  }

  /// As the figures of a command have what all of it takes.
  std::vector<double> figures_of_writing() {
    interrupt_.check();
    DoubleStopwatch stopwatch;
    write_image(commands_.picture(), rows_of(*film_));
    std::vector<double> figures = figures_of(stopwatch.lap());
    figures.insert(figures.end(), figures.begin(), figures.end());
    return figures;
  }

  void add_busy(Matches& matches) {
    const PlainContender &ours = contender_named(busy_name), &plain = contender_named(rival_name);
    const auto add = [&](const std::function<std::vector<double>()>& measure) {
      return matches.add([measure] {
        const BusyProcesses busy(busy_count);
        return measure();
      });
    };
    const std::size_t rival = add([&] { return figures_of(render(plain)); });
    const std::string rival_beside = beside_others(rival_name), beside = beside_others(busy_name);
    matches.compare_timed(rival, rival, comparison_of("render", rival_beside, rival_beside, plain.count));
    matches.compare_timed(add([&] { return figures_of(render(ours)); }), rival,
                          comparison_of("render", beside, rival_beside, ours.count));
    matches.compare_timed(add([&] { return commands_.figures_of_command(ours); }), rival,
                          comparison_of("command", beside, rival_beside, ours.count));
  }

  void compare_builds() {
    Comparison builds = comparison_of("build", "database", "Embree robust of high quality", 0);
    const std::vector<double> ours = figures_of(timed_.build_times), theirs = figures_of(plain_->build_times());
    for (std::size_t clock = 0; clock < clock_names.size(); ++clock) {
      builds.detail = clock_names[clock];
      results_.push_back(builds.once(ours[clock], theirs[clock]));
    }
  }

  /// After a round.
  void compare_pictures() {
    core::expect(picture_.has_value() && packet_picture_.has_value() && film_.has_value(), "what is compared has been rendered");
    add("rays", "ours", "plain", "rays", static_cast<double>(rays_), static_cast<double>(picture_->rays));
    add("distance", "plain to ours", "1/255", "root mean square", distance_to_ours(*picture_, *film_, scene_), plain_error_max);
    add("packets' distance", "packets to ours", "1/255", "root mean square", distance_to_ours(*packet_picture_, *film_, scene_),
        plain_error_max);
    if (pov_) {
      add("POV-Ray's distance", "POV-Ray to ours", "1/255", "root mean square",
          pov_distance_to_ours(pov_->picture(), *film_, scene_), plain_error_max);
    }
  }

  void add(const char* what, const char* subject, const char* rival, const char* unit, double ours, double theirs) {
    results_.push_back(comparison_of(what, subject, rival, 0, unit).once(ours, theirs));
  }

  Times render(const PlainContender& contender) {
    interrupt_.check();
    return contender.strategy                    ? render_ours(contender)
           : contender.kind == PlainKind::single ? render_plain(contender.count)
                                                 : render_packets(contender);
  }

  Times render_plain(std::uint32_t threads) {
    picture_.reset();
    DoubleStopwatch stopwatch;
    picture_ = plain_->render(threads);
    return stopwatch.lap();
  }

  Times render_packets(const PlainContender& contender) {
    packet_picture_.reset();
    const PacketRenderer& renderer = contender.kind == PlainKind::packets ? *packets_ : *fast_packets_;
    DoubleStopwatch stopwatch;
    packet_picture_ = renderer.render(contender.count);
    return stopwatch.lap();
  }

  Times render_ours(const PlainContender& contender) {
    const Subject& subject = contender.strategy == Strategy::forest ? forest_ : timed_.subject;
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
  bool is_quick_;  ///< then POV-Ray, which reads for long, and ranks, which start for long, are left out
  PictureOptions picture_options_;
  TimedSubject timed_;
  Subject forest_;
  PlainCommands commands_;
  std::optional<PlainRenderer> plain_;
  std::optional<PovRival> pov_;
  std::optional<PacketRenderer> packets_, fast_packets_;
  std::optional<PlainPicture> picture_, packet_picture_;
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
