#include "core/database/proxy.h"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/box.h"
#include "core/base/units.h"
#include "core/database/grid/empty_space.h"
#include "core/database/meshes/placed_boxes.h"
#include "core/database/record_writer.h"
#include "core/database/tree/bvh_builder.h"
#include "core/record/directory.h"

namespace dmpc::core {
namespace {

/// Nothing depends on the page size of a proxy; the smallest one wastes least.
constexpr std::size_t proxy_page_bytes = 512;
/// On 64 nodes and 512x512 pixels, rays of four scenes took 0.68 of the processor time with 4 KiB of proxy that they took
/// without, 0.65 with 16 KiB, and 0.64 with 64 KiB.
constexpr std::size_t small_proxy_bytes = 16_KiB;
/// A topmost BVH node represents some 4,096 primitives: about a 4,096th of the database.
constexpr std::size_t database_share = 2048;

/// Copies BVH nodes breadth first. With base meshes, the BVH nodes of each instance are transformed to where it stands.
class Outliner {
 public:
  Outliner(const Database& database, std::size_t bytes_max)
      : whole_(database.header()), bytes_(database.bytes().data()), bytes_max_(bytes_max), writer_(proxy_page_bytes) {}

  /// None if the topmost BVH nodes do not fit.
  std::optional<DatabasePart> proxy() {
    DatabasePart part{.header = whole_};
    if (!copy_directory(part.header)) {
      return std::nullopt;
    }
    for (; !waiting_.empty(); waiting_.pop_front()) {
      const Waiting next = waiting_.front();
      const bool is_in_place = next.from.is_leaf() || next.instance != no_address;
      writer_.write(next.to, 0, is_in_place ? bvh_node_in_place(next) : copy_of_bvh_node(next));
    }
    part.record_bytes = writer_.page_bytes();
    part.bytes = std::move(writer_).finish();
    return part;
  }

 private:
  /// A BVH node or leaf that is to be copied.
  struct Waiting {
    BvhChild from;     ///< a BVH node, or a leaf of instances
    Address instance;  ///< the instance that contains a mesh's BVH node; no_address: none
    Address to;        ///< address of the proxy's BVH node
    int level;         ///< number of BVH nodes down to this one
  };

  const std::byte* at(Address address) const { return bytes_ + byte_offset(address); }
  const BvhNode& bvh_node_at(Address address) const { return *reinterpret_cast<const BvhNode*>(at(address)); }

  /// Whether one more BVH node fits, with the last page filled up.
  bool has_room() const { return writer_.page_bytes_with(sizeof(BvhNode)) <= bytes_max_; }

  /// Allocates a BVH node, which is written when its turn comes.
  Address wait_for(BvhChild from, Address instance, int level) {
    const Address to = writer_.allocate(sizeof(BvhNode));
    waiting_.push_back({from, instance, to, level});
    return to;
  }

  /// False if it does not fit together with the BVH nodes that it refers to.
  bool copy_directory(DatabaseHeader& header) {
    const std::uint64_t count = directory_entry_count(whole_.directory_size);
    bool fits = count * sizeof(DirectoryEntry) <= bytes_max_;
    header.directory = fits ? writer_.allocate_array<DirectoryEntry>(count) : no_address;
    for (std::uint64_t index = 0; index < count && fits; ++index) {
      auto entry = read<DirectoryEntry>(at(directory_address(whole_, index)) + directory_offset(index));
      fits = entry.empty() || has_room();
      if (!entry.empty() && fits) {
        entry.bits = static_cast<std::uint32_t>(wait_for(BvhChild::bvh_node(entry.bvh_node()), no_address, 1));
      }
      writer_.write(directory_address(header, index), directory_offset(index), entry);
    }
    return fits;
  }

  /// The proxy's child for one of the whole: a BVH node if it adds information, if it fits, and if rays can reach it, whose stack
  /// of waiting children has as many slots as a tree has levels.
  BvhChild child_for(BvhChild whole, Address instance, int level) {
    const bool has_boxes = !whole.is_leaf() || (whole_.has_instances != 0 && instance == no_address &&
                                                read<LeafHeader>(at(whole.address())).kind == PrimitiveKind::instance);
    return has_boxes && level < bvh_levels_max && has_room() ? BvhChild::bvh_node(wait_for(whole, instance, level + 1))
                                                             : BvhChild::leaf(Address{0});
  }

  BvhNode copy_of_bvh_node(const Waiting& next) {
    auto bvh_node = read<BvhNode>(at(next.from.address()));
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      bvh_node.child[child] = child_for(bvh_node.child[child], no_address, next.level);
    }
    return bvh_node;
  }

  /// For instances, or for a mesh's BVH node in an instance.
  BvhNode bvh_node_in_place(const Waiting& next) {
    const std::byte* const record = at(next.from.address());
    std::array<Bounds, bvh_children_max> boxes;
    std::array<BvhChild, bvh_children_max> children;
    std::size_t count = 0;
    if (next.from.is_leaf()) {
      for (; count < read<LeafHeader>(record).count; ++count) {
        const Address instance = instance_in(record, count);
        boxes[count] = Bounds::around(instance_box(record, count));
        children[count] = child_for(BvhChild::bvh_node(read<InstanceRecord>(at(instance)).root), instance, next.level);
      }
    } else {
      const BvhNode& bvh_node = bvh_node_at(next.from.address());
      const PlacedBoxes placed(read<InstanceRecord>(at(next.instance)), whole_.frame);
      for (; count < bvh_node.child_count; ++count) {
        boxes[count] = Bounds::around(placed.box_of(bvh_node, count));
        children[count] = child_for(bvh_node.child[count], next.instance, next.level);
      }
    }
    return bvh_node_of(std::span(boxes).first(count), children);
  }

  static BvhNode bvh_node_of(std::span<const Bounds> boxes, const std::array<BvhChild, bvh_children_max>& children) {
    Bounds around;
    for (const Bounds& box : boxes) {
      around.include(box);
    }
    BvhNode bvh_node = bvh_node_over(around, 0);
    for (std::size_t child = 0; child < boxes.size(); ++child) {
      add_child(bvh_node, boxes[child], 0);
    }
    bvh_node.child = children;
    return bvh_node;
  }

  const DatabaseHeader& whole_;
  const std::byte* bytes_;
  std::size_t bytes_max_;
  RecordWriter writer_;
  std::deque<Waiting> waiting_;
};

/// The voxels that have lists, or cubes of as many voxels as it takes for the directory to fit.
class VoxelOutliner {
 public:
  explicit VoxelOutliner(const Database& database) : whole_(database.header()), records_(database.bytes()) {}

  DatabasePart proxy(std::size_t bytes_max) const {
    DatabasePart part{.header = whole_};
    DatabaseHeader& header = part.header;
    while (bytes_of(header) > bytes_max) {
      ++header.directory_doublings;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        header.directory_size[axis] = ceil_divide(header.directory_size[axis], 2);
      }
    }
    const std::vector<DirectoryEntry> entries = entries_of(header);
    RecordWriter writer(proxy_page_bytes);
    header.directory = writer.allocate_array<DirectoryEntry>(entries.size());
    writer.write(header.directory, 0, std::as_bytes(std::span(entries)));
    part.record_bytes = writer.page_bytes();
    part.bytes = std::move(writer).finish();
    return part;
  }

 private:
  static std::size_t bytes_of(const DatabaseHeader& header) {
    return round_up(directory_entry_count(header.directory_size) * sizeof(DirectoryEntry), proxy_page_bytes);
  }

  std::vector<DirectoryEntry> entries_of(const DatabaseHeader& header) const {
    std::vector<DirectoryEntry> entries(directory_entry_count(header.directory_size));
    for_each_macro_cell({}, grid_size(whole_.frame), true, [&](const Corner& cell) {
      if (!entry_of(whole_, cell, [this](Address address) { return records_.find(address); }).empty()) {
        entries[directory_index(header, doubled(cell, header.directory_doublings))].bits = 0;
      }
    });
    const auto& size = header.directory_size;
    measure_empty_space({size[2], size[1], size[0]}, entries);
    return entries;
  }

  const DatabaseHeader& whole_;
  LocalRecords records_;
};

DatabasePart nothing_of(const Database& database) {
  DatabasePart part{.header = database.header(), .bytes = RecordWriter(proxy_page_bytes).finish()};
  part.header.directory = no_address;
  return part;
}

}  // namespace

std::size_t proxy_bytes_max(const Database& database) {
  return std::max(small_proxy_bytes, database.bytes().size() / database_share);
}

DatabasePart proxy_of(const Database& database, std::size_t bytes_max) {
  if (database.header().has_voxels() && bytes_max >= proxy_page_bytes) {
    return VoxelOutliner(database).proxy(bytes_max);
  }
  const std::optional<DatabasePart> proxy = Outliner(database, bytes_max).proxy();
  return proxy ? *proxy : nothing_of(database);
}

}  // namespace dmpc::core
