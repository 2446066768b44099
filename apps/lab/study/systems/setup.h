// A system on a structure, with the options of one run.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/lab/study/studies.h"
#include "apps/lab/study/systems/search.h"
#include "apps/run/systems.h"
#include "core/database/structure.h"

namespace dmpc::apps {

/// A database of the study's scene.
struct StructureAsked {
  core::Structure structure = core::Structure::grid;
  bool is_original = false;  ///< of voxels: by the article's rule
  std::size_t page_size_bytes = 1024;

  auto operator<=>(const StructureAsked&) const = default;
};

struct SystemSetup {
  System system = System::svm;
  StructureAsked asked;
  StrategyOptions options;

  /// Returns "svm on extents".
  std::string name() const;
};

/// The system as it had it when it was described: its structure, one pixel in flight, cuts in alternating directions, no
/// backpressure, and caches that hold the whole database, which is `page_count` pages in its structure.
SystemSetup described_setup(System system);
void give_whole_cache(SystemSetup& setup, std::size_t page_count);

/// The systems, each on every structure that it can walk, with its default options. Systems that differ in their structure alone
/// are one.
std::vector<SystemSetup> setups_on_all_structures(const std::vector<System>& systems);

/// The options that the search tries for the system: those that it has and that do not define it.
std::vector<SearchedOption> searched_options(const SystemSetup& setup);
/// The same system with a setting of these options.
SystemSetup with_setting(SystemSetup setup, const std::vector<SearchedOption>& options, const Search::Setting& setting);
/// All that searched_options() may have, with their values: for a note, and to name the search.
std::string search_text();

/// Returns the options of the setup by name, all that a verdict has to compare.
std::map<std::string, std::string> option_texts(const SystemSetup& setup);

/// What the system finds out before its run, which no virtual time is charged for; empty for most.
std::string free_beforehand(const StrategyOptions& options);

/// The machine, or the preset of the same computer whose prices are for this structure: ipsc2 and ipsc2-1994 are one.
const MachineDescription& priced_for(core::Structure structure, const MachineDescription& machine);

}  // namespace dmpc::apps
