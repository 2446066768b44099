#include "apps/oracle/accurate/scene.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/expect.h"
#include "core/scene/triangulate.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveKind;
using core::Vec3d;

Vec3d unit_or_zero(const Vec3d& v) {
  const double size = length(v);
  return size > 0 && std::isfinite(size) ? v * (1 / size) : Vec3d{};
}

void add(AccurateScene& to, AccurateBody body) {
  if (is_usable(body)) {
    const core::Box box = bounds_of(body);
    to.bounds.include(box.low);
    to.bounds.include(box.high);
    to.bodies.push_back(body);
  }
}

void add_polygon(AccurateScene& to, const core::Scene& scene, const core::Object& object, AccurateBody body) {
  const auto vertices = std::span(scene.vertices).subspan(object.first, object.vertex_count);
  for (const auto& corners : core::triangulate(vertices)) {
    body.corner = corners;
    for (std::size_t k = 0; k < 3; ++k) {
      body.place[k] = vertices[corners[k]];
    }
    if (object.kind == core::ObjectKind::patch) {
      body.first_normal = static_cast<std::uint32_t>(to.normals.size());
      for (const std::uint32_t corner : corners) {
        to.normals.push_back(unit_or_zero(scene.normals[object.first_normal + corner]));
      }
    }
    add(to, body);
  }
}

void add_object(AccurateScene& to, const core::Scene& scene, std::uint32_t index) {
  const core::Object& object = scene.objects[index];
  AccurateBody body{.material = object.material, .object = index};
  if (object.kind == core::ObjectKind::sphere) {
    const core::Sphere& sphere = scene.spheres[object.first];
    body.kind = PrimitiveKind::sphere;
    body.place[0] = sphere.center;
    body.radius[0] = sphere.radius;
    add(to, body);
  } else if (object.kind == core::ObjectKind::cone) {
    const core::Cone& cone = scene.cones[object.first];
    body.kind = PrimitiveKind::cone;
    body.place = {cone.base, cone.apex};
    body.radius = {cone.base_radius, cone.apex_radius};
    add(to, body);
  } else {
    add_polygon(to, scene, object, body);
  }
}

}  // namespace

AccurateScene accurate_scene(const core::Scene& scene) {
  if (!scene.textures.empty()) {
    throw core::InputError(scene.name +
                           ": it has textures, which the renderer in double precision does not know: measure errors on "
                           "scenes without them");
  }
  AccurateScene result;
  result.materials = scene.materials;
  result.background = scene.background;
  for (const core::PointLight& light : scene.lights) {
    result.lights.push_back({light.position, core::intensity_of(light, scene)});
  }
  for (std::uint32_t index = 0; index < scene.objects.size(); ++index) {
    add_object(result, scene, index);
  }
  if (!result.bounds.empty()) {
    const Vec3d extent = result.bounds.high - result.bounds.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    result.size = size > 0 ? size : 1;
  }
  return result;
}

}  // namespace dmpc::apps
