// How far the copies of base meshes reach that a scene leaves out.
#pragma once

#include "core/base/box.h"
#include "core/database/parallel.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Makes a box around what else the scene has larger by the corners of these copies, to the bit as
/// if they were there. Corners with a coordinate of `coordinate_max` or more do not count. Where many places lie apart but few
/// have their corners placed: those whose boxes reach out of what is known.
void include_copies(Box& box, const Scene& scene, double coordinate_max, const Parallel& parallel);

}  // namespace dmpc::core
