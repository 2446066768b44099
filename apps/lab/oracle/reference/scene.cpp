#include "apps/lab/oracle/reference/scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "core/base/expect.h"
#include "core/scene/placed_objects.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveKind;
using core::Vec3d;

Vec3d unit_or_zero(const Vec3d& v) {
  const double size = length(v);
  return size > 0 && std::isfinite(size) ? v * (1 / size) : Vec3d{};
}

void add(ReferenceScene& to, ReferenceBody body) {
  if (is_usable(body)) {
    const core::Box box = bounds_of(body);
    to.bounds.include(box.low);
    to.bounds.include(box.high);
    to.bodies.push_back(body);
  }
}

/// Texture coordinates that are far away or NaN count as 0.
ReferencePlace usable(const std::array<float, 2>& place) {
  constexpr double place_max = 1 << 20;
  const auto usable = [](double coordinate) { return std::fabs(coordinate) < place_max ? coordinate : 0; };
  return {usable(double{place[0]}), usable(double{place[1]})};
}

ReferenceTexel color_of(const core::TexturedCorner& corner) {
  const auto bits = std::bit_cast<core::CornerColor>(corner.place);
  const auto share = [&bits](std::size_t channel) { return static_cast<double>(bits[channel]) / core::corner_color_max; };
  return {{share(0), share(1), share(2)}, share(3)};
}

/// Adds the data of a triangle's corners other than their positions.
void add_corners(ReferenceScene& to, const core::Scene& scene, const core::Object& object, ReferenceBody& body) {
  const bool is_textured = object.kind == core::ObjectKind::textured;
  const bool has_colors = is_textured && scene.materials[object.material].texture == core::Material::no_texture;
  body.first_normal = static_cast<std::uint32_t>(to.normals.size());
  if (is_textured) {
    (has_colors ? body.first_color : body.first_place) =
        static_cast<std::uint32_t>(has_colors ? to.colors.size() : to.places.size());
  }
  for (const std::uint32_t index : body.corner) {
    const std::size_t corner = object.first_normal + index;
    to.normals.push_back(unit_or_zero(is_textured ? scene.corners[corner].normal : scene.normals[corner]));
    if (has_colors) {
      to.colors.push_back(color_of(scene.corners[corner]));
    } else if (is_textured) {
      to.places.push_back(usable(scene.corners[corner].place));
    }
  }
}

void add_polygon(ReferenceScene& to, const core::Scene& scene, const core::Object& object, ReferenceBody body) {
  const auto vertices = std::span(scene.vertices).subspan(object.first, object.vertex_count);
  for (const auto& corners : core::triangles_of(scene, body.object)) {
    body.corner = corners;
    for (std::size_t k = 0; k < 3; ++k) {
      body.place[k] = vertices[corners[k]];
    }
    if (object.kind == core::ObjectKind::patch || object.kind == core::ObjectKind::textured) {
      add_corners(to, scene, object, body);
    }
    add(to, body);
  }
}

void add_object(ReferenceScene& to, const core::Scene& scene, std::uint32_t index) {
  const core::Object& object = scene.objects[index];
  ReferenceBody body{.material = object.material, .object = index};
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

ReferenceScene reference_scene(const core::Scene& scene) {
  core::expect(!scene.sky.is_there(), "the renderer in double knows skies of colours alone, no pictures");
  core::expect(!leaves_copies_out(scene), "the renderer in double knows no meshes that are kept");
  ReferenceScene result;
  result.textures = scene.textures;
  result.materials = scene.materials;
  result.background = scene.background;
  result.ambient = scene.ambient;
  result.has_emission = std::any_of(scene.materials.begin(), scene.materials.end(),
                                    [](const core::Material& material) { return !(material.emission == Vec3d{}); });
  for (const core::PointLight& light : scene.lights) {
    result.lights.push_back(
        {light.position, core::intensity_of(light, scene), core::spread_of(light.cone, light.falls_off_from > 0)});
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
