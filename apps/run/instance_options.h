// What --instances says: how often a mesh is there that stands in several places.
#pragma once

#include <optional>

#include "apps/formats/mesh_options.h"
#include "apps/frontend/line/command_line.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/scene/database_options.h"

namespace dmpc::apps {

/// Declares --instances.
void add_instance_option(OptionSet options, DatabaseOptions& database);

/// Who looks for what rays meet.
struct RayTracers {
  std::optional<System> system;
  TracerChoice tracer = TracerChoice::grid;
  std::uint32_t tested_objects = 0;
};

/// For OptionSet::check_in_the_end(), after settle_database(): has readers leave copies out, and the database be one tree, where
/// meshes are to be kept; says what keeps `automatic` from keeping any. Throws core::UsageError where --instances=keep does not
/// go with another option.
void settle_instances(const OptionSet& options, const RayTracers& tracers, DatabaseOptions& database, MeshOptions& mesh);

}  // namespace dmpc::apps
