// The proxy of a database: its directory and topmost BVH nodes, small enough for every node to have.
#pragma once

#include <cstddef>

#include "core/database/extract.h"

namespace dmpc::core {

/// The maximum size of a proxy: enough for twice the topmost BVH nodes of a large scene, and for some levels of a small one.
std::size_t proxy_bytes_max(const Database& database);

/// Copies the directory and as many BVH nodes as `bytes_max` allow, level by level; for base meshes it creates BVH nodes with
/// boxes for each instance. Children that are not copied become leaves, which cannot be read: a ray that meets one may hit
/// something there, a ray that meets none hits nothing. Without a directory (no_address), and empty, if the topmost BVH nodes do
/// not fit. For voxels it has the directory, without lists: if that does not fit, one of cubes of 2^n voxels along each axis
/// (DatabaseHeader::directory_doublings), from the grid's lower corner.
DatabasePart proxy_of(const Database& database, std::size_t bytes_max);

}  // namespace dmpc::core
