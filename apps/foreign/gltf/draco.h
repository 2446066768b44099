// Primitives packed by Draco (KHR_draco_mesh_compression).
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "apps/foreign/gltf/primitive.h"

namespace dmpc::apps::gltf {

/// `widths`: the attributes to read, and how many numbers each has. Throws core::InputError for bytes that Draco cannot unpack.
Primitive read_draco(const Part& packing, Buffers& buffers, const std::map<std::string, std::size_t>& widths);

}  // namespace dmpc::apps::gltf
