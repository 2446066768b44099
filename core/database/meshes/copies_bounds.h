// The extent of the copies of base meshes that a scene leaves out.
#pragma once

#include "core/base/box.h"
#include "core/database/parallel.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Extends the box of the rest of the scene by the corners of these copies, with the same bits as if they existed. Corners with a
/// coordinate of `coordinate_max` or more do not count. If many instances lie apart, few have their corners placed: those whose
/// boxes reach out of the known box.
void include_copies(Box& box, const Scene& scene, double coordinate_max, const Parallel& parallel);

}  // namespace dmpc::core
