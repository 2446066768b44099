// The faces of many triangles, found side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector_width.h"
#include "core/database/conversion.h"
#include "core/database/face.h"

namespace dmpc::core {

/// Those of primitives that are triangles, as records have them: Face(triangle, id, object) for each.
std::vector<Face> faces_of(const Conversion& conversion, std::span<const std::uint32_t> ids, VectorWidth width = vector_width());

}  // namespace dmpc::core
