// Instances the meshes of a glTF document at its nodes.
#pragma once

#include <vector>

#include "apps/foreign/gltf/accessors.h"
#include "apps/foreign/gltf/meshes.h"
#include "apps/foreign/gltf/nodes.h"

namespace dmpc::apps::gltf {

/// Gives the file its shapes and instances. What a transform presses onto a line or a point, as a scale of 0 does, has no area
/// and is left out; what it presses flat stays. A mesh with a skin stands where its joints hold it, regardless of its own node:
/// the sum over joints of weight times the joint's transform times its inverse bind matrix (glTF 2.0, 3.7.3.2). Weights are
/// normalized by their sum; a vertex without any stays with its mesh's node. Throws core::InputError for a transform that is not
/// finite, and, with the place in the document, for a joint that does not exist or is outside the scene, for fewer inverse bind
/// matrices than joints, for vertices' joints that the skin does not have, and for weights that are negative or not finite. Notes
/// which features of meshes and materials are not shown.
void place_meshes(const Document& document, Accessors& accessors, const Nodes& nodes, Meshes meshes,
                  const std::vector<MaterialTraits>& materials, SceneTotals& totals, PlacedFile& file);

}  // namespace dmpc::apps::gltf
