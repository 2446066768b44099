// Decompresses views of meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/foreign/gltf/part.h"

namespace dmpc::apps::gltf {

/// The compression member of a view, if there is one.
std::optional<Part> packing_of(const Part& view);

/// Decompresses `packed`. Throws core::InputError for an unknown method or invalid bytes.
std::vector<std::byte> unpacked(const Part& packing, std::span<const std::byte> packed);

}  // namespace dmpc::apps::gltf
