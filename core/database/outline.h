// The outline of a database: its directory and topmost bricks, small enough for every node to have.
#pragma once

#include <cstddef>

#include "core/database/extract.h"

namespace dmpc::core {

/// How large an outline may be: room for twice the topmost bricks of a large scene, and for some levels of a small one.
std::size_t outline_bytes_max(const Database& database);

/// Copies the directory and as many bricks as `bytes_max` hold, level by level; of meshes that are kept once it makes bricks with
/// boxes where each place has them. Children that are not copied stand as blocks, of which nothing can be read: whoever meets one
/// knows that something may be there, whoever meets none that nothing is. Without a directory (no_address), and nothing else, if
/// the topmost bricks do not fit. Of voxels it has the directory, without lists: if that does not fit, one of cubes of 2^n voxels
/// along each axis (DatabaseHeader::directory_doublings), from where the grid begins.
DatabasePart outline_of(const Database& database, std::size_t bytes_max);

}  // namespace dmpc::core
