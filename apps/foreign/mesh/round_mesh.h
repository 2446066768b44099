// Round shapes as meshes, with normals, and places that go round as u and up as v.
#pragma once

#include "apps/foreign/mesh/polygon_mesh.h"

namespace dmpc::apps {

/// So many faces go round.
inline constexpr int faces_around = 64;

/// The part of a sphere about the origin between two heights along z, and up to an angle about it.
struct SpherePart {
  double radius = 1;
  double least_z = -1, most_z = 1;  ///< within the radius
  double degrees = 360;             ///< above 0
};
PolygonMesh sphere_mesh(const SpherePart& part);

/// An open cylinder about z, likewise.
PolygonMesh cylinder_mesh(const SpherePart& part);

/// A ring across z at a height; without a hole where `inner` is 0.
PolygonMesh ring_mesh(double height, double radius, double inner, double degrees);

}  // namespace dmpc::apps
