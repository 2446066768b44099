#include "core/database/extract.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/address_map.h"
#include "core/database/meshes/mesh_needs.h"
#include "core/database/record_writer.h"
#include "core/database/region_records.h"
#include "core/database/shading/texture_records.h"
#include "core/database/tree/leaf_values.h"
#include "core/record/choice_node.h"
#include "core/record/directory.h"
#include "core/record/emitter.h"
#include "core/record/sky.h"
#include "core/record/texture_layout.h"

namespace dmpc::core {
namespace {

/// Nothing depends on the page size of a part; the smallest one wastes least at the part's end.
constexpr std::size_t part_page_bytes = 512;

class Extractor {
 public:
  Extractor(const Database& database, std::span<const Region> regions, Keeps keeps)
      : whole_(database.header()),
        bytes_(database.bytes().data()),
        pad_{database.pad(), database.pad(), database.pad()},
        regions_(regions),
        writer_(part_page_bytes, keeps) {
    expect(!regions.empty(), "a part is of one region or more");
    part_.holds.resize(regions.size());
    if (whole_.has_instances != 0) {
      needs_.emplace(database);
      for (std::size_t region = 0; region < regions.size(); ++region) {
        part_.holds[region] = needs_->add(regions[region]);
      }
    }
  }

  DatabasePart extract() {
    DatabaseHeader& header = part_.header;
    header = whole_;
    header.region = regions_.front();
    const Region around = box_around_regions();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      header.directory_low[axis] = around.low[axis] / finest_per_macro * finest_per_macro;
      header.directory_size[axis] = ceil_divide(around.high[axis] - header.directory_low[axis], finest_per_macro);
    }
    header.directory = writer_.allocate_array<DirectoryEntry>(directory_entry_count(header.directory_size));
    if (whole_.has_voxels()) {
      choose_listed(around);
      header.references = writer_.allocate_array<VoxelReference>(round_up(listed_.size(), std::size_t{2}));
    }
    header.lights = copy_array<LightRecord>(whole_.lights, whole_.light_count);
    header.materials = copy_array<MaterialRecord>(whole_.materials, whole_.material_count);
    if (has_emitters(whole_)) {
      header.emitters = copy_array<EmitterRecord>(whole_.emitters, whole_.emitter_count);
      copy_array<ChoiceNode>(choice_address(whole_, 0), choice_node_count(whole_.emitter_count));
    }
    if (needs_) {
      next_instance_ = writer_.allocate_array<InstanceRecord>(needs_->place_count());
    }
    if (has_sky_picture(whole_)) {
      header.sky.choices = copy_array<ChoiceNode>(whole_.sky.choices, choice_node_count(sky_tile_count(whole_.sky)));
      header.sky.tiles = copy_array<TextureTile>(whole_.sky.tiles, sky_tile_count(whole_.sky));
    }
    if (whole_.has_voxels()) {
      copy_voxels();
    } else {
      for_each_macro_cell(header.directory_low, around.high, false, [&](const Corner& cell) { copy_macro_cell(cell); });
    }
    copy_textures();
    part_.record_bytes = writer_.page_bytes();
    part_.bytes = std::move(writer_).finish();
    return std::move(part_);
  }

 private:
  /// The remaining regions, by number: a part of among_, which grows and shrinks like a stack.
  struct Those {
    std::size_t first, count;
  };

  Region box_around_regions() const {
    Region box = regions_.front();
    for (const Region& region : regions_) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], region.low[axis]);
        box.high[axis] = std::max(box.high[axis], region.high[axis]);
      }
    }
    return box;
  }

  const std::byte* at(Address address) const { return bytes_ + byte_offset(address); }
  DirectoryEntry entry_at(const Corner& cell) const {
    return entry_of(whole_, cell, [this](Address address) { return at(address); });
  }

  template <class T>
  Address copy_array(Address from, std::size_t count) {
    const Address to = writer_.allocate_array<T>(count);
    if (count > 0) {
      writer_.write(to, 0, std::span(at(from), count * sizeof(T)));
    }
    return to;
  }

  /// Lists for each voxel what the regions need of it, as entries of the part's directory and references to the whole's leaves.
  void choose_listed(const Region& around) {
    const DatabaseHeader& header = part_.header;
    entries_.resize(directory_entry_count(header.directory_size));
    for_each_macro_cell(header.directory_low, around.high, true, [&](const Corner& cell) {
      const DirectoryEntry entry = entry_at(cell);
      entries_[directory_index(header, cell)] = entry.empty() ? entry : choose_from_list(entry, cell);
    });
  }

  DirectoryEntry choose_from_list(const DirectoryEntry& entry, const Corner& cell) {
    const std::size_t begin = listed_.size();
    const Those those = regions_over(cell);
    LocalRecords records({bytes_, 0});
    if (those.count > 0) {
      for_each_listed(records, whole_, entry, [&](Address leaf) {
        if (is_wanted(leaf, those)) {
          listed_.push_back(VoxelReference::to(leaf));
        }
      });
    }
    among_.clear();
    if (listed_.size() == begin) {
      return {DirectoryEntry::empty_flag};
    }
    listed_.back().bits |= VoxelReference::last_flag;
    return {static_cast<std::uint32_t>(begin)};
  }

  /// Whether a hit on a leaf may lie in one of the regions.
  bool is_wanted(Address leaf, const Those& those) {
    const Box box = bounds_of_leaf(at(leaf)).padded(pad_);
    bool is_wanted = false;
    for (std::size_t i = 0; i < those.count; ++i) {
      const std::uint32_t region = among_[those.first + i];
      if (touches_region(whole_.frame, box, regions_[region])) {
        is_wanted = part_.holds[region] = true;
      }
    }
    return is_wanted;
  }

  void copy_voxels() {
    AddressMap leaves;
    for (VoxelReference& reference : listed_) {
      const auto [copy, is_new] = leaves.find_or_add(reference.leaf());
      copy = is_new ? copy_leaf(reference.leaf(), {}, lies_in_several_voxels(reference.leaf())) : copy;
      reference.bits = (reference.bits & VoxelReference::last_flag) | static_cast<std::uint32_t>(copy);
    }
    writer_.write(part_.header.references, 0, std::as_bytes(std::span(listed_)));
    writer_.write(part_.header.directory, 0, std::as_bytes(std::span(entries_)));
  }

  /// A ray may then meet the leaf again, in the same region as in others, so it has a shared_name.
  bool lies_in_several_voxels(Address leaf) const {
    const Box box = bounds_of_leaf(at(leaf)).padded(pad_);
    const double edge = double{whole_.frame.finest_cell} * finest_per_macro;
    bool is_in_one = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = whole_.frame.low[axis];
      is_in_one = is_in_one && std::floor((box.low[axis] - low) / edge) == std::floor((box.high[axis] - low) / edge);
    }
    return !is_in_one;
  }

  void copy_macro_cell(const Corner& cell) {
    DirectoryEntry entry = entry_at(cell);
    if (!entry.empty()) {
      const Those those = regions_over(cell);
      const Address copy = those.count > 0 ? copy_bvh_node(bvh_node_at(entry.bvh_node()), those) : no_address;
      among_.clear();
      entry.bits = copy != no_address ? static_cast<std::uint32_t>(copy) : DirectoryEntry::empty_flag;
    }
    const std::uint64_t to = directory_index(part_.header, cell);
    writer_.write(directory_address(part_.header, to), directory_offset(to), entry);
  }

  Those regions_over(const Corner& cell) {
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
      if (regions_[i].overlaps(cell, finest_per_macro)) {
        among_.push_back(i);
      }
    }
    return {0, among_.size()};
  }

  /// The remaining regions that a child's box touches. Call let_go() for them before those that they were chosen from.
  Those touched(const BvhNode& bvh_node, std::size_t child, const Those& those) {
    const std::size_t first = among_.size();
    const Box box = box_of(bvh_node, child);
    for (std::size_t i = 0; i < those.count; ++i) {
      const std::uint32_t region = among_[those.first + i];
      if (touches_region(whole_.frame, box, regions_[region])) {
        among_.push_back(region);
      }
    }
    return {first, among_.size() - first};
  }
  void let_go(const Those& those) { among_.resize(those.first); }

  /// Whether a region needs a BVH node's child: a leaf whose box touches it, or a BVH node with such a leaf below.
  bool needs(const BvhNode& bvh_node, std::size_t child, const Those& those) {
    const BvhChild& link = bvh_node.child[child];
    const Those left = touched(bvh_node, child, those);
    const bool is_needed =
        left.count > 0 && (link.is_leaf() ? needs_leaf(link.address()) : needs_any_child(bvh_node_at(link.address()), left));
    let_go(left);
    return is_needed;
  }
  /// Whether a leaf whose box touches a region is needed: a leaf of instances only if one of them has something there.
  bool needs_leaf(Address leaf) const { return !needs_ || !has_places(leaf) || needed_slots(leaf) != 0; }
  bool has_places(Address leaf) const { return read<LeafHeader>(at(leaf)).kind == PrimitiveKind::instance; }
  /// One bit for each lane.
  std::uint32_t needed_slots(Address leaf) const {
    std::uint32_t needed = 0;
    for (std::size_t lane = 0; lane < read<LeafHeader>(at(leaf)).count; ++lane) {
      needed |= (needs_->has_place(instance_in(at(leaf), lane)) ? 1U : 0U) << lane;
    }
    return needed;
  }
  bool needs_any_child(const BvhNode& bvh_node, const Those& those) {
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      if (needs(bvh_node, child, those)) {
        return true;
      }
    }
    return false;
  }
  /// One bit for each child.
  std::uint32_t needed_children(const BvhNode& bvh_node, const Those& those) {
    std::uint32_t needed = 0;
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      needed |= (needs(bvh_node, child, those) ? 1U : 0U) << child;
    }
    return needed;
  }

  const BvhNode& bvh_node_at(Address address) const { return *reinterpret_cast<const BvhNode*>(at(address)); }

  /// Copies the part of a BVH node that the regions need; no_address if they need nothing.
  Address copy_bvh_node(const BvhNode& from, const Those& those) {
    const std::uint32_t needed = needed_children(from, those);
    return needed == 0 ? no_address
                       : write_bvh_node(from, needed, [&](std::size_t child) { return copy_child(from, child, those); });
  }

  /// Copies the BVH node, and the children that are needed by copy(child).
  template <class Copy>
  Address write_bvh_node(const BvhNode& from, std::uint32_t needed, const Copy& copy) {
    const Address to = writer_.allocate(sizeof(BvhNode));
    BvhNode bvh_node{.origin = from.origin, .unit = from.unit};
    for (; needed != 0; needed &= needed - 1) {
      const auto child = static_cast<std::size_t>(std::countr_zero(needed));
      const std::size_t place = bvh_node.child_count++;
      bvh_node.child[place] = copy(child);
      for (std::size_t row = 0; row < 6; ++row) {
        bvh_node.bounds[row][place] = from.bounds[row][child];
      }
    }
    writer_.write(to, 0, bvh_node);
    return to;
  }

  BvhChild copy_child(const BvhNode& from, std::size_t child, const Those& those) {
    const Address old = from.child[child].address();
    const Those left = touched(from, child, those);
    const BvhChild copy = !from.child[child].is_leaf() ? BvhChild::bvh_node(copy_bvh_node(bvh_node_at(old), left))
                          : needs_ && has_places(old)  ? BvhChild::leaf(copy_places(old))
                                                       : BvhChild::leaf(copy_leaf(old, left, is_shared(from, child, left)));
    let_go(left);
    return copy;
  }

  /// Whether a child's box lies wholly in none of the regions, so that a ray may meet it in others, too.
  bool is_shared(const BvhNode& bvh_node, std::size_t child, const Those& those) const {
    const Box box = box_of(bvh_node, child);
    const auto holds = [&](std::uint32_t region) {
      bool is_within = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        is_within = is_within && box.low[axis] > plane_at(whole_.frame, axis, regions_[region].low[axis]) &&
                    box.high[axis] < plane_at(whole_.frame, axis, regions_[region].high[axis]);
      }
      return is_within;
    };
    const auto first = among_.begin() + static_cast<std::ptrdiff_t>(those.first);
    return std::none_of(first, first + static_cast<std::ptrdiff_t>(those.count), holds);
  }

  /// Copies the needed lanes of a leaf of instances, with their meshes.
  Address copy_places(Address from) {
    const std::uint32_t needed = needed_slots(from);
    auto header = read<LeafHeader>(at(from));
    const std::size_t lanes = header.count, rows = value_count(header.kind) + 1;  // rows of boxes, and of ids
    header.count = static_cast<std::uint8_t>(std::popcount(needed));
    const Address to = writer_.allocate(leaf_bytes(header));
    writer_.write(to, 0, header);
    std::size_t place = 0;
    for (std::uint32_t left = needed; left != 0; left &= left - 1, ++place) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const auto offset = [&](std::size_t row) { return sizeof(header) + sizeof(float) * (row * header.count + place); };
      for (std::size_t row = 0; row < rows; ++row) {
        writer_.write(to, offset(row), read<std::uint32_t>(at(from) + sizeof(header) + sizeof(float) * (row * lanes + lane)));
      }
      writer_.write(to, offset(rows), copy_instance(instance_in(at(from), lane)));
    }
    part_.primitive_copies += header.count;
    return to;
  }

  Address copy_instance(Address from) {
    auto instance = read<InstanceRecord>(at(from));
    instance.root = copy_mesh(instance.root);
    const Address to = next_instance_;
    next_instance_ = advance(to, sizeof(InstanceRecord));
    writer_.write(to, 0, instance);
    return to;
  }

  /// Copies a mesh once for all of its instances.
  Address copy_mesh(Address root) {
    if (const auto [copy, is_new] = meshes_.find_or_add(root); !is_new) {
      return copy;
    }
    const Address to = copy_mesh_bvh_node(root);
    meshes_.find_or_add(root).first = to;
    return to;
  }

  Address copy_mesh_bvh_node(Address address) {
    const BvhNode& from = bvh_node_at(address);
    return write_bvh_node(from, needs_->children_of(address), [&](std::size_t child) {
      const BvhChild link = from.child[child];
      return link.is_leaf() ? BvhChild::leaf(copy_lanes(link.address(), false))
                            : BvhChild::bvh_node(copy_mesh_bvh_node(link.address()));
    });
  }

  Address copy_leaf(Address from, const Those& those, bool is_shared) {
    for (std::size_t i = 0; i < those.count; ++i) {
      part_.holds[among_[those.first + i]] = true;
    }
    part_.primitive_copies += read<LeafHeader>(at(from)).count;
    return copy_lanes(from, is_shared);
  }

  /// Copies lanes with normals and textures.
  Address copy_lanes(Address from, bool is_shared) {
    auto header = read<LeafHeader>(at(from));
    const std::size_t rows = leaf_bytes(header.kind, header.count), size = leaf_bytes(header);
    const std::size_t row = sizeof(ShadingReference) * header.count;
    std::array<ShadingReference, leaf_lanes> lanes;
    const std::span shading(lanes.data(), header.count);
    std::memcpy(lanes.data(), at(from) + rows - row, row);
    for (ShadingReference& reference : shading) {
      if (reference.is_smooth()) {
        reference = ShadingReference::smooth(copy_normals(reference.normals()));
      }
    }
    const Address to = writer_.allocate(size);
    writer_.write(to, 0, std::span(at(from), size));
    writer_.write(to, rows - row, std::as_bytes(shading));
    header.shared_name = is_shared ? static_cast<std::uint32_t>(from) + 1 : 0;
    writer_.write(to, 0, header);
    return to;
  }

  /// A triangle that lies in several BVH nodes keeps a single record of normals.
  Address copy_normals(Address from) {
    const auto [copy, is_new] = normals_.find_or_add(from);
    if (is_new) {
      copy = read<PatchNormals>(at(from)).is_textured() ? copy_textured(from) : writer_.add(read<PatchNormals>(at(from)));
    }
    return copy;
  }

  Address copy_textured(Address from) {
    auto textured = read<TexturedNormals>(at(from));
    if (textured.has_texture()) {
      textured.texture = copy_reference(textured, textured.texture);
    }
    if (textured.has_facets == 0) {
      return writer_.add(textured);
    }
    const TextureReference facets = copy_reference(textured, read<FacetedNormals>(at(from)).facets);
    return writer_.add(FacetedNormals{.textured = textured, .facets = facets});
  }

  /// Notes which tiles the triangle needs; they are copied when all of them are known.
  TextureReference copy_reference(const TexturedNormals& triangle, const TextureReference& from) {
    const auto [found, is_new] = textures_.try_emplace(static_cast<std::uint32_t>(from.tiles));
    UsedTexture& texture = found->second;
    if (is_new) {
      const std::size_t entries = tile_entry_count(from);
      texture.from = texture.to = from;
      texture.to.tiles = writer_.allocate_array<Address>(entries);
      texture.needed.resize(entries);
    }
    for_each_tile(triangle, from, [&](std::uint32_t tile) { texture.needed[tile] = true; });
    return texture.to;
  }

  /// Copies textures in the order of the whole database, which keeps neighbours together.
  void copy_textures() {
    for (const auto& [address, texture] : textures_) {
      const auto* const table = reinterpret_cast<const Address*>(at(texture.from.tiles));
      std::map<Address, std::size_t> tiles;
      for (std::size_t tile = 0; tile < texture.needed.size(); ++tile) {
        if (texture.needed[tile]) {
          tiles.emplace(table[tile], tile);
        }
      }
      std::vector<Address> copies(texture.needed.size(), no_address);
      for (const auto& [from, tile] : tiles) {
        copies[tile] = writer_.add(read<TextureTile>(at(from)));
      }
      writer_.write(texture.to.tiles, 0, std::as_bytes(std::span(copies)));
    }
  }

  /// A texture that the regions' triangles show.
  struct UsedTexture {
    TextureReference from, to;
    std::vector<bool> needed;  ///< tiles
  };

  const DatabaseHeader& whole_;
  const std::byte* bytes_;
  Vec3d pad_;  ///< the maximum distance of a hit from its primitive
  std::span<const Region> regions_;
  std::vector<std::uint32_t> among_;
  RecordWriter writer_;
  DatabasePart part_;
  std::vector<DirectoryEntry> entries_;  ///< of the voxels
  std::vector<VoxelReference> listed_;   ///< by the voxels
  std::optional<MeshNeeds> needs_;       ///< where base meshes are stored
  Address next_instance_ = no_address;   ///< for the next copied instance
  AddressMap meshes_;                    ///< by the mesh's first BVH node
  AddressMap normals_;
  std::map<std::uint32_t, UsedTexture> textures_;  ///< by the old address of their tables
};

}  // namespace

DatabasePart extract(const Database& database, std::span<const Region> regions) {
  return Extractor(database, regions, Keeps::records).extract();
}

DatabasePart measure_part(const Database& database, std::span<const Region> regions) {
  return Extractor(database, regions, Keeps::nothing).extract();
}

}  // namespace dmpc::core
