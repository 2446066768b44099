// Which primitives a finest voxel lists: the records read back, independently of the walk.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/database.h"
#include "core/directory.h"

namespace dmpc::apps {

/// Reads a database's records by address, as a node would.
class Listing {
 public:
  explicit Listing(const core::Database& database) : database_(&database) {}

  /// Ids in the blocks that a ray in the voxel around the local point `at` is tested against; empty outside the grid.
  std::vector<std::uint32_t> around(const core::Vec3d& at) const {
    std::array<std::int32_t, 3> cell{};
    const core::GridFrame& frame = database_->header().frame;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor(at[axis] / double{frame.finest_cell});
      if (!(place >= 0 && place < frame.resolution[axis] * core::finest_per_top)) {
        return {};
      }
      cell[axis] = static_cast<std::int32_t>(place);
    }
    const auto entry = core::directory_entry(record(core::directory_address(database_->header(), cell)), cell);
    std::vector<std::uint32_t> ids;
    if (!entry.empty()) {
      collect(entry.brick(), cell, 1, ids);
    }
    return ids;
  }

  bool lists(const core::Vec3d& at, std::uint32_t id) const {
    const auto ids = around(at);
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }

 private:
  const std::byte* record(core::Address address) const { return database_->bytes().data() + core::byte_offset(address); }

  void collect(core::Address address, const std::array<std::int32_t, 3>& cell, int level, std::vector<std::uint32_t>& ids) const {
    const auto brick = core::read<core::Brick>(record(address));
    std::uint64_t bit = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      bit = bit * 4 + static_cast<std::uint64_t>(cell[axis] / core::span_of(level) % 4);
    }
    const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
    const std::byte* links = record(address) + sizeof(core::Brick);
    const std::size_t link_count = brick.block_count + static_cast<std::size_t>(std::popcount(brick.nested));
    if ((brick.nested >> bit & 1U) != 0) {
      const std::size_t child = brick.block_count + static_cast<std::size_t>(std::popcount(brick.nested & below));
      collect(core::read<core::Address>(links + 4 * child), cell, level + 1, ids);
    } else if ((brick.occupied >> bit & 1U) != 0) {
      const auto place = static_cast<std::size_t>(std::popcount(brick.occupied & ~brick.nested & below));
      const auto mask = core::read<std::uint8_t>(links + 4 * link_count + place);
      for (std::size_t block = 0; block < brick.block_count; ++block) {
        if ((mask >> block & 1U) != 0) {
          append(core::read<core::Address>(links + 4 * block), ids);
        }
      }
    }
    if (brick.next_sheet != core::no_address && (brick.nested >> bit & 1U) == 0) {
      collect(brick.next_sheet, cell, level, ids);
    }
  }

  void append(core::Address block, std::vector<std::uint32_t>& ids) const {
    const auto header = core::read<core::BlockHeader>(record(block));
    const std::byte* first = record(block) + sizeof(header) + 4 * core::value_count(header.kind) * header.count;
    for (std::size_t lane = 0; lane < header.count; ++lane) {
      ids.push_back(core::read<std::uint32_t>(first + 4 * lane));
    }
  }

  const core::Database* database_;
};

}  // namespace dmpc::apps
