// Whether two scenes say the same, to the last bit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace dmpc::tests {

/// Every number of a scene, as bits, so that zeros of either sign differ.
inline std::vector<std::uint64_t> bits_of(const core::Scene& scene) {
  std::vector<std::uint64_t> bits;
  const auto add = [&bits](double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); };
  const auto add_vector = [&add](const core::Vec3d& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  };
  for (const auto* pool : {&scene.vertices, &scene.normals}) {
    for (const core::Vec3d& v : *pool) add_vector(v);
  }
  for (const core::Sphere& sphere : scene.spheres) {
    add_vector(sphere.center);
    add(sphere.radius);
  }
  for (const core::Cone& cone : scene.cones) {
    add_vector(cone.base);
    add(cone.base_radius);
    add_vector(cone.apex);
    add(cone.apex_radius);
  }
  for (const core::PointLight& light : scene.lights) {
    add_vector(light.position);
    add_vector(light.color);
  }
  for (const core::Vec3d& v : {scene.view.from, scene.view.at, scene.view.up, scene.background}) add_vector(v);
  for (const double value : {scene.view.angle_degrees, scene.view.hither, double(scene.view.width), double(scene.view.height)})
    add(value);
  return bits;
}

/// By what they are and of which material, wherever it stands in the list.
inline bool same_objects(const core::Scene& a, const core::Scene& b) {
  bool same = a.objects.size() == b.objects.size();
  for (std::size_t i = 0; same && i < a.objects.size(); ++i) {
    const core::Object &x = a.objects[i], &y = b.objects[i];
    same = x.kind == y.kind && x.first == y.first && x.vertex_count == y.vertex_count && x.first_normal == y.first_normal &&
           a.materials[x.material] == b.materials[y.material];
  }
  return same;
}

inline bool same_scene(const core::Scene& a, const core::Scene& b) { return bits_of(a) == bits_of(b) && same_objects(a, b); }

}  // namespace dmpc::tests
