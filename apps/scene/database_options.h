// Options for a scene's database: page size, order of records, structure. Shared by `render` and the studies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/run/option_row.h"
#include "core/database/database.h"

namespace dmpc::apps {

/// The name on the command line.
const char* name_of(core::RecordOrder order);

const char* name_of(core::Structure structure);
/// The name on the command line, which has only two rules.
std::string text_of(const core::VoxelRule& rule);

/// A mesh with several instances is copied for each or stored once. automatic: once, if that leaves less than half of the scene
/// to store (core/scene/base_meshes.h); this is decided when the scene is known.
enum class InstancesChoice : std::uint8_t { expand, keep, automatic };

struct DatabaseOptions {
  core::BuildOptions build;
  InstancesChoice instances = InstancesChoice::expand;
  std::string why_copied;  ///< the option that prevents `automatic` from keeping any mesh; empty: no such option

  /// Stores meshes once, which requires one tree.
  void store_instances() {
    build.keeps_instances = true;
    build.structure = core::Structure::extents;
  }
};

using DatabaseRow = OptionRow<DatabaseOptions, DatabaseOptions>;
/// In the order of the help.
const std::vector<DatabaseRow>& database_rows();
void add_options(OptionSet options, DatabaseOptions& database);

/// For OptionSet::check_in_the_end(): throws core::UsageError for a voxel rule with another structure.
void check_voxels(const OptionSet& options, const core::BuildOptions& build);

/// Parses "1KiB" into bytes. Throws core::UsageError for anything but a power of two from 512 B to 64 KiB.
std::size_t parse_page_size(const std::string& text);

}  // namespace dmpc::apps
