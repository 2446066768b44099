// The poses of a glTF document's nodes while one of its animations is played.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/gltf/accessors.h"
#include "apps/formats/mesh_options.h"

namespace dmpc::apps::gltf {

/// What takes the place of a node's own translation (3 numbers), rotation (a quaternion of length 1) and scale (3).
struct NodePose {
  std::optional<std::vector<double>> translation, rotation, scale;
};

/// By places in the document's list of nodes; those that no channel moves are not in it.
using Pose = std::map<std::size_t, NodePose>;

/// The pose at a moment of the animation that it names: between keyframes as the sampler says (glTF 2.0, appendix C: STEP,
/// LINEAR, of rotations spherical, CUBICSPLINE), before the first and behind the last as there. By + - * / and roots alone, so
/// that it is the same on every computer. `notes` gets how long the animation is, and what of it is not played: morph weights,
/// and what extensions move. Throws core::InputError, by its place in the document, for an animation that is not there (with the
/// names of those that are) or does not hold together: keyframes whose times are no numbers from 0 on that ascend, other counts
/// of values than of times, numbers that are not finite, a node that does not exist, has a matrix, or is moved twice in one way.
Pose pose_at(const AnimationMoment& moment, const Document& document, Accessors& accessors, std::vector<std::string>& notes);

}  // namespace dmpc::apps::gltf
