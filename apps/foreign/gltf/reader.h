// Reads glTF 2.0.
#pragma once

#include "apps/foreign/gltf/buffers.h"
#include "apps/foreign/gltf/document.h"
#include "apps/foreign/mesh/imported_file.h"

namespace dmpc::apps::gltf {

/// The document as a scene of Assimp's, so that what follows is the same for all formats. It is strict: what refers to something
/// that does not exist, reaches beyond its bytes, or is required and not shown, is a core::InputError that names the place in the
/// document, "meshes[0].primitives[1]: ...". Files that the document refers to are asked of `open`.
ImportedFile read_gltf(const Document& document, const OpenNamed& open);

}  // namespace dmpc::apps::gltf
