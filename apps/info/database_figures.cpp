#include "apps/info/database_figures.h"

#include <algorithm>

#include "core/base/ranges.h"
#include "core/database/address_map.h"
#include "core/record/choice_node.h"
#include "core/record/directory.h"
#include "core/record/emitter.h"
#include "core/record/instance.h"
#include "core/record/records.h"
#include "core/record/sky.h"

namespace dmpc::apps {

namespace {

using core::PrimitiveKind;

constexpr std::array<const char*, core::primitive_kind_count> leaf_names = {"leaves of triangles", "leaves of spheres",
                                                                            "leaves of cones"};
constexpr const char* place_leaf_name = "leaves of places";
/// Records besides leaves whose bytes grow with triangles and instances.
constexpr std::array<const char*, 5> geometry_names = {"bvh_nodes", place_leaf_name, "places of meshes", "normals",
                                                       "textured triangles"};

/// Traverses the trees below all macro cells.
class TreeTraversal {
 public:
  explicit TreeTraversal(const core::Database& database) : records_(database.bytes()) {
    const core::DatabaseHeader& header = database.header();
    for (std::uint64_t i = 0; i < core::directory_entry_count(header.directory_size); ++i) {
      const std::byte* const entries = records_.find(core::directory_address(header, i));
      const auto entry = core::read<core::DirectoryEntry>(entries + core::directory_offset(i));
      if (!entry.empty()) {
        ++occupied;
        header.has_voxels() ? visit_list(header, entry) : visit(entry.bvh_node(), 1);
      }
    }
  }

  std::uint64_t occupied = 0, levels_max = 0;
  std::array<RecordFigures, core::primitive_kind_count> leaves{};
  RecordFigures place_leaves{.kind = place_leaf_name};

 private:
  /// `level` is at most core::bvh_levels_max.
  void visit(core::Address address, std::uint64_t level) {
    const auto bvh_node = core::read<core::BvhNode>(records_.find(address));
    levels_max = std::max(levels_max, level);
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      if (bvh_node.child[child].is_leaf()) {
        visit_leaf(bvh_node.child[child].address(), level);
      } else {
        visit(bvh_node.child[child].address(), level + 1);
      }
    }
  }

  /// Visits the base meshes below a leaf of instances, each once.
  void visit_leaf(core::Address address, std::uint64_t level) {
    const std::byte* const leaf = records_.find(address);
    const auto header = core::read<core::LeafHeader>(leaf);
    if (header.kind != PrimitiveKind::instance) {
      return count(header);
    }
    ++place_leaves.count;
    place_leaves.bytes += core::leaf_bytes(header);
    const std::byte* const places = core::ids_of(header, leaf) + header.count * sizeof(std::uint32_t);
    for (std::size_t lane = 0; lane < header.count; ++lane) {
      const core::Address place{core::read<std::uint32_t>(places + lane * sizeof(std::uint32_t))};
      const core::Address root = core::read<core::InstanceRecord>(records_.find(place)).root;
      if (listed_.find_or_add(root).second) {
        visit(root, level + 1);
      }
    }
  }

  void visit_list(const core::DatabaseHeader& header, const core::DirectoryEntry& voxel) {
    core::for_each_listed(records_, header, voxel, [&](core::Address leaf) {
      if (listed_.find_or_add(leaf).second) {
        count(core::read<core::LeafHeader>(records_.find(leaf)));
      }
    });
  }

  void count(const core::LeafHeader& leaf) {
    RecordFigures& figures = leaves[static_cast<std::size_t>(leaf.kind)];
    ++figures.count;
    figures.bytes += core::leaf_bytes(leaf);
  }

  core::LocalRecords records_;
  core::AddressMap listed_;  ///< leaves of voxels, roots of base meshes
};

template <class Record>
RecordFigures figures_for(const char* kind, std::uint64_t count) {
  return {kind, count, count * sizeof(Record)};
}

std::vector<RecordFigures> records_of(const core::Database& database, const SceneFigures& scene, const TreeTraversal& trees) {
  const core::DatabaseHeader& header = database.header();
  const core::RecordCounts& counts = database.records();
  std::vector<RecordFigures> records = {
      figures_for<core::DirectoryEntry>("entries of the directory", core::directory_entry_count(header.directory_size)),
      figures_for<core::BvhNode>("bvh_nodes", counts.bvh_nodes)};
  if (header.has_voxels()) {
    records.push_back(figures_for<core::VoxelReference>("references of voxels", counts.voxel_references));
  }
  for (std::size_t kind = 0; kind < trees.leaves.size(); ++kind) {
    records.push_back({leaf_names[kind], trees.leaves[kind].count, trees.leaves[kind].bytes});
  }
  records.push_back(trees.place_leaves);
  records.push_back(figures_for<core::InstanceRecord>("places of meshes", counts.instances));
  records.push_back(figures_for<core::PatchNormals>("normals", counts.normals));
  records.push_back(figures_for<core::TexturedNormals>("textured triangles", counts.textured - counts.faceted));
  if (counts.faceted > 0) {
    records.push_back(figures_for<core::FacetedNormals>("triangles with a texture of metal", counts.faceted));
  }
  std::uint64_t entries = 0;
  for (const TextureFigures& texture : scene.textures) {
    entries += counts.faceted > 0 || texture.format != core::TexelFormat::linear ? texture.entries : 0;
  }
  records.push_back(figures_for<core::Address>("entries of tables of tiles", entries));
  records.push_back(figures_for<core::TextureTile>("texture tiles", counts.texture_tiles));
  records.push_back(figures_for<core::MaterialRecord>("materials", header.material_count));
  records.push_back(figures_for<core::LightRecord>("lights", header.light_count));
  if (has_emitters(header)) {
    records.push_back(figures_for<core::EmitterRecord>("emitters", header.emitter_count));
    records.push_back(figures_for<core::ChoiceNode>("choices of emitters", core::choice_node_count(header.emitter_count)));
  }
  if (has_sky_picture(header)) {
    records.push_back(figures_for<core::ChoiceNode>("choices of tiles of the sky",
                                                    core::choice_node_count(static_cast<std::uint32_t>(counts.sky_tiles))));
    records.push_back(figures_for<core::TextureTile>("tiles of the sky", counts.sky_tiles));
  }
  return records;
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double DatabaseFigures::bytes_each() const { return ratio(bytes, primitives); }
double DatabaseFigures::copies_each() const { return ratio(copies, primitives); }

double DatabaseFigures::primitives_a_leaf() const {
  const std::uint64_t leaves = core::sum_over<std::uint64_t>(records, [&](const RecordFigures& record) {
    return std::find(leaf_names.begin(), leaf_names.end(), record.kind) != leaf_names.end() ? record.count : 0;
  });
  return ratio(copies, leaves);
}

std::uint64_t DatabaseFigures::bytes_otherwise(double stored_share) const {
  std::uint64_t geometry = unused_bytes;
  for (const RecordFigures& record : records) {
    const auto is_among = [&](const auto& names) { return std::find(names.begin(), names.end(), record.kind) != names.end(); };
    geometry += is_among(leaf_names) || is_among(geometry_names) ? record.bytes : 0;
  }
  const double share = instances > 0 ? ratio(copies - base_mesh_triangles + triangles_in_places, copies) : stored_share;
  return bytes - geometry + static_cast<std::uint64_t>(static_cast<double>(geometry) * share);
}

DatabaseFigures figures_of(const core::Database& database, const SceneFigures& scene) {
  const TreeTraversal trees(database);
  DatabaseFigures figures{.bytes = database.page_count() * database.page_size(),
                          .pages = database.page_count(),
                          .page_size_bytes = database.page_size(),
                          .primitives = database.header().primitive_count,
                          .dropped = database.dropped(),
                          .duplicates = database.duplicates(),
                          .copies = database.references() - database.records().instances + database.records().base_mesh_triangles,
                          .cells = database.header().frame.resolution,
                          .macro_cells = core::macro_cells(database.header().frame),
                          .occupied_macro_cells = trees.occupied,
                          .levels_max = trees.levels_max,
                          .has_voxels = database.header().has_voxels(),
                          .references = database.records().voxel_references,
                          .instances = database.records().instances,
                          .base_mesh_triangles = database.records().base_mesh_triangles,
                          .triangles_in_places = database.records().triangles_in_places,
                          .records = records_of(database, scene, trees)};
  figures.unused_bytes = figures.bytes;
  for (const RecordFigures& record : figures.records) {
    figures.unused_bytes -= record.bytes;
  }
  return figures;
}

}  // namespace dmpc::apps
