// What of the meshes that are kept once some regions need: of each what any of its places brings there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include "core/base/region.h"
#include "core/database/database.h"
#include "core/database/placed_boxes.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A mark for each mesh's brick that is needed, whatever the number of its places. The database outlives it. Thread safety: none.
class MeshNeeds {
 public:
  explicit MeshNeeds(const Database& database) : header_(database.header()), bytes_(database.bytes().data()) {}

  /// Adds what rays in a region may ask for of meshes, by their places' boxes. Says whether that is anything.
  bool add(const Region& region);

  /// Of the InstanceRecord at an address, whether its mesh has something in one of the regions.
  bool has_place(Address instance) const { return places_.contains(static_cast<std::uint32_t>(instance)); }
  std::size_t place_count() const { return places_.size(); }
  /// A bit for each child of a mesh's brick that some region needs.
  std::uint32_t children_of(Address brick) const {
    const auto found = marks_.find(static_cast<std::uint32_t>(brick));
    return found == marks_.end() ? 0 : found->second.children;
  }

 private:
  struct Mark {
    std::uint32_t children = 0;
    bool is_whole = false;  ///< all that is below is needed
  };

  const std::byte* at(Address address) const { return bytes_ + byte_offset(address); }
  const Brick& brick_at(Address address) const { return *reinterpret_cast<const Brick*>(at(address)); }
  Mark& mark_of(Address brick) { return marks_[static_cast<std::uint32_t>(brick)]; }
  bool add_below(const Brick& brick, const Region& region);
  bool add_places(const std::byte* block, const Region& region);
  void add_whole(Address brick);
  bool add_part(Address brick, const PlacedBoxes& boxes, const Region& region);

  const DatabaseHeader& header_;
  const std::byte* bytes_;
  std::unordered_map<std::uint32_t, Mark> marks_;  ///< by brick
  std::unordered_set<std::uint32_t> places_;       ///< addresses of instances
};

}  // namespace dmpc::core
