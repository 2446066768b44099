// From a scene to its database: what all structures have in common. What tells one from another is what they override.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/database/conversion.h"
#include "core/database/database.h"
#include "core/database/grid/macro_cells.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/parallel.h"
#include "core/database/record_writer.h"
#include "core/database/shading/emitters.h"
#include "core/database/shading/sky_records.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Builds in order: frame, primitives, then the records. What it is made from outlives it.
class DatabaseBuilder {
 public:
  /// `meshes`: what faces_of_meshes() says of the scene. `places`: where the records go that it writes; by default in order.
  /// `expendable`: the scene, if its objects may be freed once they have been converted.
  struct Input {
    const Scene& scene;
    const BuildOptions& options;
    std::span<const MeshFaces> meshes;
    std::vector<Address> places = {};
    Scene* expendable = nullptr;
  };
  /// That of the options' structure.
  static std::unique_ptr<DatabaseBuilder> of(Input input);

  explicit DatabaseBuilder(Input input);
  virtual ~DatabaseBuilder() = default;
  DatabaseBuilder(const DatabaseBuilder&) = delete;
  DatabaseBuilder& operator=(const DatabaseBuilder&) = delete;

  /// Nothing if the scene leaves copies out, and there are obstacles() of some of them. To be called once.
  std::optional<Database> build();
  /// By place of Scene::kept, once build() has made nothing.
  virtual std::span<const Obstacle> obstacles() const { return {}; }
  /// Says of which places copies were put into the scene before.
  void set_copied(const ObstacleCounts& copied) { counts().copied = copied; }
  /// For the records that build() has written, which the next builder writes in the same sequence.
  std::vector<Address> scattered() const;

 protected:
  /// Lists the primitives of every macro cell; none if the lists would be long.
  virtual std::optional<MacroCells> list_macro_cells() const { return list_with(0); }
  /// Takes what is kept once out of what is converted. Whether that goes.
  virtual bool keep() { return true; }
  /// Makes other cells of the macro cells. Whatever depends on cells but the boxes of BVH nodes has been settled, and rays start
  /// where they would without, so that the picture keeps its bits.
  virtual MacroCells cells_of(MacroCells cells) { return cells; }
  virtual std::uint64_t primitive_count() const { return conversion_.primitives.size(); }
  /// The id of the primitive at an index of the conversion's lists.
  virtual std::uint32_t id_of(std::uint32_t primitive) const { return primitive; }
  /// Returns how many copies of primitives are in leaves.
  virtual std::uint64_t write_records(const MacroCells& cells) = 0;

  const BuildOptions& options() const { return options_; }
  const Parallel& parallel() const { return parallel_; }
  DatabaseHeader& header() { return result_.header_; }
  const GridFrame& frame() const { return result_.header_.frame; }
  RecordCounts& counts() { return result_.records_; }
  double pad() const { return result_.pad_; }
  void set_forest_pages(std::size_t count) { result_.forest_page_count_ = count; }
  void set_open_pages(std::size_t count) { result_.open_page_count_ = count; }
  /// Of the scene, before its objects were freed.
  std::size_t object_count() const { return object_count_; }
  /// What the scene takes of the grid, grid-local: as much behind it as before it; 0 if it is empty.
  const Vec3d& used() const { return used_; }

  std::optional<MacroCells> list_with(std::int64_t excess) const;
  MacroCells sort_into_macro_cells();
  /// One macro cell in place of all.
  void join_cells();
  void coarsen();
  void set_pad();

  /// What is taken next begins a page; returns how many are before it.
  std::size_t begin_page();
  /// `references`: of voxels, if there are any.
  void write_tables(std::optional<std::uint64_t> references = std::nullopt);
  void write_textures();
  void write_normals(Conversion& conversion);
  void write_sky_tiles();
  void write_directory(std::span<const DirectoryEntry> directory);

  const Scene& scene_;
  const std::span<const MeshFaces> meshes_;
  Conversion conversion_;
  RecordWriter writer_;

 private:
  void fit();
  std::int32_t layers_above() const;
  void write_lights();
  void write_materials();
  void write_emitters();
  void write_sky_table();
  bool is_shown(const Texture& texture) const;
  Address add_textured(Conversion::Textured& triangle);

  Scene* expendable_;
  BuildOptions options_;
  Parallel parallel_;
  Database result_;
  double view_distance_ = 0;  ///< from the scene's middle, in extents
  Vec3d used_;
  std::size_t object_count_ = 0;
  bool has_looked_for_twins_ = false;
  Emitters emitters_;
  SkyRecords sky_;
  std::vector<TextureReference> textures_;  ///< of the scene's, in order
};

/// Frees what of a scene a database has.
void forget_objects(Scene& scene);
void forget_texels(Texture& texture);

}  // namespace dmpc::core
