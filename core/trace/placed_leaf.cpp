#include "core/trace/placed_leaf.h"

#include <cstring>
#include <optional>

#include "core/base/vector_width.h"
#include "core/record/coordinate.h"
#include "core/record/record.h"
#include "core/scene/frame.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

using Rows = std::array<std::array<float, leaf_lanes>, 9>;

}  // namespace

PlacedMesh::PlacedMesh(const InstanceRecord& instance, const GridFrame& frame)
    : world_(transform_of(instance)),
      world_normals_(world_.of_normals()),
      placing_(world_, frame),
      unit_(double{instance.unit}),
      first_(instance.first),
      is_mirrored_(placing_.is_mirrored()) {}

std::array<Vec3f, 3> PlacedMesh::normals(const std::array<Vec3f, 3>& of_mesh) const {
  std::array<Vec3f, 3> placed;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& normal = Vec3d(of_mesh[is_mirrored_ ? 2 - i : i]);
    placed[i] = unit_normal(world_normals_.direction(normal));
  }
  return placed;
}

std::uint32_t PlacedLeaf::place(const std::byte* record, const PlacedMesh& place) {
  const auto header = read<LeafHeader>(record);
  const std::size_t count = header.count;
  std::memcpy(record_.data(), record, leaf_bytes(header.kind, count));
  place_corners(reinterpret_cast<const float*>(record + sizeof(header)), count, place);
  std::byte* const ids = record_.data() + (ids_of(header, record) - record);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::uint32_t id = place.first() + read<std::uint32_t>(ids + 4 * lane);
    std::memcpy(ids + 4 * lane, &id, sizeof(id));
  }
  if (header.has_plane()) {
    place_plane(record, place);
  }
  return header.count;
}

void PlacedLeaf::place_corners(const float* rows, std::size_t count, const PlacedMesh& place) {
  alignas(64) Rows from{}, to;
  for (std::size_t row = 0; row < from.size(); ++row) {
    std::memcpy(from[row].data(), rows + row * count, count * sizeof(float));
  }
  static const VectorWidth width = vector_width();
  const double unit = place.unit();
  const Placing& placing = place.placing();
  run_by(width, [&] {
    for (std::size_t corner = 0; corner < 9; corner += 3) {
      for (std::size_t lane = 0; lane < leaf_lanes; ++lane) {
        const Vec3d at{double{from[corner][lane]} * unit, double{from[corner + 1][lane]} * unit,
                       double{from[corner + 2][lane]} * unit};
        const Vec3f placed = coordinates_of(placing.corner(at));
        to[corner][lane] = placed.x;
        to[corner + 1][lane] = placed.y;
        to[corner + 2][lane] = placed.z;
      }
    }
  });
  for (std::size_t row = 0; row < to.size(); ++row) {
    const std::size_t corner = row / 3,
                      placed = place.is_mirrored() ? 2 - corner : corner;  // the faces of a mirrored instance are flipped back
    std::memcpy(record_.data() + sizeof(LeafHeader) + (3 * placed + row % 3) * count * sizeof(float), to[row].data(),
                count * sizeof(float));
  }
}

/// Numbers planes as the converter does.
void PlacedLeaf::place_plane(const std::byte* record, const PlacedMesh& place) {
  auto header = read<LeafHeader>(record);
  const MeshPlane plane{plane_of(header, record), header.plane, header.plane == LeafHeader::level_plane};
  if (place.placing().stays_level(plane)) {
    header.plane = 0;
  } else if (const std::optional<FacePlane> placed = place.placing().plane(plane)) {
    header.plane = plane.is_level ? LeafHeader::shared_plane : plane.stored_as;
    std::memcpy(record_.data() + leaf_bytes(header.kind, header.count), &*placed, sizeof(FacePlane));
  } else {
    header.plane = header.shared_lanes = 0;
  }
  std::memcpy(record_.data(), &header, sizeof(header));
}

bool PlacedLeaf::has_vanished(std::uint32_t lane) const {
  const LeafLane triangle{reinterpret_cast<const float*>(record_.data() + sizeof(LeafHeader)),
                          read<LeafHeader>(record_.data()).count, lane};
  return leaves_nothing({triangle.vector(0), triangle.vector(3), triangle.vector(6)});
}

void PlacedLeaf::take_vanished_away() {
  auto header = read<LeafHeader>(record_.data());
  for (std::uint32_t lane = 0; lane < header.count; ++lane) {
    if (has_vanished(lane)) {
      for (std::size_t row = 0; row < 9; ++row) {
        std::memset(record_.data() + sizeof(header) + (row * header.count + lane) * sizeof(float), 0, sizeof(float));
      }
      header.shared_lanes = static_cast<std::uint8_t>(header.shared_lanes & ~(1U << lane));
    }
  }
  std::memcpy(record_.data(), &header, sizeof(header));
}

}  // namespace dmpc::core
