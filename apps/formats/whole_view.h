// Default view, lights and background.
#pragma once

#include <span>
#include <vector>

#include "apps/formats/bounding_sphere.h"
#include "apps/formats/indexed_vertices.h"
#include "apps/formats/up_axis.h"
#include "core/base/vec.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A sphere around the middle of the bounding box of `objects`, of all instances and of the spheres; of radius 1 about 0 if there
/// are none. Points that no vertex uses do not count.
BoundingSphere sphere_around(const IndexedVertices& vertices, const std::vector<core::Object>& objects,
                             const core::Instances& instances, std::span<const core::Sphere> spheres = {});

/// Light grey-blue, linear: dark and bright surfaces stand out from it.
inline constexpr core::Vec3d plain_background{0.45, 0.55, 0.7};

/// The directions of a scene as unit vectors: the viewer is at `front`.
struct SceneAxes {
  core::Vec3d right, up, front;
};
SceneAxes axes_of(const UpAxis& up);

/// The whole sphere in a picture of 512x512 over 45 degrees, from a direction between front, right and up.
core::View whole_view(const BoundingSphere& bounds, const UpAxis& up);

/// Two white lights: the key light 1,000 radii away, above and to the right of the eye, and a weak fill light at the eye, so that
/// nothing in view is black.
std::vector<core::PointLight> plain_lights(const BoundingSphere& bounds, const core::View& view);

}  // namespace dmpc::apps
