// What a database holds, in figures: records by kind, the grid and its trees.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/info/scene_figures.h"
#include "core/database/database.h"

namespace dmpc::apps {

/// Records of one kind, with the bytes that they themselves take.
struct RecordFigures {
  std::string kind;  ///< in the plural, in words
  std::uint64_t count = 0, bytes = 0;
};

struct DatabaseFigures {
  std::uint64_t bytes = 0, pages = 0, page_size_bytes = 0;
  std::uint64_t primitives = 0;  ///< what objects became, without those left out
  std::uint64_t dropped = 0;     ///< primitives left out: no area or length, radius 0, or not finite
  std::uint64_t duplicates = 0;  ///< triangles left out that have the corners of others
  std::uint64_t copies = 0;      ///< primitives in leaves, counted once per leaf
  std::array<std::int32_t, 3> cells{}, macro_cells{};
  std::uint64_t occupied_macro_cells = 0;
  std::uint64_t levels_max = 0;                                    ///< BVH nodes from a macro cell to a leaf, at most
  bool has_voxels = false;                                         ///< which are the macro cells then
  std::uint64_t references = 0;                                    ///< voxels' references
  std::uint64_t instances = 0;                                     ///< places of base meshes
  std::uint64_t base_mesh_triangles = 0, triangles_in_places = 0;  ///< in base meshes; in instances
  std::vector<RecordFigures> records;
  std::uint64_t unused_bytes = 0;  ///< between records, so that they begin at 8 bytes and cross no page border

  /// 0 without primitives.
  double bytes_each() const;
  double copies_each() const;
  double primitives_a_leaf() const;
  /// About what the database takes with each mesh once, or else with a copy in each place, if this is of the other: what
  /// primitives and the room between records take goes with the number of triangles, or, while there are copies, by
  /// `stored_share` (MeshFigures), and all else stays.
  std::uint64_t bytes_otherwise(double stored_share) const;
};

/// Goes through all BVH nodes and leaves: `database` has its records still. `scene` is that from which it was built.
DatabaseFigures figures_of(const core::Database& database, const SceneFigures& scene);

}  // namespace dmpc::apps
