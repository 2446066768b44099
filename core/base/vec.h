// Three-component vectors in single and double precision, and linear RGB colours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dmpc::core {

/// Three components. Single precision is for storage and traversal, double for shading and building.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr T operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool operator==(const Vec3&) const = default;

  template <class U>
  constexpr explicit operator Vec3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
/// Linear RGB radiance or reflectance; x, y, z are red, green, blue.
using Color = Vec3<float>;

template <class T>
constexpr Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vec3<T> operator*(const Vec3<T>& a, T s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
constexpr Vec3<T> operator*(T s, const Vec3<T>& a) {
  return a * s;
}
/// Component-wise product: light of one colour on a surface of another.
template <class T>
constexpr Vec3<T> operator*(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}
/// The largest magnitude of the components.
template <class T>
T largest_component(const Vec3<T>& a) {
  return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}
/// The sum of the products of the components' magnitudes. If rounding moves each coordinate of `b` by a relative share, it moves
/// the point across the plane with normal `a` by at most that share of this value.
template <class T>
T dot_of_magnitudes(const Vec3<T>& a, const Vec3<T>& b) {
  return std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z);
}
/// `a` scaled to length 1; requires a length above 0.
template <class T>
Vec3<T> normalize(const Vec3<T>& a) {
  return a * (T(1) / length(a));
}
template <class T>
bool is_finite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The least altitude of a triangle with these edges, in any order and direction; `twice_area` is twice its area. NaN if all are
/// 0.
inline double least_altitude(const Vec3d& a, const Vec3d& b, const Vec3d& c, double twice_area) {
  return twice_area / std::sqrt(std::max(std::max(dot(a, a), dot(b, b)), dot(c, c)));
}

}  // namespace dmpc::core
