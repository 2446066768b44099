#include <array>
#include <iostream>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/matches.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/oracle/oracle.h"
#include "apps/picture/film_image.h"
#include "apps/picture/image_file.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t picture_node_count = 2;
constexpr std::array<const char*, 6> phase_names = {"load", "build", "prepare", "render", "write", "whole picture"};

StrategyOptions strategy_of(bool is_rival) {
  return {.strategy = is_rival ? Strategy::replicated : Strategy::svm,
          .computer = {.node_count = picture_node_count},
          .tracer = is_rival ? TracerChoice::embree : TracerChoice::grid};
}

void add_figures(const Times& times, std::vector<double>& figures) {
  for (const double figure : figures_of(times)) {
    figures.push_back(figure);
  }
}

/// Both times of each phase, and in the end of all.
std::vector<double> render_whole(const std::string& scene_name, const SpeedSettings& settings, const StrategyOptions& strategy,
                                 const std::filesystem::path& path, const Interrupt& interrupt) {
  const PictureOptions picture = settings.picture_of(SpeedPart::picture, scene_name);
  std::vector<double> figures;
  Times whole;
  DoubleStopwatch stopwatch;
  const auto end_phase = [&] {
    const Times times = stopwatch.lap();
    whole.wall_seconds += times.wall_seconds;
    whole.processor_seconds += times.processor_seconds;
    add_figures(times, figures);
  };
  core::Scene scene = settings.load(picture);
  end_phase();
  const Subject subject = build_subject(std::move(scene), picture);
  end_phase();
  const ReadyRun run = make_ready(strategy, subject.database, subject.settings, interrupt.token());
  end_phase();
  const Report report = run.start([](std::uint32_t, std::uint32_t) {}, interrupt.token());
  interrupt.check();
  end_phase();
  write_image(path, rows_of(account_of(report).film));
  end_phase();
  add_figures(whole, figures);
  return figures;
}

}  // namespace

void measure_picture(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const ScratchFolder folder;
  Matches matches(results);
  for (const std::string& scene : settings.scenes_of(SpeedPart::picture)) {
    const auto add = [&](bool is_rival) {
      return matches.add([&, scene, is_rival] {
        interrupt.check();
        return render_whole(scene, settings, strategy_of(is_rival), folder / "picture.png", interrupt);
      });
    };
    const std::size_t subject = add(false), rival = add(true);
    for (std::size_t phase = 0; phase < phase_names.size(); ++phase) {
      matches.compare_timed(subject, rival,
                            {.part = SpeedPart::picture,
                             .scene = scene,
                             .what = phase_names[phase],
                             .threads = picture_node_count,
                             .subject = "svm",
                             .rival = "replicated with Embree",
                             .unit = "s"},
                            2 * phase);
    }
  }
  open_embree();  // which is no part of a render
  Progress progress(std::cerr, stderr_is_terminal(), "pictures:", "renders");
  matches.measure(settings.rounds_of(SpeedPart::picture), progress);
}

}  // namespace dmpc::apps
