// From a node's coordinates to the world's.
#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/vector3.h>

#include "core/base/vec.h"
#include "core/scene/transform.h"

namespace dmpc::apps {

using core::Transform;

inline core::Vec3d to_vec(const aiVector3D& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

/// Multiplies by `factor`.
Transform scaling(double factor);
/// First `local`, then `world`.
Transform operator*(const Transform& world, const aiMatrix4x4& local);

}  // namespace dmpc::apps
