// The memory that a mesh file takes, and the maximum of triangles in a database.
#pragma once

#include <cstdint>
#include <string>

namespace dmpc::apps {

/// Estimated memory in bytes of dmpc and the file's reader together until the database is built, from the size of the file and
/// its format ("OBJ"): half to twice as much for triangles that share vertices. 0 for formats whose meshes are in other files.
std::uint64_t estimated_reading_bytes(const std::string& format, std::uint64_t file_bytes);

/// Throws core::CapacityError, with both figures, if a database of this many triangles does not fit.
void check_database(std::uint64_t triangles);

}  // namespace dmpc::apps
