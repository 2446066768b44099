// Reads glTF 2.0.
#pragma once

#include <optional>

#include "apps/foreign/gltf/buffers.h"
#include "apps/foreign/gltf/document.h"
#include "apps/foreign/mesh/imported_file.h"
#include "apps/formats/animation_moment.h"

namespace dmpc::apps::gltf {

/// The document as a scene of Assimp's, so that what follows is the same for all formats. It is strict: what refers to something
/// that does not exist, reaches beyond its bytes, or is required and not shown, is a core::InputError that names the place in the
/// document, "meshes[0].primitives[1]: ...". Files that the document refers to are asked of `open`.
/// At `animation`, if it is given, nodes stand as pose_at() says (apps/foreign/gltf/animation.h), else as they say themselves.
ImportedFile read_gltf(const Document& document, const OpenNamed& open,
                       const std::optional<AnimationMoment>& animation = std::nullopt);

}  // namespace dmpc::apps::gltf
