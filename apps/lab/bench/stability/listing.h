// Lists the primitives against which a ray through a point may be tested, by reading the records independently of the traversal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/database/database.h"
#include "core/record/directory.h"
#include "core/record/records.h"

namespace dmpc::apps {

/// Reads a database's records by address, as a node would.
class Listing {
 public:
  explicit Listing(const core::Database& database) : database_(&database) {}

  /// Returns the ids in the leaves whose boxes, and those of all BVH nodes above them, contain the local point `at`; empty
  /// outside the grid.
  std::vector<std::uint32_t> around(const core::Vec3d& at) const {
    std::array<std::int32_t, 3> cell{};
    const core::GridFrame& frame = database_->header().frame;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor((at[axis] - core::plane_at(frame, axis, 0)) / double{frame.finest_cell});
      if (!(place >= 0 && place < frame.resolution[axis] * core::finest_per_cell)) {
        return {};
      }
      cell[axis] = static_cast<std::int32_t>(place);
    }
    const std::uint64_t index = core::directory_index(database_->header(), cell);
    const auto entry = core::read<core::DirectoryEntry>(record(core::directory_address(database_->header(), index)) +
                                                        core::directory_offset(index));
    std::vector<std::uint32_t> ids;
    if (!entry.empty() && database_->header().has_voxels()) {
      core::LocalRecords records(database_->bytes());
      core::for_each_listed(records, database_->header(), entry, [&](core::Address leaf) { append(leaf, ids); });
    } else if (!entry.empty()) {
      collect(entry.bvh_node(), at, ids);
    }
    return ids;
  }

  bool lists(const core::Vec3d& at, std::uint32_t id) const {
    const auto ids = around(at);
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }

 private:
  const std::byte* record(core::Address address) const { return database_->bytes().data() + core::byte_offset(address); }

  void collect(core::Address address, const core::Vec3d& at, std::vector<std::uint32_t>& ids) const {
    const auto bvh_node = core::read<core::BvhNode>(record(address));
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      if (!holds(bvh_node, child, at)) {
        continue;
      }
      if (bvh_node.child[child].is_leaf()) {
        append(bvh_node.child[child].address(), ids);
      } else {
        collect(bvh_node.child[child].address(), at, ids);
      }
    }
  }

  static bool holds(const core::BvhNode& bvh_node, std::size_t child, const core::Vec3d& at) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = (at[axis] - double{bvh_node.origin[axis]}) / double{bvh_node.unit};
      inside = inside && place >= bvh_node.bounds[axis][child] && place <= bvh_node.bounds[axis + 3][child];
    }
    return inside;
  }

  void append(core::Address leaf, std::vector<std::uint32_t>& ids) const {
    const auto header = core::read<core::LeafHeader>(record(leaf));
    const std::byte* first = core::ids_of(header, record(leaf));
    for (std::size_t lane = 0; lane < header.count; ++lane) {
      ids.push_back(core::read<std::uint32_t>(first + 4 * lane));
    }
  }

  const core::Database* database_;
};

}  // namespace dmpc::apps
