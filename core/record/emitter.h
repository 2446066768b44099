// Emitters for light sampling: the records by which a hit selects an emitter, and a point on it.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"
#include "core/record/choice_node.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A triangle, seen from both sides, or a sphere, seen from outside. One of a database's DatabaseHeader::emitter_count.
struct EmitterRecord {
  /// Grid-local: the corners of a triangle, the very floats of its leaf; of a sphere the centre, then its radius as x.
  std::array<Vec3f, 3> corner;
  Color radiance;
  float chance = 0;  ///< probability of being selected, at any hit
  PrimitiveKind kind{};
  std::uint32_t primitive = 0;  ///< its id
  std::uint32_t padding = 0;

  Vec3d center() const { return Vec3d(corner[0]); }
  double radius() const { return double{corner[1].x}; }
};
static_assert(sizeof(EmitterRecord) == sizeof(ChoiceNode) && std::is_trivially_copyable_v<EmitterRecord>);

inline bool has_emitters(const DatabaseHeader& header) { return header.emitter_count > 0; }

inline Address emitter_address(const DatabaseHeader& header, std::uint32_t emitter) {
  return advance(header.emitters, std::uint64_t{emitter} * sizeof(EmitterRecord));
}
/// The tree by which one is selected follows all emitters.
inline Address choice_address(const DatabaseHeader& header, std::uint32_t node) {
  return advance(emitter_address(header, header.emitter_count), std::uint64_t{node} * sizeof(ChoiceNode));
}

/// Power per area up to a constant factor.
inline double strength_of(const Color& radiance) { return double{radiance.x} + double{radiance.y} + double{radiance.z}; }

/// The density of a point on an emitter for light sampling, per grid-local area: the emitter is selected by power and the point
/// by area, so the density is proportional to radiance alone, for any hit and emitter.
inline double density_on(const DatabaseHeader& header, const Color& radiance) {
  return double{header.emitter_density} * strength_of(radiance);
}

}  // namespace dmpc::core
