// How a scene becomes records in pages: page size, their order, the structure. Shared by `render` and the studies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/run/option_row.h"
#include "core/database/database.h"

namespace dmpc::apps {

/// As the command line calls it.
const char* name_of(core::RecordOrder order);

/// As the command line calls it.
const char* name_of(core::Structure structure);
/// As the command line calls it: there are no rules but its two.
std::string text_of(const core::VoxelRule& rule);

/// A mesh that stands in several places has a copy in each or is kept once. automatic: kept where that leaves less than half of
/// the scene to store (core/scene/base_meshes.h), once the scene is known.
enum class InstancesChoice : std::uint8_t { expand, keep, automatic };

struct DatabaseOptions {
  core::BuildOptions build;
  InstancesChoice instances = InstancesChoice::expand;
  std::string why_copied;  ///< the option that keeps `automatic` from keeping any mesh; empty: none does

  /// Meshes are kept, which takes one tree.
  void store_instances() {
    build.keeps_instances = true;
    build.structure = core::Structure::extents;
  }
};

using DatabaseRow = OptionRow<DatabaseOptions, DatabaseOptions>;
/// In the order in which help has them.
const std::vector<DatabaseRow>& database_rows();
/// Declares them.
void add_options(OptionSet options, DatabaseOptions& database);

/// For OptionSet::check_in_the_end(): throws core::UsageError where there is a rule for voxels and another structure.
void check_voxels(const OptionSet& options, const core::BuildOptions& build);

/// "1KiB", in bytes. Throws core::UsageError for anything but a power of two from 512 B to 64 KiB.
std::size_t parse_page_size(const std::string& text);

}  // namespace dmpc::apps
