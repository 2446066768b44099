// Round shapes as meshes, with normals, and places that go round as u and up as v.
#pragma once

#include <cstdint>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/scene_totals.h"

namespace dmpc::apps {

/// So many faces go round.
inline constexpr int faces_around = 64;

enum class RoundKind : std::uint8_t { sphere, cylinder, ring };

/// The part of a sphere about the origin, or of an open cylinder about z, between two heights along z, or a ring across z at the
/// lower of them; and up to an angle about z.
struct RoundShape {
  RoundKind kind{};
  double radius = 1;
  double least_z = -1, most_z = 1;  ///< clips a sphere, in units of its radius
  double degrees = 360;             ///< above 0
  double inner = 0;                 ///< a ring's hole

  bool is_ball() const { return kind == RoundKind::sphere && least_z <= -radius && most_z >= radius && degrees >= 360; }
};
PolygonMesh mesh_of(const RoundShape& shape);
/// As size_of_copy() of that.
GeometrySize size_of_copy(const RoundShape& shape);

}  // namespace dmpc::apps
