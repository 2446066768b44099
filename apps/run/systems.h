// Named systems that were built or described: each is a strategy with the options that reproduce it.
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
  const char* name;      ///< name on the command line
  const char* meaning;   ///< who described it, and how it works
  core::Structure had;   ///< the structure of the original description, or the nearest one available
  const char* had_what;  ///< the original structure, in a few words
};
std::span<const SystemDescription> systems();
/// The name on the command line.
const char* name_of(System system);
/// Returns the options that the system stands for: "--strategy=svm --structure=extents".
std::string options_of(System system);

void add_system_option(OptionSet options, std::optional<System>& system);
/// For OptionSet::check_in_the_end(), before settle_database() and check_together(): sets the system's options in `run` and
/// `database`. Throws core::UsageError for an option that contradicts the system.
void settle_system(const OptionSet& options, System system, StrategyOptions& run, DatabaseOptions& database);

}  // namespace dmpc::apps
