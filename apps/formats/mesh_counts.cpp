#include "apps/formats/mesh_counts.h"

#include <algorithm>
#include <array>

#include "apps/edge/line/number_text.h"
#include "apps/formats/scene_blocks.h"
#include "core/base/expect.h"
#include "core/base/vec.h"
#include "core/database/record_writer.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr std::uint64_t index_bytes = sizeof(std::uint32_t);
/// Measured with sheets of one to four million triangles, in November 2026: 65 to 95.
constexpr std::uint64_t building_bytes_a_triangle = 100;

/// As apps/foreign/mesh/polygon_mesh.h has them.
std::uint64_t mesh_bytes(const MeshCounts& counts) {
  const std::uint64_t corner = index_bytes + (counts.has_normals ? sizeof(Vec3d) : 0) +
                               (counts.has_places ? sizeof(std::array<float, 2>) : 0) +
                               (counts.has_colors ? sizeof(Vec3d) + sizeof(double) : 0);
  return sizeof(Vec3d) * counts.vertices + corner * counts.corners + index_bytes * counts.faces;
}

/// Beside a corner's place in the world.
std::uint64_t shading_bytes(const MeshCounts& counts) {
  const bool is_textured = counts.has_places || counts.has_colors;
  return (is_textured ? sizeof(core::TexturedCorner) : counts.has_normals ? sizeof(Vec3d) : 0) * counts.corners;
}

/// Of the longest list of the scene, if it is longer than what is believed of it, and so copied on its way.
std::uint64_t longest_copy(const MeshCounts& counts, std::uint64_t shading) {
  const std::uint64_t longest = std::max({sizeof(core::Object) * counts.faces, sizeof(Vec3d) * counts.corners, shading});
  return longest > believed_bytes_max ? longest : 0;
}

/// What apps/foreign/mesh/smooth.h works on: each vertex's point, its place in order and neighbours, or sum; each face's area.
std::uint64_t smoothing_bytes(const MeshCounts& counts) {
  return (sizeof(Vec3d) + 5 * index_bytes) * counts.vertices + sizeof(Vec3d) * counts.faces + index_bytes * counts.corners;
}

}  // namespace

Packer pack(const MeshCounts& counts) {
  Packer fields;
  for (const std::uint64_t count :
       {counts.vertices, counts.faces, counts.corners, counts.triangles_min, counts.read_bytes, counts.kept_bytes}) {
    fields.add(count);
  }
  for (const bool flag : {counts.has_normals, counts.has_places, counts.has_colors, counts.has_instances}) {
    fields.add(static_cast<std::uint8_t>(flag));
  }
  return fields;
}

MeshCounts take_mesh_counts(Unpacker fields) {
  constexpr std::uint64_t most = std::uint64_t{1} << 48U;  // so that no sum of theirs overflows
  MeshCounts counts;
  for (std::uint64_t* const count :
       {&counts.vertices, &counts.faces, &counts.corners, &counts.triangles_min, &counts.read_bytes, &counts.kept_bytes}) {
    *count = std::min(fields.take<std::uint64_t>(), most);
  }
  for (bool* const flag : {&counts.has_normals, &counts.has_places, &counts.has_colors, &counts.has_instances}) {
    *flag = fields.take_flag();
  }
  fields.finish();
  return counts;
}

std::uint64_t ReadingForecast::peak_bytes() const { return std::max({reader_bytes, transfer_bytes, building_bytes}); }

ReadingForecast forecast_of(const MeshCounts& told, bool smooth) {
  MeshCounts counts = told;
  counts.has_normals = counts.has_normals || smooth;
  const std::uint64_t mesh = mesh_bytes(counts), shading = shading_bytes(counts);
  const std::uint64_t objects = sizeof(core::Object) * counts.faces, points = sizeof(Vec3d) * counts.vertices;
  const std::uint64_t scene = objects + sizeof(Vec3d) * counts.corners + shading;
  // A list that is full is copied into a longer one; a reader has points and indices in place of a scene's vertices.
  const std::uint64_t growing = shading + points + index_bytes * counts.corners;
  const std::uint64_t placing = counts.kept_bytes + mesh + objects + shading + growing + (smooth ? smoothing_bytes(counts) : 0);
  // What stands where it is moves to make room for instances, one pool at a time.
  const std::uint64_t moved = counts.has_instances ? std::max(sizeof(Vec3d) * counts.corners, shading) : 0;
  const std::uint64_t triangles = counts.corners - std::min(counts.corners, 2 * counts.faces);
  return {.reader_bytes = std::max(counts.read_bytes + mesh, placing),
          .transfer_bytes = scene + std::max(points + longest_copy(counts, shading), moved),
          .building_bytes = scene + building_bytes_a_triangle * triangles};
}

void check_database(std::uint64_t triangles) {
  constexpr std::uint64_t values = core::value_count(core::PrimitiveKind::triangle);
  constexpr std::uint64_t bytes = values * sizeof(float) + 2 * sizeof(std::uint32_t);  // a block's id and reference beside them
  constexpr double gibibyte = 0x1p30;
  if (triangles > core::RecordWriter::bytes_max / bytes) {
    throw core::RoomError(
        "its " + grouped(triangles) + " triangles need a database of at least " +
        fixed(static_cast<double>(triangles * bytes) / gibibyte, 1) + " GiB, and one has " +
        fixed(static_cast<double>(core::RecordWriter::bytes_max) / gibibyte, 0) +
        " GiB at most: divide the scene, make it coarser, or, if its meshes stand in many places, have dmpc render "
        "keep each once (--instances=keep)");
  }
}

}  // namespace dmpc::apps
