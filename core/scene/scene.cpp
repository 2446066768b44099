#include "core/scene/scene.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/expect.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

constexpr std::size_t pool_max = std::numeric_limits<std::uint32_t>::max();

std::uint32_t pool_index(std::size_t index) {
  if (index >= pool_max) {
    throw CapacityError("the scene is too large: more than 4294967294 vertices, normals or objects; divide it");
  }
  return static_cast<std::uint32_t>(index);
}

/// Adding 0 makes -0 and 0, which are equal, hash equally.
std::size_t mix(std::size_t hash, double value) {
  return (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15U ^ (hash >> 29U);
}

/// A value for each corner.
template <class Value>
std::vector<Vec3d> of_corners(const PlacedObject& placed, const Value& value) {
  std::vector<Vec3d> values;
  for (std::uint32_t i = 0; i < placed.object().vertex_count; ++i) {
    values.push_back(value(i));
  }
  return values;
}

void replay_object(const PlacedObject& placed, SceneSink& sink) {
  const Object& object = placed.object();
  const auto vertices = [&] { return of_corners(placed, [&](std::uint32_t i) { return placed.vertex(i); }); };
  switch (object.kind) {
    case ObjectKind::polygon:
      return sink.polygon(vertices());
    case ObjectKind::patch:
      return sink.patch(vertices(), of_corners(placed, [&](std::uint32_t i) { return placed.normal(i); }));
    case ObjectKind::textured:
      return sink.patch(vertices(), of_corners(placed, [&](std::uint32_t i) { return placed.corner(i).normal; }));
    case ObjectKind::sphere: {
      const Sphere& sphere = placed.pools().spheres[object.first];
      return sink.sphere(sphere.center, sphere.radius);
    }
    case ObjectKind::cone: {
      const Cone& cone = placed.pools().cones[object.first];
      return sink.cone(cone.base, cone.base_radius, cone.apex, cone.apex_radius);
    }
  }
}

}  // namespace

bool Material::has_extension() const {
  return alpha != AlphaUse::none || !(specular_color == Vec3d{1, 1, 1}) || tinted_specular != 0 || mirror != 1 ||
         !(emission == Vec3d{});
}

double Material::specular_max(double texture_max) const {
  return specular * largest_component(specular_color) + tinted_specular * largest_component(color) * texture_max;
}

TexturedCorner colored_corner(const Vec3d& normal, const Vec3d& color, double alpha) {
  const auto steps = [](double share) {
    return static_cast<std::uint16_t>((share > 0 ? std::min(share, 1.0) : 0) * corner_color_max + 0.5);
  };
  const CornerColor bits{steps(color.x), steps(color.y), steps(color.z), steps(alpha)};
  return {normal, std::bit_cast<std::array<float, 2>>(bits)};
}

std::size_t SceneBuilder::MaterialHash::operator()(const Material& material) const {
  std::size_t hash = 0;
  for (const double value : {material.color.x,
                             material.color.y,
                             material.color.z,
                             material.diffuse,
                             material.specular,
                             material.shine,
                             material.transmittance,
                             material.refraction_index,
                             static_cast<double>(material.texture),
                             material.specular_color.x,
                             material.specular_color.y,
                             material.specular_color.z,
                             material.tinted_specular,
                             material.mirror,
                             material.emission.x,
                             material.emission.y,
                             material.emission.z,
                             static_cast<double>(material.alpha),
                             material.alpha_cutoff,
                             material.microfacets.roughness,
                             material.microfacets.metallic,
                             material.microfacets.reflectance,
                             material.microfacets.transmission,
                             material.microfacets.opacity,
                             static_cast<double>(material.microfacets.texture)}) {
    hash = mix(hash, value);
  }
  return hash;
}

SceneBuilder::SceneBuilder(Scene& scene) : scene_(scene), vertices_(scene.vertices.size()) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    materials_.try_emplace(scene.materials[i], pool_index(i));
  }
}

void SceneBuilder::background(const Vec3d& color) { scene_.background = color; }
void SceneBuilder::view(const View& view) { scene_.view = view; }
void SceneBuilder::light(const PointLight& light) { scene_.lights.push_back(light); }

void SceneBuilder::material(const Material& material) {
  const auto [entry, is_new] = materials_.try_emplace(material, pool_index(scene_.materials.size()));
  if (is_new) {
    scene_.materials.push_back(material);
  }
  material_ = entry->second;
  has_material_ = true;
}

void SceneBuilder::polygon(const std::vector<Vec3d>& vertices) {
  polygon(vertices.size());
  scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
}

void SceneBuilder::polygon(std::size_t vertex_count) {
  expect(vertex_count >= 3, "a polygon has at least 3 vertices");
  add_face(ObjectKind::polygon, vertex_count, 0);
}

void SceneBuilder::patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) {
  patch(vertices.size(), normals);
  scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
}

void SceneBuilder::patch(std::size_t vertex_count, const std::vector<Vec3d>& normals) {
  expect(vertex_count >= 3, "a patch has at least 3 vertices");
  expect(vertex_count == normals.size(), "a patch has a normal for each vertex");
  add_face(ObjectKind::patch, vertex_count, scene_.normals.size());
  scene_.normals.insert(scene_.normals.end(), normals.begin(), normals.end());
}

void SceneBuilder::textured(const std::vector<Vec3d>& vertices, const std::vector<TexturedCorner>& corners) {
  textured(vertices.size(), corners);
  scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
}

void SceneBuilder::textured(std::size_t vertex_count, const std::vector<TexturedCorner>& corners) {
  expect(vertex_count >= 3 && vertex_count == corners.size(), "a textured patch has a corner for each of its vertices");
  add_face(ObjectKind::textured, vertex_count, scene_.corners.size());
  const std::uint32_t texture = scene_.materials[material_].texture;
  expect(texture == Material::no_texture || texture < scene_.textures.size(), "a textured patch has a texture of the scene's");
  scene_.corners.insert(scene_.corners.end(), corners.begin(), corners.end());
}

void SceneBuilder::sphere(const Vec3d& center, double radius) {
  add(ObjectKind::sphere, scene_.spheres.size(), 0, 0);
  scene_.spheres.push_back({center, radius});
}

void SceneBuilder::cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) {
  add(ObjectKind::cone, scene_.cones.size(), 0, 0);
  scene_.cones.push_back({base, base_radius, apex, apex_radius});
}

void SceneBuilder::add_face(ObjectKind kind, std::size_t vertex_count, std::size_t first_normal) {
  add(kind, vertices_, vertex_count, first_normal);
  vertices_ += vertex_count;
}

void SceneBuilder::add(ObjectKind kind, std::size_t first, std::size_t vertex_count, std::size_t first_normal) {
  if (!has_material_) {
    material(Material{});
  }
  const Microfacets& facets = scene_.materials[material_].microfacets;
  expect(kind == ObjectKind::textured || !facets.have_texture() || facets.use == FacetTexture::mean,
         "a texture of metal and roughness is one of textured patches");
  pool_index(scene_.objects.size());
  pool_index(first + vertex_count);
  scene_.objects.push_back(
      {kind, material_, pool_index(first), static_cast<std::uint32_t>(vertex_count), pool_index(first_normal)});
}

Vec3d intensity_of(const PointLight& light, const Scene& scene) {
  if (light.has_color) {
    return light.color;
  }
  const double equal = 1.0 / std::sqrt(static_cast<double>(scene.lights.size()));
  return {equal, equal, equal};
}

Vec3d zenith_of(const Scene& scene) { return scene.zenith == Vec3d{} ? normalize(scene.view.up) : scene.zenith; }

void replay(const Scene& scene, SceneSink& sink) {
  sink.background(scene.background);
  sink.view(scene.view);
  for (const PointLight& light : scene.lights) {
    sink.light(light);
  }
  std::optional<std::uint32_t> material;
  PlacedObjects(scene).for_each([&](const PlacedObject& placed) {
    if (std::exchange(material, placed.object().material) != placed.object().material) {
      sink.material(scene.materials[placed.object().material]);
    }
    replay_object(placed, sink);
  });
}

void ExpandedSize::check() const {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};
  if (std::max({objects, vertices, normals, corners}) > most) {
    throw CapacityError("with every instance the scene has more than 4294967294 vertices, normals or objects; divide it");
  }
}

ExpandedSize size_of_pools(const Scene& scene) {
  return {scene.objects.size(), scene.vertices.size(), scene.normals.size(), scene.corners.size()};
}

}  // namespace dmpc::core
