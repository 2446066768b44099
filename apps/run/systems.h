// Systems that were built or described, by name: each a strategy and the options that make it what it was.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/database_options.h"

namespace dmpc::apps {

enum class System : std::uint8_t {
  replicated,
  replicated_extents,
  svm,
  svm_extents,
  svm_resident,
  pixel_machine,
  green_paddon,
  forest,
  forest_static,
  equal_size,
  scattered,
  subsampled,
  moving
};

struct SystemDescription {
  System system;
  const char* name;      ///< as the command line calls it
  const char* meaning;   ///< who described it, and how it works
  core::Structure had;   ///< the structure that it had when it was described, or the nearest to that
  const char* had_what;  ///< what that was, in a few words
};
/// All of them.
std::span<const SystemDescription> systems();
/// As the command line calls it.
const char* name_of(System system);
/// The options that it stands for: "--strategy=svm --structure=extents".
std::string options_of(System system);

/// The system of that name. Throws core::UsageError, which lists the names, if there is none.
System find_system(const std::string& name);
/// "replicated, replicated-extents, ... and subsampled".
std::string system_names();
/// What stands for a system: its strategy, and the database that it asks for.
StrategyOptions strategy_of(System system);
DatabaseOptions database_of(System system);
/// As above, on the system's original structure; voxels by core::article_voxels.
DatabaseOptions original_database_of(System system);

/// Declares --system.
void add_system_option(OptionSet options, std::optional<System>& system);
/// For OptionSet::check_in_the_end(), before settle_database() and check_together(): puts what the system is made of into `run`
/// and `database`. Throws core::UsageError where an option is given that says otherwise.
void settle_system(const OptionSet& options, System system, StrategyOptions& run, DatabaseOptions& database);

}  // namespace dmpc::apps
