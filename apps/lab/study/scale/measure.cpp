#include "apps/lab/study/scale/measure.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/watched_process.h"
#include "apps/lab/study/engine/render_process.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Returns the anonymous memory of an idle dmpc; it ends so soon that it is sampled in several runs, and may be missed.
std::optional<std::size_t> idle_bytes(const ScaleSettings& settings, const Interrupt& interrupt) {
  constexpr int times = 5;
  std::optional<std::size_t> most;
  for (int i = 0; i < times; ++i) {
    const WatchedProcess idle = watch_process(settings.program, {"--version"}, interrupt);
    if (idle.status != 0) {
      throw core::InputError(settings.program.string() + " --version ended with status " + std::to_string(idle.status) + ": " +
                             sentence_of(idle.complaint));
    }
    most = std::max(most, idle.peak_anonymous_bytes);
  }
  return most;
}

std::string label_of(const ScaleRun& run, const ScaleSettings& settings) {
  return run.scene.text() + ", " + settings.name_of(run.method) + ", " + counted(run.node_count, "node") + ":";
}

}  // namespace

std::vector<std::string> render_arguments(const ScaleRun& run, const ScaleSettings& settings) {
  const std::string size = std::to_string(settings.resolution.width) + "x" + std::to_string(settings.resolution.height);
  std::vector<std::string> words = {"render", run.scene.text(), "--nodes=" + std::to_string(run.node_count),
                                    "--resolution=" + size};
  if (run.method == ScaleMethod::dataflow) {
    words.emplace_back("--strategy=dataflow");
    return words;
  }
  words.emplace_back("--count-pages");
  if (run.method == ScaleMethod::cache) {
    words.push_back("--cache-pages=" + std::to_string(settings.cache_bytes / ScaleSettings::page_bytes));
  }
  return words;
}

void measure_scale(const std::vector<ScaleRun>& runs, const ScaleSettings& settings, const Interrupt& interrupt,
                   const std::function<void(ScaleResult)>& take) {
  const std::optional<std::size_t> idle = idle_bytes(settings, interrupt);  // used by the libraries before any work
  const RenderProcesses renders(settings.program, interrupt);
  std::map<std::string, std::string> films;  // by scene
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Progress progress(std::cerr, stderr_is_terminal(), label_of(runs[i], settings), "runs");
    progress.update(i, runs.size());
    ScaleResult result{.run = runs[i], .figures = {}, .misfit = {}};
    std::vector<ScaleFigures> rounds;
    while (rounds.size() < settings.rounds && result.misfit.empty()) {
      interrupt.check();
      const RenderEnd end = renders.run(render_arguments(runs[i], settings), "render");
      result.misfit = end.misfit;
      if (end.figures) {
        const auto& bytes = end.peak_anonymous_bytes;
        rounds.push_back(
            scale_figures_of(*end.figures, bytes && idle ? std::optional(*bytes - std::min(*bytes, *idle)) : std::nullopt));
      }
    }
    if (result.misfit.empty()) {
      result.figures = median_figures(rounds);
      const auto film = films.emplace(runs[i].scene.text(), result.figures->film_hash).first;
      core::expect(film->second == result.figures->film_hash, "every run of a scene gives the same film");
    }
    take(std::move(result));
  }
}

}  // namespace dmpc::apps
