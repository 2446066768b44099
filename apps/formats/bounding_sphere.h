// A sphere around a scene.
#pragma once

#include "core/base/vec.h"

namespace dmpc::apps {

/// A sphere around vertices.
struct BoundingSphere {
  core::Vec3d center;
  double radius = 0;
};

}  // namespace dmpc::apps
