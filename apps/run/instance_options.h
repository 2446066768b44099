// The option --instances: how meshes with several instances are stored.
#pragma once

#include <optional>

#include "apps/formats/mesh_options.h"
#include "apps/frontend/line/command_line.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/scene/database_options.h"

namespace dmpc::apps {

void add_instance_option(OptionSet options, DatabaseOptions& database);

/// The components that intersect rays.
struct RayTracers {
  std::optional<System> system;
  TracerChoice tracer = TracerChoice::grid;
  std::uint32_t tested_objects = 0;
};

/// For OptionSet::check_in_the_end(), after settle_database(). If base meshes are to be kept, makes readers omit copies and the
/// database one tree; reports why `automatic` keeps none. Throws core::UsageError if --instances=keep contradicts another option.
void settle_instances(const OptionSet& options, const RayTracers& tracers, DatabaseOptions& database, MeshOptions& mesh);

}  // namespace dmpc::apps
