// A leaf of a base mesh placed in the grid by an instance: what its copy's leaf would hold, with the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/record/records.h"
#include "core/scene/placing.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// Places a mesh's records by an instance. Keeps a reference to `frame`, which outlives it.
class PlacedMesh {
 public:
  PlacedMesh(const InstanceRecord& instance, const GridFrame& frame);
  PlacedMesh(const PlacedMesh&) = delete;
  PlacedMesh& operator=(const PlacedMesh&) = delete;

  bool is_mirrored() const { return is_mirrored_; }
  const Placing& placing() const { return placing_; }
  double unit() const { return unit_; }
  std::uint32_t first() const { return first_; }
  /// Normals of a triangle's corners, in the copy's order of corners.
  std::array<Vec3f, 3> normals(const std::array<Vec3f, 3>& of_mesh) const;

 private:
  Transform world_, world_normals_;
  Placing placing_;
  double unit_;
  std::uint32_t first_;
  bool is_mirrored_;
};

class PlacedLeaf {
 public:
  /// `record`: a leaf of the mesh. Returns its number of triangles.
  std::uint32_t place(const std::byte* record, const PlacedMesh& place);
  const std::byte* record() const { return record_.data(); }
  /// Whether the copy has no such triangle, because it is degenerate after rounding.
  bool has_vanished(std::uint32_t lane) const;
  /// Replaces degenerate triangles by ones that no ray hits.
  void take_vanished_away();

 private:
  void place_corners(const float* rows, std::size_t count, const PlacedMesh& place);
  void place_plane(const std::byte* record, const PlacedMesh& place);

  alignas(8) std::array<std::byte, record_bytes_max + overread_bytes> record_;
};

}  // namespace dmpc::core
