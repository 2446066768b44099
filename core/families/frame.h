// Frames that place the objects of built-in scenes in the world.
#pragma once

#include "core/base/elementary.h"
#include "core/base/vec.h"

namespace dmpc::core::scenes {

/// Sine and cosine of an angle, for rotations where only those are known.
struct Turn {
  double sine = 0, cosine = 1;
};

inline Turn turn_degrees(double degrees) { return {sin_degrees(degrees), cos_degrees(degrees)}; }

/// An affine map of column vectors: the images of the axes and of the origin.
struct Frame {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3d point(const Vec3d& p) const { return vector(p) + origin; }
};

/// The map that applies `inner` first.
inline Frame compose(const Frame& outer, const Frame& inner) {
  return {outer.vector(inner.x), outer.vector(inner.y), outer.vector(inner.z), outer.point(inner.origin)};
}

inline Frame translation(const Vec3d& offset) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset}; }
inline Frame scaling(double factor) { return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, {}}; }

/// Right-handed rotations about the axes.
inline Frame rotation_x(const Turn& t) { return {{1, 0, 0}, {0, t.cosine, t.sine}, {0, -t.sine, t.cosine}, {}}; }
inline Frame rotation_y(const Turn& t) { return {{t.cosine, 0, -t.sine}, {0, 1, 0}, {t.sine, 0, t.cosine}, {}}; }
inline Frame rotation_z(const Turn& t) { return {{t.cosine, t.sine, 0}, {-t.sine, t.cosine, 0}, {0, 0, 1}, {}}; }

/// `v` rotated about the unit vector `axis`, right-handed (Rodrigues' formula).
inline Vec3d rotated(const Vec3d& v, const Vec3d& axis, const Turn& t) {
  return v * t.cosine + cross(axis, v) * t.sine + axis * (dot(axis, v) * (1 - t.cosine));
}
/// This rotation as a frame.
inline Frame rotation(const Vec3d& axis, const Turn& t) {
  return {rotated({1, 0, 0}, axis, t), rotated({0, 1, 0}, axis, t), rotated({0, 0, 1}, axis, t), {}};
}

}  // namespace dmpc::core::scenes
