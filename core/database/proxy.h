// The proxy of a database: its directory and topmost BVH nodes, small enough for every node to have.
#pragma once

#include <cstddef>

#include "core/database/extract.h"

namespace dmpc::core {

/// How large a proxy may be: room for twice the topmost BVH nodes of a large scene, and for some levels of a small one.
std::size_t proxy_bytes_max(const Database& database);

/// Copies the directory and as many BVH nodes as `bytes_max` hold, level by level; of base meshes it makes BVH nodes with
/// boxes where each place has them. Children that are not copied stand as leaves, of which nothing can be read: whoever meets one
/// knows that something may be there, whoever meets none that nothing is. Without a directory (no_address), and nothing else, if
/// the topmost BVH nodes do not fit. Of voxels it has the directory, without lists: if that does not fit, one of cubes of 2^n
/// voxels along each axis (DatabaseHeader::directory_doublings), from where the grid begins.
DatabasePart proxy_of(const Database& database, std::size_t bytes_max);

}  // namespace dmpc::core
