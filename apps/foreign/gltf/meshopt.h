// Views packed by meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/foreign/gltf/part.h"

namespace dmpc::apps::gltf {

/// What a view says of its packing, if it is packed.
std::optional<Part> packing_of(const Part& view);

/// The view that `packed` bytes stand for. Throws core::InputError for a packing that does not exist or bytes that do not fit it.
std::vector<std::byte> unpacked(const Part& packing, std::span<const std::byte> packed);

}  // namespace dmpc::apps::gltf
