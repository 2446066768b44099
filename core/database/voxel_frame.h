// A frame whose top cells are voxels.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/database/voxel_rule.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The frame of a plain grid that begins where `frame` does and is `extent` long, grid-local, or longer by less than a voxel; it
/// keeps local zero and where far eyes' rays start, so that the picture keeps its bits. There are as many voxels as the rule says
/// for so many primitives, or a few less, at least one.
GridFrame with_voxels(const GridFrame& frame, const Vec3d& extent, std::size_t primitive_count, const VoxelRule& rule);

}  // namespace dmpc::core
