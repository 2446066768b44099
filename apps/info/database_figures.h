// Statistics of a database: records by kind, the grid and its trees.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/info/scene_figures.h"
#include "core/database/database.h"

namespace dmpc::apps {

/// Records of one kind, with their own bytes.
struct RecordFigures {
  std::string kind;  ///< plural, for display
  std::uint64_t count = 0, bytes = 0;
};

struct DatabaseFigures {
  std::uint64_t bytes = 0, pages = 0, page_size_bytes = 0;
  std::uint64_t primitives = 0;  ///< primitives made from objects, without those left out
  std::uint64_t dropped = 0;     ///< primitives left out: no area or length, radius 0, or not finite
  std::uint64_t duplicates = 0;  ///< triangles left out since they have the corners of others
  std::uint64_t copies = 0;      ///< primitives in leaves, counted once per leaf
  std::array<std::int32_t, 3> cells{}, macro_cells{};
  std::uint64_t occupied_macro_cells = 0;
  std::uint64_t levels_max = 0;                                    ///< maximum number of BVH nodes from a macro cell to a leaf
  bool has_voxels = false;                                         ///< then the macro cells are the voxels
  std::uint64_t references = 0;                                    ///< voxels' references
  std::uint64_t instances = 0;                                     ///< instances of base meshes
  std::uint64_t base_mesh_triangles = 0, triangles_in_places = 0;  ///< in base meshes; in instances
  std::vector<RecordFigures> records;
  std::uint64_t unused_bytes = 0;  ///< padding between records, so that they are aligned to 8 bytes and cross no page boundary

  /// Returns 0 without primitives.
  double bytes_each() const;
  double copies_each() const;
  double primitives_a_leaf() const;
  /// Estimates the size of the database with each mesh stored once or, if it is stored so here, with a copy per instance. The
  /// bytes of primitives and of the padding between records scale with the number of triangles or, while there are copies, by
  /// `stored_share` (MeshFigures); all other bytes stay.
  std::uint64_t bytes_otherwise(double stored_share) const;
};

/// Visits all BVH nodes and leaves: `database` still has its records. `scene` is the scene from which it was built.
DatabaseFigures figures_of(const core::Database& database, const SceneFigures& scene);

}  // namespace dmpc::apps
