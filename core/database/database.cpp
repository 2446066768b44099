#include "core/database/database.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/box.h"
#include "core/base/expect.h"
#include "core/base/forget.h"
#include "core/database/brick_builder.h"
#include "core/database/conversion.h"
#include "core/database/coplanar.h"
#include "core/database/copy_limits.h"
#include "core/database/emitters.h"
#include "core/database/empty_space.h"
#include "core/database/kept_instances.h"
#include "core/database/left_out_places.h"
#include "core/database/material_records.h"
#include "core/database/mesh_faces.h"
#include "core/database/obstacle.h"
#include "core/database/parallel.h"
#include "core/database/placed_boxes.h"
#include "core/database/record_writer.h"
#include "core/database/sky_records.h"
#include "core/database/texture_records.h"
#include "core/database/top_cells.h"
#include "core/database/twins.h"
#include "core/database/voxel_frame.h"
#include "core/database/voxel_lists.h"
#include "core/record/directory.h"
#include "core/record/records.h"
#include "core/record/texture_layout.h"
#include "core/record/voxel_list.h"
#include "core/scene/detail.h"
#include "core/scene/frame.h"
#include "core/scene/kept_meshes.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

void forget_objects(Scene& scene) {
  forget(scene.objects);
  forget(scene.vertices);
  forget(scene.normals);
  forget(scene.spheres);
  forget(scene.cones);
  forget(scene.corners);
  scene.kept.reset();
}

void forget_texels(Scene& scene) {
  for (Texture& texture : scene.textures) {
    for (TextureLevel& level : texture.levels) {
      forget(level.texels);
    }
  }
}

}  // namespace

/// Builds in order: frame, primitives, then the records.
class DatabaseBuilder {
 public:
  /// `meshes`: what faces_of_meshes() says of the scene. `places`: where the records go that it writes; by default in order.
  /// `expendable`: the scene, if its objects may be freed once they have been converted.
  DatabaseBuilder(const Scene& scene, const BuildOptions& options, std::span<const MeshFaces> meshes,
                  std::vector<Address> places = {}, Scene* expendable = nullptr)
      : scene_(scene),
        meshes_(meshes),
        expendable_(expendable),
        options_(options),
        parallel_(options.threads),
        writer_(options.page_size_bytes, std::move(places)) {
    expect(options.page_size_bytes >= 512 && options.page_size_bytes <= 65536 &&
               (options.page_size_bytes & (options.page_size_bytes - 1)) == 0,
           "a page is a power of two from 512 B to 64 KiB");
    expect(!options.keeps_instances || (options.structure == Structure::extents && options.record_order == RecordOrder::spatial),
           "instances are kept in one tree of extents, in spatial order");
    result_.page_size_ = options.page_size_bytes;
  }

  /// Nothing if the scene leaves copies out, and there are obstacles() of some of them.
  std::optional<Database> build() {
    if (leaves_copies_out(scene_)) {
      left_out_.emplace(scene_, meshes_, parallel_);
    }
    fit();
    conversion_ = convert(scene_, header().frame, parallel_, {.meshes = meshes_});
    set_pad();  // places of meshes may have brought layers
    TopCells cells = sort_into_top_cells();
    if (settle_coplanar(conversion_, cells, scene_, header().frame, parallel_)) {
      set_pad();                      // there are layers now
      cells = sort_into_top_cells();  // which may look for twins among the scene's objects
    }
    if (options_.keeps_instances && !keep()) {
      return std::nullopt;
    }
    if (expendable_ != nullptr) {
      forget_objects(*expendable_);
    }
    if (!kept_.empty()) {
      join_cells();
    } else if (options_.structure == Structure::extents) {
      cells = join_top_cells();
    } else if (options_.structure == Structure::voxels) {
      cells = sort_into_voxels();
    }
    header().primitive_count =
        static_cast<std::uint32_t>(conversion_.primitives.size() + (left_out_ ? kept_.triangles : std::uint64_t{0}));
    if (options_.emitters_max > 0) {
      emitters_ = choose_emitters(conversion_, scene_, options_.emitters_max);
      for (EmitterRecord& emitter : emitters_.records) {
        emitter.primitive = left_out_ ? kept_.told[emitter.primitive] : emitter.primitive;
      }
    }
    result_.references_ = cells.references();
    if (!kept_.empty()) {
      write_kept();
    } else {
      options_.structure == Structure::voxels ? write_voxels(cells) : write_records(cells);
    }
    give_back_freed();  // trees are many small pieces
    result_.dropped_ = conversion_.dropped;
    result_.duplicates_ = conversion_.duplicates;
    result_.shared_planes_ = conversion_.shared_planes;
    result_.primitives_ = std::move(conversion_.primitives);
    result_.sources_ = std::move(conversion_.sources);
    result_.collapsed_ = std::move(conversion_.collapsed);
    result_.close_faces_ = std::move(conversion_.close_faces);
    result_.planes_ = std::move(conversion_.planes);
    result_.bytes_ = std::move(writer_).finish();
    result_.page_count_ = (result_.bytes_.size() - overread_bytes) / result_.page_size_;
    return std::move(result_);
  }

  /// Says of which places copies were put into the scene before.
  void set_copied(const ObstacleCounts& copied) { result_.records_.copied = copied; }

  /// By place of Scene::kept, once build() has made nothing.
  std::span<const Obstacle> obstacles() const { return obstacles_; }

  /// For the records that build() has written, which the next builder writes in the same sequence.
  std::vector<Address> scattered() const {
    return scattered_places(writer_.sizes(), writer_.front_bytes(), options_.page_size_bytes);
  }

 private:
  DatabaseHeader& header() { return result_.header_; }

  /// Whether all places that have no copies can be kept.
  bool keep() {
    if (!left_out_) {
      kept_ = keep_instances(scene_, meshes_, header().frame, result_.pad_, conversion_, parallel_);
      result_.records_.copied = kept_.copied;
      return true;
    }
    obstacles_ = left_out_->obstacles(header().frame, result_.pad_);
    if (any_of(obstacles_)) {
      return false;
    }
    kept_ = left_out_->keep(header().frame, result_.pad_, conversion_, parallel_);
    return true;
  }

  void fit() {
    const Box bounds = bounds_of(scene_, options_.axes, parallel_);
    object_count_ = object_count(scene_);
    header().frame = fit_frame(bounds, object_count_, options_.cells_per_primitive, options_.axes);
    if (const auto place = place_of_detail(scene_, options_.axes, bounds)) {
      move_zero(header().frame, *place);
    }
    header().background = Color(scene_.background);
    header().ambient = Color(scene_.ambient);
    if (!bounds.empty()) {
      const Vec3d extent = bounds.high - bounds.low;
      const double size = std::max({extent.x, extent.y, extent.z, 1e-30});
      const GridFrame& frame = header().frame;
      const Vec3d low = (bounds.low - frame.origin) * frame.scale, high = (bounds.high - frame.origin) * frame.scale;
      used_ = high + low - frame.low * 2.0;
      view_distance_ = std::min(length(turned(options_.axes, scene_.view.from) - bounds.center()) / size, 2 * far_eye_diagonals);
    }
    set_pad();
  }

  void set_pad() { result_.pad_ = options_.pad_share * insertion_pad(header().frame, view_distance_, layers_above()); }

  /// The highest layer of a plane.
  std::int32_t layers_above() const {
    std::int32_t layers = conversion_.place_layers;
    for (const KeptPlane& plane : conversion_.planes) {
      layers = std::max(layers, plane.kept_as - std::int32_t{BlockHeader::exact_plane});
    }
    return layers;
  }

  Vec3d local(const Vec3d& point) const { return to_local(result_.header_.frame, point); }

  /// Lists the primitives of every top cell. Where they are so large, so long, so far from the view or so much in one place that
  /// the lists would be long, those go that are there many times over; then cells of twice the size are tried, at last a single
  /// one.
  TopCells sort_into_top_cells() {
    for (;;) {
      if (auto cells = list_top_cells()) {
        return std::move(*cells);
      }
      const bool is_first_try = !std::exchange(has_looked_for_twins_, true);
      if (!is_first_try || !drop_twins(conversion_, scene_, header().frame)) {
        coarsen();
      }
    }
  }

  /// Together with copies that are left out, too. These are looked at one by one only if that may let cells be smaller.
  std::optional<TopCells> list_top_cells() const {
    const GridFrame& frame = result_.header_.frame;
    const auto list = [&](std::int64_t excess) {
      return TopCells::list(conversion_.primitives, frame, result_.pad_, parallel_, excess);
    };
    if (!left_out_) {
      return list(0);
    }
    const std::size_t listed = conversion_.primitives.size();
    const std::int64_t excess = left_out_->excess(frame, result_.pad_, listed, false, parallel_);
    auto cells = list(excess);
    return cells || excess == LeftOutPlaces::excess_without_list
               ? std::move(cells)
               : list(left_out_->excess(frame, result_.pad_, listed, true, parallel_));
  }

  /// One top cell in place of all. Whatever depends on cells but the boxes of bricks has been settled before, and rays start
  /// where they would without, so that the picture keeps its bits.
  TopCells join_top_cells() {
    join_cells();
    return sort_into_top_cells();
  }

  void join_cells() {
    header().frame.eye_extent = grid_high(header().frame) - header().frame.low;
    while (top_cells(header().frame) != std::array<std::int32_t, 3>{1, 1, 1}) {
      coarsen();
    }
  }

  /// Voxels in place of top cells. As with one top cell, the picture keeps its bits.
  TopCells sort_into_voxels() {
    GridFrame& frame = header().frame;
    Vec3d extent = grid_high(frame) - frame.low;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent[axis] = used_[axis] > 0 ? std::min(extent[axis], used_[axis]) : extent[axis];
    }
    frame = with_voxels(frame, extent, object_count_, options_.voxels);
    set_pad();
    auto voxels = TopCells::list_voxels(conversion_.primitives, frame, result_.pad_, options_.voxels, parallel_);
    if (!voxels) {
      const auto count = top_cells(frame);
      throw RoomError("the lists of " + std::to_string(count[0]) + "x" + std::to_string(count[1]) + "x" +
                      std::to_string(count[2]) + " voxels would name more than " +
                      std::to_string(options_.voxels.references_max) +
                      " primitives: make fewer voxels, or render a smaller scene");
    }
    return std::move(*voxels);
  }

  void coarsen() {
    core::coarsen(header().frame);
    set_pad();
  }

  void write_records(const TopCells& cells) {
    write_tables();
    std::vector<BrickTree> trees;
    if (options_.structure == Structure::extents) {
      trees = draft_trees(cells);
      write_forest(trees);
    }
    write_textures();
    write_normals(conversion_);
    if (options_.structure == Structure::grid) {
      trees = draft_trees(cells);
    }
    write_grid(cells, trees);
  }

  static BrickTree build_top(const BrickBuilder& builder, std::span<const std::uint32_t> ids) {
    try {
      return builder.build({0, 0, 0}, ids);
    } catch (const RoomError& error) {
      throw RoomError(std::string(error.what()) + "; eight times as many may where meshes are expanded");
    }
  }

  /// What is no copy and the boxes of places are in one tree, behind which come those of meshes.
  void write_kept() {
    write_tables();
    header().has_instances = 1;
    const std::vector<std::uint32_t> ids = add_boxes();
    result_.references_ = ids.size();
    const BrickBuilder builder(conversion_.primitives, result_.pad_, header().frame, parallel_, levels_above_instances);
    BrickTree top = build_top(builder, ids);
    top.take_forest_room(writer_, options_.page_size_bytes);
    for (MeshRecords& mesh : kept_.meshes) {
      mesh.tree.take_forest_room(writer_, options_.page_size_bytes);
    }
    result_.forest_page_count_ = begin_page();
    const Address instances = take_instance_room();
    top.take_open_room(writer_);
    result_.open_page_count_ = begin_page() - result_.forest_page_count_;
    write_textures();
    write_normals(conversion_);
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));  // two share a record
    directory[0].bits = static_cast<std::uint32_t>(top.take_room(writer_));
    take_mesh_room();
    write_sky_tiles();
    writer_.make_room();
    top.count(result_.records_);
    top.write(conversion_.primitives, conversion_.shading, conversion_.planes, writer_, kept_.told);
    write_meshes();
    write_instances(instances);
    writer_.write(header().directory, 0, std::as_bytes(std::span(directory)));
    conversion_.primitives.resize(conversion_.primitives.size() - kept_.places.size());  // without boxes
  }

  /// What is taken next begins a page; returns how many are before it.
  std::size_t begin_page() {
    writer_.begin_page();
    return writer_.page_bytes() / options_.page_size_bytes;
  }

  /// The boxes of places become primitives behind all others. Returns what the top tree is over.
  std::vector<std::uint32_t> add_boxes() {
    std::vector<std::uint32_t> ids = std::move(kept_.own_ids);
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      const Bounds& bounds = kept_.places[i].bounds;
      PrimitiveValues box{.kind = PrimitiveKind::instance};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.value[axis] = rounded_down(double{bounds.low[axis]} - result_.pad_);
        box.value[3 + axis] = rounded_up(double{bounds.high[axis]} + result_.pad_);
      }
      ids.push_back(static_cast<std::uint32_t>(conversion_.primitives.size()));
      if (left_out_) {
        kept_.told.push_back(header().primitive_count + static_cast<std::uint32_t>(i));
      }
      conversion_.primitives.push_back(box);
    }
    return ids;
  }

  /// Blocks of boxes tell where each record lies.
  Address take_instance_room() {
    const Address instances = writer_.allocate_array<InstanceRecord>(kept_.places.size());
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      conversion_.shading.push_back({static_cast<std::uint32_t>(advance(instances, i * sizeof(InstanceRecord)))});
    }
    return instances;
  }

  void take_mesh_room() {
    for (MeshRecords& mesh : kept_.meshes) {
      write_normals(mesh.conversion);
      mesh.tree.take_room(writer_);
    }
  }

  void write_meshes() {
    for (const MeshRecords& mesh : kept_.meshes) {
      mesh.tree.count(result_.records_);
      mesh.tree.write(mesh.conversion.primitives, mesh.conversion.shading, mesh.conversion.planes, writer_);
    }
  }

  void write_instances(Address instances) {
    RecordCounts& counts = result_.records_;
    counts.instances = kept_.places.size();
    std::vector<bool> is_used(kept_.meshes.size());
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      const KeptInstance& place = kept_.places[i];
      const MeshRecords& mesh = kept_.meshes[place.mesh];
      InstanceRecord record = kept_.record_of(place, header().frame, result_.pad_);
      record.root = mesh.tree.address;
      writer_.write(instances, i * sizeof(InstanceRecord), record);
      const std::uint64_t triangles = mesh.conversion.primitives.size();
      counts.triangles_in_places += triangles;
      if (!is_used[place.mesh]) {
        is_used[place.mesh] = true;
        ++counts.kept_meshes;
        counts.kept_triangles += triangles;
      }
    }
  }

  void write_voxels(const TopCells& cells) {
    VoxelLists lists(cells, conversion_, options_.voxels);
    result_.references_ = conversion_.primitives.size();
    write_tables(lists.references());
    write_textures();
    write_normals(conversion_);
    lists.take_room(conversion_, writer_);
    write_sky_tiles();
    writer_.make_room();
    lists.count(result_.records_);
    lists.write(conversion_, header().references, writer_);
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));
    lists.enter(header().directory_size, directory);
    if (options_.voxels.measures_empty_space) {
      const auto& size = header().directory_size;
      measure_empty_space({size[2], size[1], size[0]}, directory);
    }
    writer_.write(header().directory, 0, std::as_bytes(std::span(directory)));
  }

  /// `references`: of voxels.
  void write_tables(std::uint64_t references = 0) {
    header().region.high = grid_size(header().frame);
    header().directory_size = top_cells(header().frame);
    header().directory = writer_.allocate_array<DirectoryEntry>(directory_entry_count(header().directory_size));
    if (options_.structure == Structure::voxels) {
      header().references = writer_.allocate_array<VoxelReference>(round_up(references, std::uint64_t{2}));
    }
    header().light_count = static_cast<std::uint32_t>(scene_.lights.size());
    header().lights = writer_.allocate_array<LightRecord>(scene_.lights.size());
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const PointLight& light = scene_.lights[i];
      writer_.write(header().lights, i * sizeof(LightRecord),
                    LightRecord{.position = Vec3f(local(light.position)), .intensity = Color(intensity_of(light, scene_))});
    }
    write_materials();
    write_emitters();
    write_sky_table();
    for (const Texture& texture : scene_.textures) {
      textures_.push_back(is_shown(texture) ? reference_to(texture, writer_) : TextureReference{});
    }
  }

  /// Those of emitters behind the scene's, finishes behind all, in their order.
  void write_materials() {
    std::vector<Material> materials = scene_.materials;
    materials.insert(materials.end(), emitters_.materials.begin(), emitters_.materials.end());
    const MaterialRecords records = material_records(materials, options_.for_paths);
    const std::size_t count = records.materials.size() + records.finishes.size();
    expect(count <= 0x3fffffffU, "a database has no room for more materials");
    header().material_count = count & 0x3fffffffU;
    result_.records_.materials = records.materials.size();
    header().has_emission = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                        [](const Material& material) { return !(material.emission == Vec3d{}); })
                                ? 1
                                : 0;
    header().materials = writer_.allocate_array<MaterialRecord>(count);
    writer_.write(header().materials, 0, std::as_bytes(std::span(records.materials)));
    writer_.write(header().materials, records.materials.size() * sizeof(MaterialRecord),
                  std::as_bytes(std::span(records.finishes)));
  }

  void write_emitters() {
    result_.records_.emitters_met = emitters_.others;
    if (emitters_.records.empty()) {
      return;
    }
    header().emitter_count = static_cast<std::uint32_t>(emitters_.records.size());
    header().drawn_materials = static_cast<std::uint32_t>(scene_.materials.size());
    header().emitter_density = emitters_.density;
    header().emitters = writer_.allocate_array<EmitterRecord>(emitters_.records.size());
    const Address choices = writer_.allocate_array<EmitterChoice>(emitters_.choices.size());
    expect(choices == choice_address(header(), 0), "choices stand behind all emitters");
    writer_.write(header().emitters, 0, std::as_bytes(std::span(emitters_.records)));
    writer_.write(choices, 0, std::as_bytes(std::span(emitters_.choices)));
  }

  /// Numbers that are no colours are what pictures by paths show alone.
  bool is_shown(const Texture& texture) const { return options_.for_paths || texture.format != TexelFormat::linear; }

  void write_sky_table() {
    if (!options_.for_paths || !scene_.sky.is_there()) {
      return;
    }
    const Vec3d up = zenith_of(scene_);
    sky_ = sky_records(scene_.sky, turned(options_.axes, sky_middle(up)), turned(options_.axes, up));
    sky_.reference.choices = writer_.allocate_array<EmitterChoice>(sky_.choices.size());
    writer_.write(sky_.reference.choices, 0, std::as_bytes(std::span(sky_.choices)));
    result_.records_.sky_tiles = sky_.tiles.size();
    if (expendable_ != nullptr) {
      forget(expendable_->sky.texels);
    }
  }

  /// Behind all other records, in one piece, once these have their room.
  void write_sky_tiles() {
    if (!sky_.tiles.empty()) {
      writer_.begin_page();
      sky_.reference.tiles = writer_.allocate_array<TextureTile>(sky_.tiles.size());
      writer_.write(sky_.reference.tiles, 0, std::as_bytes(std::span(sky_.tiles)));
      header().sky = sky_.reference;
      forget(sky_.tiles);
    }
  }

  void write_textures() {
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      if (!is_shown(scene_.textures[i])) {
        continue;
      }
      write_tiles(scene_.textures[i], textures_[i], writer_);
      result_.records_.texture_tiles += tile_count(textures_[i]);
    }
    if (expendable_ != nullptr) {
      forget_texels(*expendable_);
    }
  }

  void write_normals(Conversion& conversion) {
    result_.records_.normals += conversion.smooth.size();
    for (const Conversion::Smooth& smooth : conversion.smooth) {
      conversion.shading[smooth.primitive] = ShadingReference::smooth(writer_.add(smooth.normals));
    }
    forget(conversion.smooth);
    result_.records_.textured += conversion.textured.size();
    for (Conversion::Textured& textured : conversion.textured) {
      if (textured.texture != Material::no_texture) {
        textured.normals.texture = textures_[textured.texture];
      }
      conversion.shading[textured.primitive] = ShadingReference::smooth(add_textured(textured));
    }
    forget(conversion.textured);
  }

  Address add_textured(Conversion::Textured& triangle) {
    if (!options_.for_paths || triangle.facets == Microfacets::no_texture) {
      return writer_.add(triangle.normals);
    }
    expect(triangle.texture != Material::no_texture, "a texture of metal and roughness lies where that of a colour does");
    ++result_.records_.faceted;
    triangle.normals.has_facets = 1;
    return writer_.add(FacetedNormals{.textured = triangle.normals, .facets = textures_[triangle.facets]});
  }

  /// Room for the bricks that no page holds together with all that is below them: pages of their own, with the tables.
  void write_forest(std::vector<BrickTree>& trees) {
    for (BrickTree& tree : trees) {
      tree.take_forest_room(writer_, options_.page_size_bytes);
    }
    const std::size_t pages = begin_page();
    if (options_.record_order == RecordOrder::spatial) {
      result_.forest_page_count_ = pages;
    }
  }

  /// Cells are built at the same time.
  std::vector<BrickTree> draft_trees(const TopCells& cells) {
    const BrickBuilder builder(conversion_.primitives, result_.pad_, header().frame, parallel_);
    std::vector<BrickTree> trees(cells.size());
    std::uint64_t sorted = 0;
    parallel_.for_each(
        trees.size(), [&](std::size_t i) { trees[i] = builder.build(cells.corner(i), cells.ids(i)); },
        [&](std::size_t i) {
          sorted += cells.ids(i).size();
          if (options_.progress) {
            options_.progress(sorted, cells.references());
          }
        });
    return trees;
  }

  /// Trees take their room in order, and are written at the same time.
  void write_grid(const TopCells& cells, std::vector<BrickTree>& trees) {
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const std::uint64_t entry = directory_index(header().directory_size, cells.corner(i));
      trees[i].count(result_.records_);
      directory[entry].bits = static_cast<std::uint32_t>(trees[i].take_room(writer_));
    }
    write_sky_tiles();
    writer_.make_room();
    parallel_.for_each(trees.size(), [&](std::size_t i) {
      trees[i].write(conversion_.primitives, conversion_.shading, conversion_.planes, writer_);
    });
    measure_empty_space(header().directory_size, directory);
    writer_.write(header().directory, 0, std::as_bytes(std::span(directory)));
  }

  const Scene& scene_;
  std::span<const MeshFaces> meshes_;
  Scene* expendable_;
  BuildOptions options_;
  Parallel parallel_;
  RecordWriter writer_;
  Database result_;
  double view_distance_ = 0;  ///< from the scene's middle, in extents
  Vec3d used_;                ///< of the grid, grid-local: up to the scene, and as much behind it as before it; 0 if it is empty
  std::size_t object_count_ = 0;  ///< of the scene, before they are freed
  bool has_looked_for_twins_ = false;
  Conversion conversion_;
  std::optional<LeftOutPlaces> left_out_;
  std::vector<Obstacle> obstacles_;
  KeptInstances kept_;
  Emitters emitters_;
  SkyRecords sky_;
  std::vector<TextureReference> textures_;  ///< of the scene's, in order
};

namespace {

/// visit(address, block) for each block below a brick.
template <class Visit>
void for_each_block_below(const LocalRecords& records, Address from, const Visit& visit) {
  const auto brick = read<Brick>(records.find(from));
  for (std::size_t child = 0; child < brick.child_count; ++child) {
    const Address address = brick.child[child].address();
    brick.child[child].is_block() ? visit(address, records.find(address)) : for_each_block_below(records, address, visit);
  }
}

/// `first` is the id of what the block calls 0; `lane_of` makes the lane of a hit of the block's.
template <class LaneOf>
void add_places(Address address, const std::byte* block, std::uint32_t first, const LaneOf& lane_of,
                std::vector<Database::Place>& places) {
  const auto header = read<BlockHeader>(block);
  const std::byte* const ids = ids_of(header, block);
  for (std::uint32_t lane = 0; lane < header.count; ++lane) {
    places[first + read<std::uint32_t>(ids + lane * sizeof(std::uint32_t))] = {address, lane_of(lane)};
  }
}

/// What each instance of a block of them puts in its place.
void find_places_of_instances(const LocalRecords& records, const std::byte* block, std::vector<Database::Place>& places) {
  for (std::size_t i = 0; i < read<BlockHeader>(block).count; ++i) {
    const Address address = instance_in(block, i);
    const auto instance = read<InstanceRecord>(records.find(address));
    for_each_block_below(records, instance.root, [&](Address at, const std::byte* of_mesh) {
      add_places(
          at, of_mesh, instance.first, [&](std::uint32_t lane) { return lane_in_instance(lane, address); }, places);
    });
  }
}

void find_places_in(const LocalRecords& records, Address address, std::vector<Database::Place>& places) {
  const std::byte* const block = records.find(address);
  if (read<BlockHeader>(block).kind == PrimitiveKind::instance) {
    return find_places_of_instances(records, block, places);
  }
  add_places(
      address, block, 0, [](std::uint32_t lane) { return lane; }, places);
}

/// Of the copies that a scene leaves out.
std::uint64_t copied_corners(const Scene& scene) { return size_with_copies(scene).vertices - scene.vertices.size(); }

/// What is there while a scene with copies in these places becomes primitives. Their records take its objects' place.
std::uint64_t bytes_with_copies(const Scene& scene, const std::vector<bool>& places) {
  constexpr std::uint64_t a_primitive = sizeof(PrimitiveValues) + sizeof(PrimitiveSource) + sizeof(ShadingReference);
  const ExpandedSize size = size_with_copies(scene, places);
  const std::uint64_t triangles = size.vertices - std::min(size.vertices, 2 * size.objects);
  return size.bytes() + std::max(size.objects, triangles) * a_primitive;
}

/// `why`: they have to be there, behind "with a copy in each place".
void put_copies_in(Scene& scene, const std::vector<bool>& places, const CopyLimits& limits, const std::string& why,
                   const char* advice) {
  if (const std::uint64_t bytes = bytes_with_copies(scene, places); bytes > limits.bytes_max) {
    throw RoomError("with a copy in each place" + why + ", the scene takes " + std::to_string(bytes >> 20U) +
                    " MiB of memory, and there are " + std::to_string(limits.bytes_max >> 20U) + " for it: " + advice);
  }
  put_copies(scene, places);
}

constexpr const char* fewer_places = "give the scene fewer places, or coarser meshes";

/// Counts them in `copied`.
void put_obstacles_in(Scene& scene, std::span<const Obstacle> obstacles, const CopyLimits& limits, ObstacleCounts& copied) {
  add(obstacles, copied);
  if (any_of(obstacles)) {
    std::vector<bool> places;
    for (const Obstacle obstacle : obstacles) {
      places.push_back(obstacle != Obstacle::none);
    }
    put_copies_in(scene, places, limits, " of what cannot be kept once (" + text_of(scene, obstacles) + ")", fewer_places);
  }
}

void put_all_in(Scene& scene, const CopyLimits& limits) {
  if (leaves_copies_out(scene)) {
    const bool is_asked_for = *limits.reason != 0;
    put_copies_in(scene, std::vector<bool>(scene.kept->places.size(), true), limits,
                  is_asked_for ? std::string(", ") + limits.reason : "", is_asked_for ? limits.advice : fewer_places);
  }
}

}  // namespace

std::vector<Database::Place> Database::find_places() const {
  const LocalRecords records(bytes());
  std::vector<Place> places(header_.primitive_count);
  for (std::uint64_t i = 0; i < directory_entry_count(header_.directory_size); ++i) {
    const auto entry = read<DirectoryEntry>(records.find(header_.directory) + i * sizeof(DirectoryEntry));
    if (entry.empty()) {
      continue;
    }
    if (header_.has_voxels()) {
      for_each_listed(records, header_, entry, [&](Address block) { find_places_in(records, block, places); });
    } else {
      for_each_block_below(records, entry.brick(),
                           [&](Address address, const std::byte*) { find_places_in(records, address, places); });
    }
  }
  return places;
}

Database build_database(const Scene& scene, const BuildOptions& options) {
  if (leaves_copies_out(scene)) {
    Scene whole = scene;
    return build_database(std::move(whole), options);
  }
  const std::vector<MeshFaces> meshes = faces_of_meshes(scene, options.cells_per_primitive, Parallel(options.threads));
  DatabaseBuilder builder(scene, options, meshes);
  Database database = builder.build().value();
  return options.record_order == RecordOrder::spatial
             ? std::move(database)
             : DatabaseBuilder(scene, options, meshes, builder.scattered()).build().value();
}

Database build_database(Scene&& scene, const BuildOptions& options) {
  return build_database(std::move(scene), options, CopyLimits{});
}

Database build_database(Scene&& scene, const BuildOptions& options, const CopyLimits& limits) {
  const Parallel parallel(options.threads);
  const std::vector<MeshFaces> meshes = faces_of_meshes(scene, options.cells_per_primitive, parallel);
  if (options.keeps_instances && copied_corners(scene) > limits.corners_max) {
    ObstacleCounts copied;
    put_obstacles_in(scene, obstacles_of(scene, meshes, parallel), limits, copied);
    while (copied_corners(scene) > limits.corners_max) {
      DatabaseBuilder builder(scene, options, meshes, {}, &scene);
      builder.set_copied(copied);
      if (auto database = builder.build()) {
        return std::move(*database);
      }
      put_obstacles_in(scene, builder.obstacles(), limits, copied);
    }
  }
  put_all_in(scene, limits);
  if (options.record_order == RecordOrder::spatial) {
    return DatabaseBuilder(scene, options, meshes, {}, &scene).build().value();
  }
  Database database = build_database(std::as_const(scene), options);
  forget_objects(scene);
  forget_texels(scene);
  return database;
}

}  // namespace dmpc::core
