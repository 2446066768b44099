// What a glTF document says that its meshes have.
#pragma once

#include <cstdint>

#include "apps/foreign/gltf/document.h"
#include "apps/formats/mesh_counts.h"
#include "core/scene/instances.h"

namespace dmpc::apps::gltf {

/// By the counts of accessors, which may be wrong, but hold for what is read; a mesh counts for each node that has it, but once
/// if its copies are left out.
MeshCounts counts_of(const Document& document, std::uint64_t file_bytes, core::Copies copies = core::Copies::put);

}  // namespace dmpc::apps::gltf
