// Records of instances of base meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/box.h"
#include "core/record/hit.h"
#include "core/record/record.h"

namespace dmpc::core {

/// An instance of a mesh. Its corners are those of the mesh's records times `unit`, exactly, transformed in double as those of a
/// copy are (core/scene/placing.h), and rounded in the same way.
struct InstanceRecord {
  LeafHeader header{.kind = PrimitiveKind::instance};  ///< no lanes: so a traversal tells it from a leaf of boxes
  std::array<double, 12> world{};  ///< from the mesh's coordinates to the world's: the rows of the linear part, then the shift
  Address root = no_address;       ///< the mesh's first BVH node
  std::uint32_t first = 0;         ///< the id of the mesh's triangle 0 here; the others follow
  float unit = 1;                  ///< power of two: the mesh's coordinates per unit of its records
  float pad = 0;                   ///< the grid's insertion pad along an axis of the mesh, in units of its records
  std::array<std::uint32_t, 2> unused{};
};
static_assert(sizeof(InstanceRecord) == 128);

/// Whether a record with this header is an InstanceRecord, not a leaf.
constexpr bool is_instance(const LeafHeader& header) { return header.kind == PrimitiveKind::instance && header.count == 0; }

/// The box of a lane of a leaf of instances: that of the copy, enlarged by the grid's pad.
inline Box instance_box(const std::byte* leaf, std::size_t lane) {
  const auto header = read<LeafHeader>(leaf);
  const auto at = [&](std::size_t row) {
    return double{read<float>(leaf + sizeof(header) + sizeof(float) * (row * header.count + lane))};
  };
  return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
}
/// The record of that instance.
inline Address instance_in(const std::byte* leaf, std::size_t lane) {
  const auto header = read<LeafHeader>(leaf);
  return read<Address>(ids_of(header, leaf) + sizeof(Address) * (header.count + lane));
}

/// The maximum number of levels of BVH nodes above leaves of instances: such a leaf replaces one waiting child by up to 8, as a
/// BVH node does.
inline constexpr int levels_above_instances = bvh_levels_max - 1;

// A hit on a base mesh stores its instance in Hit::lane, above the leaf's lane.
inline constexpr std::uint32_t instance_shift = 3, lane_mask = (1U << instance_shift) - 1;
static_assert(leaf_lanes == 1U << instance_shift);

/// The Hit::lane for a lane and an instance, whose record lies at a multiple of its size.
constexpr std::uint32_t lane_in_instance(std::uint32_t lane, Address instance) {
  constexpr std::uint32_t step = sizeof(InstanceRecord) / record_alignment;
  return lane | (static_cast<std::uint32_t>(instance) / step + 1) << instance_shift;
}
constexpr bool is_in_instance(const Hit& hit) { return (hit.lane >> instance_shift) != 0; }
/// Requires is_in_instance().
constexpr Address instance_of(const Hit& hit) {
  constexpr std::uint32_t step = sizeof(InstanceRecord) / record_alignment;
  return Address{((hit.lane >> instance_shift) - 1) * step};
}

}  // namespace dmpc::core
