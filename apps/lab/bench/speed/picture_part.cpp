#include <array>
#include <iostream>
#include <string>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/edge/table/rounds.h"
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
using Phases = std::array<Times, phase_names.size()>;

StrategyOptions strategy_of(bool is_rival) {
  return {.strategy = is_rival ? Strategy::replicated : Strategy::svm,
          .computer = {.node_count = picture_node_count},
          .tracer = is_rival ? TracerChoice::embree : TracerChoice::grid};
}

/// Times of each phase, and in the end of all.
Phases render_whole(const std::string& scene_name, const SpeedSettings& settings, const StrategyOptions& strategy,
                    const std::filesystem::path& path, const Interrupt& interrupt) {
  const PictureOptions picture = settings.picture_of(SpeedPart::picture, scene_name);
  Phases phases{};
  DoubleStopwatch stopwatch;
  core::Scene scene = settings.load(picture);
  phases[0] = stopwatch.lap();
  const Subject subject = build_subject(std::move(scene), picture);
  phases[1] = stopwatch.lap();
  const ReadyRun run = make_ready(strategy, subject.database, subject.settings, interrupt.token());
  phases[2] = stopwatch.lap();
  const Report report = run.start([](std::uint32_t, std::uint32_t) {}, interrupt.token());
  interrupt.check();
  phases[3] = stopwatch.lap();
  write_image(path, image_of(account_of(report).film));
  phases[4] = stopwatch.lap();
  for (std::size_t phase = 0; phase < 5; ++phase) {
    phases[5].wall_seconds += phases[phase].wall_seconds;
    phases[5].processor_seconds += phases[phase].processor_seconds;
  }
  return phases;
}

void add_comparisons(const std::string& scene, std::vector<Comparison>& results) {
  for (const char* phase : phase_names) {
    add_timed({.part = SpeedPart::picture,
               .scene = scene,
               .what = phase,
               .threads = picture_node_count,
               .subject = "svm",
               .rival = "replicated with Embree",
               .unit = "s"},
              results);
  }
}

}  // namespace

void measure_picture(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const ScratchFolder folder;
  const std::vector<std::string> scenes = settings.scenes_of(SpeedPart::picture);
  const std::size_t first = results.size(), count = 2 * scenes.size(), rounds = settings.rounds_of(SpeedPart::picture);
  for (const std::string& scene : scenes) {
    add_comparisons(scene, results);
  }
  open_embree();  // which is no part of a render
  Progress progress(std::cerr, stderr_is_terminal(), "pictures:", "renders");
  round_by_round(rounds, count, progress, [&](std::size_t index) {
    interrupt.check();
    const bool is_rival = index % 2 == 1;
    const Phases phases = render_whole(scenes[index / 2], settings, strategy_of(is_rival), folder / "picture.png", interrupt);
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
      note(phases[phase], is_rival, &results[first + 2 * (index / 2 * phases.size() + phase)]);
    }
  });
}

}  // namespace dmpc::apps
