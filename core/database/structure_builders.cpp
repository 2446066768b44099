// How each structure builds its cells, and the order of its records.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/database/database_builder.h"
#include "core/database/grid/empty_space.h"
#include "core/database/grid/voxel_lists.h"
#include "core/database/meshes/mesh_records.h"
#include "core/database/meshes/stored_instances.h"
#include "core/database/meshes/uncopied_instances.h"
#include "core/database/tree/bvh_builder.h"
#include "core/record/coordinate.h"
#include "core/record/directory.h"
#include "core/record/instance.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

/// Builds a tree in each macro cell.
class GridBuilder : public DatabaseBuilder {
 public:
  using DatabaseBuilder::DatabaseBuilder;

 protected:
  std::uint64_t write_records(const MacroCells& cells) override {
    write_tables();
    write_textures();
    write_normals(conversion_);
    write_trees(cells, draft_trees(cells));
    return cells.references();
  }

  /// Cells are built in parallel.
  std::vector<BvhTree> draft_trees(const MacroCells& cells) {
    const BvhBuilder builder(conversion_.primitives, pad(), frame(), parallel());
    std::vector<BvhTree> trees(cells.size());
    std::uint64_t sorted = 0;
    parallel().for_each(
        trees.size(), [&](std::size_t i) { trees[i] = builder.build(cells.corner(i), cells.ids(i)); },
        [&](std::size_t i) {
          sorted += cells.ids(i).size();
          if (options().progress) {
            options().progress(sorted, cells.references());
          }
        });
    return trees;
  }

  /// Trees are allocated in order and written in parallel.
  void write_trees(const MacroCells& cells, std::vector<BvhTree> trees) {
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const std::uint64_t entry = directory_index(header().directory_size, cells.corner(i));
      trees[i].count(counts());
      directory[entry].bits = static_cast<std::uint32_t>(trees[i].take_room(writer_));
    }
    write_sky_tiles();
    writer_.make_room();
    parallel().for_each(trees.size(), [&](std::size_t i) {
      trees[i].write(conversion_.primitives, conversion_.shading, conversion_.planes, writer_);
    });
    measure_empty_space(header().directory_size, directory);
    write_directory(directory);
  }
};

/// Builds a single tree. BVH nodes whose subtree does not fit a page have pages of their own, with the tables.
class TreeBuilder : public GridBuilder {
 public:
  using GridBuilder::GridBuilder;

 protected:
  MacroCells cells_of(MacroCells) override {
    join_cells();
    return sort_into_macro_cells();
  }

  std::uint64_t write_records(const MacroCells& cells) override {
    write_tables();
    std::vector<BvhTree> trees = draft_trees(cells);
    for (BvhTree& tree : trees) {
      tree.take_forest_room(writer_, options().page_size_bytes);
    }
    const std::size_t pages = begin_page();
    set_forest_pages(options().record_order == RecordOrder::spatial ? pages : 0);
    write_textures();
    write_normals(conversion_);
    write_trees(cells, std::move(trees));
    return cells.references();
  }
};

/// Builds a single tree whose leaves include boxes of mesh instances; the trees of the meshes follow it.
class InstancedBuilder : public TreeBuilder {
 public:
  explicit InstancedBuilder(Input input) : TreeBuilder(std::move(input)) {
    if (leaves_copies_out(scene_)) {
      left_out_.emplace(scene_, meshes_, parallel());
    }
  }

  std::span<const Obstacle> obstacles() const override { return obstacles_; }

 protected:
  /// The copies that are left out count, too. They are counted one by one only if that may allow smaller cells.
  std::optional<MacroCells> list_macro_cells() const override {
    if (!left_out_) {
      return list_with(0);
    }
    const std::size_t listed = conversion_.primitives.size();
    const std::int64_t excess = left_out_->excess(frame(), pad(), listed, false, parallel());
    auto cells = list_with(excess);
    return cells || excess == UncopiedInstances::excess_without_list
               ? std::move(cells)
               : list_with(left_out_->excess(frame(), pad(), listed, true, parallel()));
  }

  bool keep() override {
    if (!left_out_) {
      kept_ = store_instances(scene_, meshes_, frame(), pad(), conversion_, parallel());
      set_copied(kept_.copied);
      return true;
    }
    obstacles_ = left_out_->obstacles(frame(), pad());
    if (any_of(obstacles_)) {
      return false;
    }
    kept_ = left_out_->keep(frame(), pad(), conversion_, parallel());
    return true;
  }

  MacroCells cells_of(MacroCells cells) override {
    if (kept_.empty()) {
      return TreeBuilder::cells_of(std::move(cells));
    }
    join_cells();
    return cells;
  }

  std::uint64_t primitive_count() const override { return conversion_.primitives.size() + kept_.unlisted; }
  std::uint32_t id_of(std::uint32_t primitive) const override { return kept_.empty() ? primitive : kept_.reported[primitive]; }

  std::uint64_t write_records(const MacroCells& cells) override {
    if (kept_.empty()) {
      return TreeBuilder::write_records(cells);
    }
    write_tables();
    header().has_instances = 1;
    const std::vector<std::uint32_t> ids = add_boxes();
    BvhTree top = build_top(ids);
    top.take_forest_room(writer_, options().page_size_bytes);
    for (MeshRecords& mesh : kept_.meshes) {
      mesh.tree.take_forest_room(writer_, options().page_size_bytes);
    }
    const std::size_t forest_pages = begin_page();
    set_forest_pages(forest_pages);
    const Address instances = take_instance_room();
    top.take_open_room(writer_);
    set_open_pages(begin_page() - forest_pages);
    write_textures();
    write_normals(conversion_);
    std::vector<DirectoryEntry> directory(directory_entry_count(header().directory_size));  // two entries share a record
    directory[0].bits = static_cast<std::uint32_t>(top.take_room(writer_));
    for (MeshRecords& mesh : kept_.meshes) {
      write_normals(mesh.conversion);
      mesh.tree.take_room(writer_);
    }
    write_sky_tiles();
    writer_.make_room();
    top.count(counts());
    top.write(conversion_.primitives, conversion_.shading, conversion_.planes, writer_, kept_.reported);
    for (const MeshRecords& mesh : kept_.meshes) {
      mesh.tree.count(counts());
      mesh.tree.write(mesh.conversion.primitives, mesh.conversion.shading, mesh.conversion.planes, writer_);
    }
    write_instances(instances);
    write_directory(directory);
    conversion_.primitives.resize(conversion_.primitives.size() - kept_.places.size());  // without the boxes
    return ids.size();
  }

 private:
  BvhTree build_top(std::span<const std::uint32_t> ids) const {
    try {
      return BvhBuilder(conversion_.primitives, pad(), frame(), parallel(), levels_above_instances).build({0, 0, 0}, ids);
    } catch (const CapacityError& error) {
      throw CapacityError(std::string(error.what()) + "; eight times as many may where meshes are expanded");
    }
  }

  /// Appends the boxes of instances to the primitives. Returns the ids that the top-level tree contains.
  std::vector<std::uint32_t> add_boxes() {
    std::vector<std::uint32_t> ids = std::move(kept_.own_ids);
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      const Bounds& bounds = kept_.places[i].bounds;
      PrimitiveValues box{.kind = PrimitiveKind::instance};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.value[axis] = rounded_down(double{bounds.low[axis]} - pad());
        box.value[3 + axis] = rounded_up(double{bounds.high[axis]} + pad());
      }
      ids.push_back(static_cast<std::uint32_t>(conversion_.primitives.size()));
      kept_.reported.push_back(header().primitive_count + static_cast<std::uint32_t>(i));
      conversion_.primitives.push_back(box);
    }
    return ids;
  }

  /// Allocates the instance records; leaves of boxes hold the address of each.
  Address take_instance_room() {
    const Address instances = writer_.allocate_array<InstanceRecord>(kept_.places.size());
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      conversion_.shading.push_back({static_cast<std::uint32_t>(advance(instances, i * sizeof(InstanceRecord)))});
    }
    return instances;
  }

  void write_instances(Address instances) {
    counts().instances = kept_.places.size();
    std::vector<bool> is_used(kept_.meshes.size());
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      const StoredInstance& place = kept_.places[i];
      const MeshRecords& mesh = kept_.meshes[place.mesh];
      InstanceRecord record = kept_.record_of(place, frame(), pad());
      record.root = mesh.tree.address;
      writer_.write(instances, i * sizeof(InstanceRecord), record);
      const std::uint64_t triangles = mesh.conversion.primitives.size();
      counts().triangles_in_places += triangles;
      if (!is_used[place.mesh]) {
        is_used[place.mesh] = true;
        ++counts().base_meshes;
        counts().base_mesh_triangles += triangles;
      }
    }
  }

  std::optional<UncopiedInstances> left_out_;
  std::vector<Obstacle> obstacles_;
  StoredInstances kept_;
};

/// Builds a list in each voxel. The frame of its plain grid begins where the usual one does, and keeps local zero and the start
/// of rays from far eyes.
class VoxelBuilder : public DatabaseBuilder {
 public:
  using DatabaseBuilder::DatabaseBuilder;

 protected:
  MacroCells cells_of(MacroCells) override {
    cut_into_voxels();
    set_pad();
    const VoxelRule& rule = options().voxels;
    auto voxels = MacroCells::list_voxels(conversion_.primitives, frame(), pad(), rule, parallel());
    if (!voxels) {
      const auto count = macro_cells(frame());
      throw CapacityError("the lists of " + std::to_string(count[0]) + "x" + std::to_string(count[1]) + "x" +
                          std::to_string(count[2]) + " voxels would name more than " + std::to_string(rule.references_max) +
                          " primitives: make fewer voxels, or render a smaller scene");
    }
    return std::move(*voxels);
  }

  std::uint64_t write_records(const MacroCells& cells) override {
    VoxelLists lists(cells, conversion_, options().voxels);
    write_tables(lists.references());
    write_textures();
    write_normals(conversion_);
    lists.take_room(conversion_, writer_);
    write_sky_tiles();
    writer_.make_room();
    lists.count(counts());
    lists.write(conversion_, header().references, writer_);
    const auto& size = header().directory_size;
    std::vector<DirectoryEntry> directory(directory_entry_count(size));
    lists.enter(size, directory);
    if (options().voxels.measures_empty_space) {
      measure_empty_space({size[2], size[1], size[0]}, directory);
    }
    write_directory(directory);
    return conversion_.primitives.size();
  }

 private:
  using Count = std::array<std::int32_t, 3>;

  static Count voxels_along(const Vec3d& extent, double edge) {
    constexpr double rounding_share = 0x1p-20;  // if voxels fail to cover it by at most this share, they become larger, not more
    Count count{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      count[axis] = std::max(1, static_cast<std::int32_t>(std::ceil(extent[axis] / edge - rounding_share)));
    }
    return count;
  }
  static double product(const Count& count) { return static_cast<double>(count[0]) * count[1] * count[2]; }

  /// Creates as many voxels as the rule says for the scene's objects, or slightly fewer, at least one. They cover the scene's
  /// part of the grid, and extend beyond it by less than a voxel.
  void cut_into_voxels() {
    const VoxelRule& rule = options().voxels;
    expect(rule.voxels_per_primitive > 0 && rule.voxels_max > 0 && rule.voxels_max <= VoxelRule::voxels_bound,
           "a rule makes some voxels, and no more than a directory has room for");
    const Vec3d all = grid_high(frame()) - frame().low;
    Vec3d extent = all;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent[axis] = used()[axis] > 0 ? std::min(extent[axis], used()[axis]) : extent[axis];
    }
    const double wanted = static_cast<double>(object_count()) * rule.voxels_per_primitive;
    const double most = std::clamp(wanted, 1.0, static_cast<double>(rule.voxels_max));
    double edge = exponential(natural_log(extent.x * extent.y * extent.z / most) / 3);  // the cube root
    Count count = voxels_along(extent, edge);
    while (product(count) > most) {
      edge *= 1 + 0x1p-8;
      count = voxels_along(extent, edge);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      edge = std::max(edge, extent[axis] / count[axis]);
      header().frame.resolution[axis] = count[axis] * cells_per_macro;
    }
    header().frame.eye_extent = all;
    header().frame.finest_cell = rounded_up(edge / finest_per_macro);
  }
};

}  // namespace

std::unique_ptr<DatabaseBuilder> DatabaseBuilder::of(Input input) {
  switch (input.options.structure) {
    case Structure::grid:
      return std::make_unique<GridBuilder>(std::move(input));
    case Structure::extents:
      break;
    case Structure::voxels:
      return std::make_unique<VoxelBuilder>(std::move(input));
  }
  return input.options.keeps_instances ? std::unique_ptr<DatabaseBuilder>(std::make_unique<InstancedBuilder>(std::move(input)))
                                       : std::make_unique<TreeBuilder>(std::move(input));
}

}  // namespace dmpc::core
