// Tessellates round shapes, with normals, and texture coordinates u around and v upwards.
#pragma once

#include <cstdint>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/scene_totals.h"

namespace dmpc::apps {

/// Number of faces around the axis.
inline constexpr int faces_around = 64;

enum class RoundKind : std::uint8_t { sphere, cylinder, ring };

/// A part of a sphere around the origin, or of an open cylinder around z, between two heights along z, or a ring across z at the
/// lower height; limited to an angle around z.
struct RoundShape {
  RoundKind kind{};
  double radius = 1;
  double least_z = -1, most_z = 1;  ///< clips a sphere, in units of its radius
  double degrees = 360;             ///< above 0
  double inner = 0;                 ///< a ring's hole

  bool is_ball() const { return kind == RoundKind::sphere && least_z <= -radius && most_z >= radius && degrees >= 360; }
};
PolygonMesh mesh_of(const RoundShape& shape);
/// As size_of_copy() of the tessellated mesh.
GeometrySize size_of_copy(const RoundShape& shape);

}  // namespace dmpc::apps
