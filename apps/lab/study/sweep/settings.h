// Settings of the study `sweep`: one scene with all combinations of some options of `render`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/run/render_options.h"

namespace dmpc::apps {

/// The options of `render` that determine how it renders, not where outputs go: those that a sweep can set or vary.
const std::vector<OptionDescription>& sweepable_options();

/// Returns an option's "--page-size".
std::string long_name_of(const OptionDescription& option);

/// An option of `render` and the values that it takes in turn.
struct VariedOption {
  std::string option;               ///< "--page-size"
  bool is_flag = false;             ///< its values are on and off
  std::vector<std::string> values;  ///< as typed, without repetition
};

/// Parses "page-size:1KiB,4KiB", with or without dashes before; "background:0,0,0;1,1,1" where values have commas. Throws
/// core::UsageError for an unknown option or one that names an output, for no values or repeated ones, and for values of a flag
/// other than on and off.
VariedOption parse_variation(const std::string& text);

struct SweepSettings {
  std::string scene;
  std::vector<std::string> fixed;             ///< words of all runs: "--runner=virtual"
  std::vector<VariedOption> variations;       ///< the last one changes fastest
  std::vector<std::string> columns;           ///< names of figures; empty: the usual ones
  std::optional<std::filesystem::path> kept;  ///< the folder for counters of runs, including those of earlier sweeps
  std::size_t kept_database_bytes_min = std::size_t{16} << 20U;  ///< a smaller one is built in the time that it takes to read it
  std::filesystem::path program = "/proc/self/exe";
};

struct SweepRun {
  std::vector<std::string> values;  ///< of the variations
  std::vector<std::string> words;   ///< a line of `render` without its outputs
  RenderOptions options;            ///< the parsed words, with defaults
};

/// Its cost is wall clock time, so nothing else should run beside it.
inline bool is_timed_by_the_wall(const RenderOptions& options) { return options.runner.kind != RunnerKind::virtual_time; }

/// Returns all combinations. Throws core::UsageError, which names the combination, for one that `render` would not take, or for
/// more than 10,000.
std::vector<SweepRun> sweep_runs(const SweepSettings& settings);

/// Returns the files from which the scene is read; none for a built-in scene. Reads the scene as `run` would: throws as
/// load_scene() does.
OpenedFiles scene_files(const SweepSettings& settings, const SweepRun& run);

/// Returns "--nodes=8 --page-size=1KiB".
std::string text_of(const std::vector<VariedOption>& variations, const SweepRun& run);

}  // namespace dmpc::apps
