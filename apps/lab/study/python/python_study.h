// Studies that are programs in Python (apps/python/dmpc): their options are declared and checked here, and passed on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/table/table_options.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

/// A study as a command. It declares what it needs of the options below, by which dmpc checks them.
struct PythonStudy {
  std::string name;
  const char* module;  ///< its main(words): "systems.command" of the package dmpc
  void (*declare)(OptionSet set, PythonStudy& study);
  PictureOptions picture = {};
  std::optional<TableOutput> table = {};
  std::optional<DatabaseOptions> database = {};
  StrategyOptions run = {};
  std::string machine_name = "ipsc2";
  std::vector<std::uint32_t> node_counts = {};
  std::uint32_t number = 0;  ///< of draws, or of frames
  std::uint32_t side = 512;  ///< of square pictures, in pixels
  std::optional<std::filesystem::path> report = {};
  bool is_set = false;                  ///< of any flag that is passed on
  bool quiet = false;                   ///< no progress
  std::vector<std::string> words = {};  ///< defaults; once a line is read, with what it gives in their place
};

/// The study of this name.
PythonStudy python_study(const std::string& name);

void add_options(OptionSet set, PythonStudy& study);

/// For options whose values the program in Python checks.
inline void passed_on(const std::string&) {}
/// Declares --nodes: several numbers, whose defaults are in `counts`.
void add_node_counts(OptionSet set, std::vector<std::uint32_t>& counts);
/// Those of a study of one scene: its picture, its database if the study has one, its table and plots.
void add_scene_options(OptionSet set, PythonStudy& study);
/// Those of a study that keeps its runs: how many go side by side, and whether progress is shown.
void add_run_options(OptionSet set, PythonStudy& study);

/// Checks the outputs of a study with a table as TableFiles does, and becomes Python: does not return. Throws as both do.
int python_study_command(const PythonStudy& study, std::ostream& output);

}  // namespace dmpc::apps
