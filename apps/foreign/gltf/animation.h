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

/// Replaces a node's own translation (3 numbers), rotation (a quaternion of length 1) and scale (3).
struct NodePose {
  std::optional<std::vector<double>> translation, rotation, scale;
};

/// By index in the document's list of nodes; without nodes that no channel moves.
using Pose = std::map<std::size_t, NodePose>;

/// The pose at a moment of the named animation: between keyframes as the sampler says (glTF 2.0, appendix C: STEP, LINEAR,
/// spherical for rotations, CUBICSPLINE), before the first and after the last as at these. It uses + - * / and roots alone, so
/// that it is the same on every computer. `notes` gets the animation's length and what is not played: morph weights, and
/// properties that extensions animate. Throws core::InputError, with the place in the document, for an animation that does not
/// exist (with the names of those that do) or is inconsistent: keyframe times that are not ascending numbers from 0, different
/// numbers of values and times, numbers that are not finite, a node that does not exist, has a matrix, or is moved twice in one
/// way.
Pose pose_at(const AnimationMoment& moment, const Document& document, Accessors& accessors, std::vector<std::string>& notes);

}  // namespace dmpc::apps::gltf
