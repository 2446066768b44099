// What a mesh file says that it has, before it is read, and what it takes to read it.
#pragma once

#include <cstdint>

#include "apps/reader/packing.h"

namespace dmpc::apps {

/// Each at most, but for triangles_min.
struct MeshCounts {
  std::uint64_t vertices = 0, faces = 0, corners = 0;
  bool has_normals = false, has_places = false, has_colors = false;  ///< of corners
  bool has_instances = false;                                        ///< some mesh stands in several places, all of which count
  std::uint64_t triangles_min = 0;  ///< at least, but for those without an area, which a database leaves out
  std::uint64_t read_bytes = 0;     ///< beside the meshes while the file is read: its own bytes, and what is made of them first
  std::uint64_t kept_bytes = 0;     ///< beside the meshes until the scene is made
};

/// As fields of a message, and back.
Packer pack(const MeshCounts& counts);
MeshCounts take_mesh_counts(Unpacker fields);

/// Bytes of memory, beside what the programs take without a file.
struct ReadingForecast {
  std::uint64_t reader_bytes = 0;  ///< at most, of the process that reads
  /// At most, of both while dmpc gets the scene, which the one gives back as the other gets it.
  std::uint64_t transfer_bytes = 0;
  /// A guess: of dmpc while it builds the database, of faces that are small beside the scene; long ones take more.
  std::uint64_t building_bytes = 0;
  /// Of both together, until the database is there.
  std::uint64_t peak_bytes() const;
};
/// `smooth`: normals are reckoned anew, for each corner.
ReadingForecast forecast_of(const MeshCounts& counts, bool smooth = false);

/// Throws core::RoomError, with both figures, if so many triangles cannot have a database.
void check_database(std::uint64_t triangles);

}  // namespace dmpc::apps
