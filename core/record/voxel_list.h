// The list of a voxel, read from end to end.
#pragma once

#include <cstdint>

#include "core/record/directory.h"
#include "core/record/record.h"
#include "core/record/records.h"

namespace dmpc::core {

/// Calls visit(block's address) for all that the list of an occupied voxel names, whose records are here. Requires
/// header.has_voxels().
template <Records R, class Visit>
void for_each_listed(R& records, const DatabaseHeader& header, const DirectoryEntry& voxel, const Visit& visit) {
  for (std::uint64_t index = voxel.bits;; ++index) {
    const auto reference = read<VoxelReference>(records.find(reference_address(header, index)) + reference_offset(index));
    visit(reference.block());
    if (reference.is_last()) {
      return;
    }
  }
}

}  // namespace dmpc::core
