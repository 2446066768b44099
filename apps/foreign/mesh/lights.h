// Converts the lights and the camera of a mesh file without ambient light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/formats/bounding_sphere.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Points and spots stay, distant lights become points 1,000 radii of the scene away. For path tracing intensities are the
/// file's. Otherwise fall-off is ignored, and colours are scaled down together until the squares of their brightest channels sum
/// up to 1, as lights without a colour do. Lights that are black or have no position are left out. `notes` gets a sentence for
/// each kind that is changed; if the scene is lit otherwise, lights that cannot be shown are not replaced.
std::vector<core::PointLight> lights_of(const std::vector<FileLight>& lights, const BoundingSphere& bounds, double scale,
                                        bool is_by_paths, bool is_lit_else, std::vector<std::string>& notes);

/// A point or spot light with inverse-square fall-off.
core::PointLight falling(const FileLight& light, const BoundingSphere& bounds, double scale);

/// The factor by which lights are weakened, at most 1: so that the median place does not receive more than 16 times the light
/// that a white surface shows as 1, by the root of the sum of squares.
double share_for(const std::vector<core::PointLight>& lights, const std::vector<core::Vec3d>& places);

/// A distant light as a point far away.
core::Vec3d far_position(const FileLight& light, const BoundingSphere& bounds);

/// Scales colours together, until the squares of their brightest channels sum up to 1, unless the sum is less.
void scale_down(std::vector<core::PointLight>& lights);

/// The first view that makes a picture, if there is one. `notes` gets a sentence if there are more, or if none is usable.
std::optional<core::View> view_of(const std::vector<FileView>& views, double scale, std::vector<std::string>& notes);

}  // namespace dmpc::apps
