// The lights and the camera of a mesh file.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/formats/resolution.h"
#include "apps/formats/up_axis.h"
#include "apps/formats/whole_view.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Point lights as they are, spots as if they shone all round, directional ones as points 1,000 radii of the scene away; area and
/// ambient lights, and what is dark or nowhere, are left out. Fall-off is ignored, since ours have none; so colours are scaled
/// down together until the squares of their brightest channels sum up to 1, as lights without a colour do. `notes` gets a
/// sentence for each kind that is not shown as it is; where the scene is lit by something else, none take the place of those that
/// cannot be.
std::vector<core::PointLight> lights_of(const aiScene& scene, const BoundingSphere& bounds, double scale, bool is_lit_else,
                                        std::vector<std::string>& notes);

/// Colours together, until the squares of their brightest channels sum up to 1, unless they do not reach that.
void scale_down(std::vector<core::PointLight>& lights);

/// The first camera that makes a picture, if there is one; its own picture's shorter side has 512 pixels. Its angle spans a
/// picture of `size`, its own if none is given, from edge to edge (core::View's goes between the middles of pixels): of glTF the
/// vertical one, of others the horizontal one, or the vertical one that the camera's aspect makes of it. `notes` gets a sentence
/// if there are more, or none that will do.
std::optional<core::View> camera_of(const aiScene& scene, const std::optional<Resolution>& size, double scale,
                                    std::vector<std::string>& notes);

}  // namespace dmpc::apps
