// The lights and the camera of a mesh file.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/formats/whole_view.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Point lights as they are, spots as if they shone all round, directional ones as points 1,000 radii of the scene away; area and
/// ambient lights are left out. Fall-off is ignored, since ours have none; so colours are scaled down together until the squares
/// of their brightest channels sum up to 1, as lights without a colour do. `notes` gets a sentence for each kind that is not
/// shown as it is.
std::vector<core::PointLight> lights_of(const aiScene& scene, const BoundingSphere& bounds, double scale,
                                        std::vector<std::string>& notes);

/// The first camera, if there is one that makes a picture; its picture's shorter side has 512 pixels. `notes` gets a sentence if
/// there are more, or none that will do.
std::optional<core::View> camera_of(const aiScene& scene, double scale, std::vector<std::string>& notes);

}  // namespace dmpc::apps
