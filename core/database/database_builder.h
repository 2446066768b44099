// From a scene to its database: the part that all structures have in common. Structures override the rest.
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

/// Builds in order: frame, primitives, then the records. The constructor's arguments outlive it.
class DatabaseBuilder {
 public:
  /// `meshes`: faces_of_meshes() of the scene. `places`: where the records are to be written; by default in order. `expendable`:
  /// the scene, if its objects may be freed once they have been converted.
  struct Input {
    const Scene& scene;
    const BuildOptions& options;
    std::span<const MeshFaces> meshes;
    std::vector<Address> places = {};
    Scene* expendable = nullptr;
  };
  /// The builder for the options' structure.
  static std::unique_ptr<DatabaseBuilder> of(Input input);

  explicit DatabaseBuilder(Input input);
  virtual ~DatabaseBuilder() = default;
  DatabaseBuilder(const DatabaseBuilder&) = delete;
  DatabaseBuilder& operator=(const DatabaseBuilder&) = delete;

  /// Nothing if the scene leaves copies out and some of them have obstacles(). To be called once.
  std::optional<Database> build();
  /// By instance of Scene::kept, once build() has returned nothing.
  virtual std::span<const Obstacle> obstacles() const { return {}; }
  /// Sets for which instances copies were added to the scene before.
  void set_copied(const ObstacleCounts& copied) { counts().copied = copied; }
  /// Places for the records that build() has written; the next builder writes them in the same sequence.
  std::vector<Address> scattered() const;

 protected:
  /// Lists the primitives of every macro cell; none if the lists would be long.
  virtual std::optional<MacroCells> list_macro_cells() const { return list_with(0); }
  /// Takes base meshes out of the conversion. Returns whether that is possible.
  virtual bool keep() { return true; }
  /// Replaces the macro cells by other cells. Everything that depends on cells except the boxes of BVH nodes has been settled,
  /// and rays start where they would without, so that the picture has the same bits.
  virtual MacroCells cells_of(MacroCells cells) { return cells; }
  virtual std::uint64_t primitive_count() const { return conversion_.primitives.size(); }
  /// The id of the primitive at an index of the conversion's lists.
  virtual std::uint32_t id_of(std::uint32_t primitive) const { return primitive; }
  /// Returns the number of copies of primitives in leaves.
  virtual std::uint64_t write_records(const MacroCells& cells) = 0;

  const BuildOptions& options() const { return options_; }
  const Parallel& parallel() const { return parallel_; }
  DatabaseHeader& header() { return result_.header_; }
  const GridFrame& frame() const { return result_.header_.frame; }
  RecordCounts& counts() { return result_.records_; }
  double pad() const { return result_.pad_; }
  void set_forest_pages(std::size_t count) { result_.forest_page_count_ = count; }
  void set_open_pages(std::size_t count) { result_.open_page_count_ = count; }
  /// Number of the scene's objects, before they were freed.
  std::size_t object_count() const { return object_count_; }
  /// The extent of the scene in the grid, grid-local: margins on both sides are equal; 0 if it is empty.
  const Vec3d& used() const { return used_; }

  std::optional<MacroCells> list_with(std::int64_t excess) const;
  MacroCells sort_into_macro_cells();
  /// Replaces all macro cells by one.
  void join_cells();
  void coarsen();
  void set_pad();

  /// Starts a new page for the next record; returns the number of pages before it.
  std::size_t begin_page();
  /// `references`: number of voxels' references, if there are voxels.
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
  double view_distance_ = 0;  ///< from the scene's middle, in multiples of its extent
  Vec3d used_;
  std::size_t object_count_ = 0;
  bool has_looked_for_twins_ = false;
  Emitters emitters_;
  SkyRecords sky_;
  std::vector<TextureReference> textures_;  ///< for the scene's, in order
};

/// Frees the parts of a scene that its database contains.
void forget_objects(Scene& scene);
void forget_texels(Texture& texture);

}  // namespace dmpc::core
