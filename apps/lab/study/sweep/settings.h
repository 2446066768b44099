// What the study `sweep` runs: one scene by all combinations of some options of `render`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/run/render_options.h"

namespace dmpc::apps {

/// The options of `render` that say how it is rendered, not what is written where: all that a sweep can set or vary.
const std::vector<OptionDescription>& sweepable_options();

/// "--page-size" of one of them.
std::string long_name_of(const OptionDescription& option);

/// An option of `render` and its values, one after the other.
struct VariedOption {
  std::string option;               ///< "--page-size"
  bool is_flag = false;             ///< its values are on and off
  std::vector<std::string> values;  ///< as typed, each once
};

/// "page-size:1KiB,4KiB", with or without dashes before; "background:0,0,0;1,1,1" where values have commas. Throws
/// core::UsageError for an option that there is none, or that says where something goes; for no values, or one that is there
/// twice; for values of a flag that are not on or off.
VariedOption parse_variation(const std::string& text);

struct SweepSettings {
  std::string scene;
  std::vector<std::string> fixed;             ///< words of all runs: "--runner=virtual"
  std::vector<VariedOption> variations;       ///< the last one changes fastest
  std::vector<std::string> columns;           ///< names of figures; none: usual ones
  std::optional<std::filesystem::path> kept;  ///< the folder of counters of runs, this one's and earlier ones'
  std::filesystem::path program = "/proc/self/exe";
};

/// One combination.
struct SweepRun {
  std::vector<std::string> values;  ///< of the variations
  std::vector<std::string> words;   ///< of a line of `render` but for its outputs
  RenderOptions options;            ///< what these words mean, settled
};

/// What it takes is wall-clock time, so nothing else should run beside it.
inline bool is_timed_by_the_wall(const RenderOptions& options) { return options.runner.kind != RunnerKind::virtual_time; }

/// All combinations. Throws core::UsageError for one that `render` would not take, saying which, or for more than 10,000.
std::vector<SweepRun> sweep_runs(const SweepSettings& settings);

/// What the scene is read from; nothing of a built-in one. Reads it, as `run` would: throws as load_scene() does.
OpenedFiles scene_files(const SweepSettings& settings, const SweepRun& run);

/// "--nodes=8 --page-size=1KiB".
std::string text_of(const std::vector<VariedOption>& variations, const SweepRun& run);

}  // namespace dmpc::apps
