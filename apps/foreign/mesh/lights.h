// The lights of a mesh file that is not lit whole, and its camera.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/formats/bounding_sphere.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Points and spots as they are, distant ones as points 1,000 radii of the scene away. By paths their intensities are what the
/// file says. Else fall-off is ignored; so colours are scaled down together until the squares of their brightest channels sum up
/// to 1, as lights without a colour do. What is dark or nowhere is left out. `notes` gets a sentence for each kind that is not
/// shown as it is; where the scene is lit by something else, none take the place of those that cannot be.
std::vector<core::PointLight> lights_of(const std::vector<FileLight>& lights, const BoundingSphere& bounds, double scale,
                                        bool is_by_paths, bool is_lit_else, std::vector<std::string>& notes);

/// A point or a spot that falls off with the square of the distance.
core::PointLight falling(const FileLight& light, const BoundingSphere& bounds, double scale);

/// By how much lights are to be weaker, at most 1: where half of these places get more than 16 times what a white surface shows
/// as 1 of them, by the root of the sum of squares, so that they get no more than that; else not at all.
double share_for(const std::vector<core::PointLight>& lights, const std::vector<core::Vec3d>& places);

/// A distant light as a point far away.
core::Vec3d far_position(const FileLight& light, const BoundingSphere& bounds);

/// Colours together, until the squares of their brightest channels sum up to 1, unless they do not reach that.
void scale_down(std::vector<core::PointLight>& lights);

/// The first that makes a picture, if there is one. `notes` gets a sentence if there are more, or none that will do.
std::optional<core::View> view_of(const std::vector<FileView>& views, double scale, std::vector<std::string>& notes);

}  // namespace dmpc::apps
