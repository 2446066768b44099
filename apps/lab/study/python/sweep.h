// The command `study sweep`: one scene with all combinations of any options of `render`, and the requested figures. Its options
// and each combination are checked here; the rest is a program in Python (apps/python/dmpc/sweeps).
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/table/table_options.h"
#include "apps/run/render_options.h"

namespace dmpc::apps {

/// An option of `render` and the values that it takes in turn.
struct VariedOption {
  std::string option;               ///< "--page-size"
  bool is_flag = false;             ///< its values are on and off
  std::vector<std::string> values;  ///< as typed, without repetition
};

struct SweepStudy {
  std::string scene;
  std::vector<VariedOption> variations;  ///< the last one changes fastest
  std::vector<std::string> fixed;        ///< words of all runs: "--runner=virtual"
  std::vector<std::string> words;        ///< the others that are given
  std::optional<std::filesystem::path> kept;
  TableOutput table;
  bool is_set = false;  ///< of any flag of `render`
  bool quiet = false;   ///< no progress
};

struct SweepRun {
  std::string varied;              ///< "--nodes=8 --page-size=1KiB"
  std::vector<std::string> words;  ///< a line of `render` without its outputs
  RenderOptions options;           ///< the parsed words, with defaults
};

/// Returns the options of `render` that determine how it renders, not where outputs go: those that a sweep can set or vary.
const std::vector<OptionDescription>& sweepable_options();

/// Parses "page-size:1KiB,4KiB", with or without dashes before; "background:0,0,0;1,1,1" where values have commas. Throws
/// core::UsageError for an unknown option or one that names an output, for no values or repeated ones, and for values of a flag
/// other than on and off.
VariedOption parse_variation(const std::string& text);

/// Returns all combinations. Throws core::UsageError, which names the combination, for one that `render` would not take, or for
/// more than 10,000.
std::vector<SweepRun> sweep_runs(const SweepStudy& study);

/// What a run's database is called as a file, with digests of all that decides it, and the words by which `build` makes it.
struct SweepDatabase {
  std::string name;
  std::vector<std::string> words;
};
/// `source` is the digest of the scene's files. Its name is "-" for a scene that is stored, or moves.
SweepDatabase database_of(const SweepRun& run, std::uint64_t source);

/// Declares its own options and all options of `render` that determine how it renders.
void add_options(OptionSet set, SweepStudy& study);

/// Checks all combinations and outputs, and becomes Python: does not return. Throws core::UsageError for a combination that
/// `render` would not take, or an output that is an input, core::InputError for a scene that cannot be read.
int study_sweep_command(const SweepStudy& study, std::ostream& output);

}  // namespace dmpc::apps
