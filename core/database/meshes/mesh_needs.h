// The parts of base meshes that some regions need: for each mesh what any of its instances needs there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include "core/base/region.h"
#include "core/database/database.h"
#include "core/database/meshes/placed_boxes.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A mark for each mesh's BVH node that is needed, for any number of instances. The database outlives it. Not thread-safe.
class MeshNeeds {
 public:
  explicit MeshNeeds(const Database& database) : header_(database.header()), bytes_(database.bytes().data()) {}

  /// Adds what rays in a region may need of meshes, by their instances' boxes. Returns whether that is anything.
  bool add(const Region& region);

  /// Whether the mesh of the InstanceRecord at an address has something in one of the regions.
  bool has_place(Address instance) const { return instances_.contains(static_cast<std::uint32_t>(instance)); }
  std::size_t place_count() const { return instances_.size(); }
  /// A bit for each child of a mesh's BVH node that some region needs.
  std::uint32_t children_of(Address bvh_node) const {
    const auto found = marks_.find(static_cast<std::uint32_t>(bvh_node));
    return found == marks_.end() ? 0 : found->second.children;
  }

 private:
  struct Mark {
    std::uint32_t children = 0;
    bool is_whole = false;  ///< everything below is needed
  };

  const std::byte* at(Address address) const { return bytes_ + byte_offset(address); }
  const BvhNode& bvh_node_at(Address address) const { return *reinterpret_cast<const BvhNode*>(at(address)); }
  Mark& mark_of(Address bvh_node) { return marks_[static_cast<std::uint32_t>(bvh_node)]; }
  bool add_below(const BvhNode& bvh_node, const Region& region);
  bool add_slots(const std::byte* leaf, const Region& region);
  void add_whole(Address bvh_node);
  bool add_part(Address bvh_node, const PlacedBoxes& boxes, const Region& region);

  const DatabaseHeader& header_;
  const std::byte* bytes_;
  std::unordered_map<std::uint32_t, Mark> marks_;  ///< by BVH node
  std::unordered_set<std::uint32_t> instances_;    ///< addresses of instances
};

}  // namespace dmpc::core
