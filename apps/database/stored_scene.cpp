#include "apps/database/stored_scene.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "apps/formats/nff_reader.h"
#include "apps/formats/view_faults.h"
#include "apps/reader/packing.h"
#include "core/base/expect.h"
#include "core/record/texture_layout.h"
#include "core/scene/stored_objects.h"

namespace dmpc::apps {
namespace {

void add_textures(const std::vector<core::Texture>& textures, Packer& packer) {
  packer.add(std::uint64_t{textures.size()});
  for (const core::Texture& texture : textures) {
    packer.add_text(texture.name).add(texture.format).add(texture.wrap_s).add(texture.wrap_t);
    packer.add(texture.brightest).add(texture.darkest);
    packer.add(texture.levels.front().width).add(texture.levels.front().height);
  }
}

void add_stored(const core::StoredObjects& stored, Packer& packer) {
  packer.add(stored.objects).add(stored.bounds).add(stored.eye_distance).add(stored.share);
  packer.add(stored.meshes).add(stored.mesh_triangles).add(stored.triangles_in_places);
  packer.add(std::uint64_t{stored.identity.size()});
  for (const auto& [name, text] : stored.identity) {
    packer.add_text(name).add_text(text);
  }
}

bool is_number(double value) { return std::isfinite(value); }
bool is_vector(const core::Vec3d& value) { return is_number(value.x) && is_number(value.y) && is_number(value.z); }

/// A count of items of which each takes a byte at least.
std::uint64_t take_count(Unpacker& fields, std::uint64_t most) {
  const auto count = fields.take<std::uint64_t>();
  Unpacker::require(count <= most);
  return count;
}

std::vector<core::PointLight> take_lights(Unpacker& fields, std::uint64_t bytes) {
  std::vector<core::PointLight> lights;
  for (std::uint64_t left = take_count(fields, bytes); left > 0; --left) {
    core::PointLight light{.position = fields.take<core::Vec3d>(), .color = fields.take<core::Vec3d>()};
    light.has_color = fields.take_flag();
    light.falls_off_from = fields.take<double>();
    light.cone.ahead = fields.take<core::Vec3d>();
    light.cone.full_degrees = fields.take<double>();
    light.cone.none_degrees = fields.take<double>();
    light.cone.edge = fields.take_choice(core::ConeEdge::square);
    Unpacker::require(is_vector(light.position) && is_vector(light.color) && light.falls_off_from >= 0);
    lights.push_back(light);
  }
  return lights;
}

std::vector<core::Texture> take_textures(Unpacker& fields, std::uint64_t bytes) {
  std::vector<core::Texture> textures;
  for (std::uint64_t left = take_count(fields, bytes); left > 0; --left) {
    core::Texture texture{.name = fields.take_text()};
    texture.format = fields.take_choice(core::TexelFormat::linear);
    texture.wrap_s = fields.take_choice(core::TextureWrap::clamp);
    texture.wrap_t = fields.take_choice(core::TextureWrap::clamp);
    texture.brightest = fields.take<double>();
    texture.darkest = fields.take<core::Color>();
    const auto width = fields.take<std::uint32_t>(), height = fields.take<std::uint32_t>();
    Unpacker::require(texture.brightest >= 0 && is_number(texture.brightest) && width >= 1 && height >= 1 &&
                      width <= core::Texture::size_max && height <= core::Texture::size_max);
    for (std::uint32_t level = 0; level < core::level_count(width, height); ++level) {
      texture.levels.push_back({core::level_size(width, level), core::level_size(height, level), {}});
    }
    textures.push_back(std::move(texture));
  }
  return textures;
}

void check_material(const core::Material& material, std::size_t textures) {
  const core::Microfacets& facets = material.microfacets;
  const auto is_there = [&](std::uint32_t texture) { return texture == core::Material::no_texture || texture < textures; };
  Unpacker::require(is_there(material.texture) && is_there(facets.texture) && material.alpha <= core::AlphaUse::cut &&
                    facets.use <= core::FacetTexture::mean);
  for (const core::Vec3d& color : {material.color, material.specular_color, material.emission}) {
    Unpacker::require(is_vector(color));
  }
  for (const double value : {material.diffuse, material.specular, material.shine, material.transmittance,
                             material.refraction_index, material.alpha_cutoff, material.tinted_specular, material.mirror,
                             facets.roughness, facets.metallic, facets.reflectance, facets.transmission, facets.opacity}) {
    Unpacker::require(is_number(value));
  }
}

std::shared_ptr<const core::StoredObjects> take_stored(Unpacker& fields, std::uint64_t bytes) {
  auto stored = std::make_shared<core::StoredObjects>();
  stored->objects = fields.take<decltype(stored->objects)>();
  stored->bounds = fields.take<core::Box>();
  stored->eye_distance = fields.take<double>();
  stored->share = fields.take<core::InstancingShare>();
  stored->meshes = fields.take<std::uint64_t>();
  stored->mesh_triangles = fields.take<std::uint64_t>();
  stored->triangles_in_places = fields.take<std::uint64_t>();
  Unpacker::require(stored->eye_distance >= 0 &&
                    (stored->bounds.empty() || (is_vector(stored->bounds.low) && is_vector(stored->bounds.high))));
  for (std::uint64_t left = take_count(fields, bytes); left > 0; --left) {
    std::string name = fields.take_text();
    stored->identity[std::move(name)] = fields.take_text();
  }
  return stored;
}

}  // namespace

std::string packed_scene(const core::Scene& scene) {
  core::expect(scene.stored != nullptr, "what is stored of a scene knows its objects");
  Packer packer;
  packer.add_text(scene.name).add(scene.view).add(scene.background).add(scene.ambient).add(scene.zenith);
  packer.add(scene.bounces.value_or(-1)).add(scene.coordinate_rounding);
  packer.add(std::uint64_t{scene.lights.size()});
  for (const core::PointLight& light : scene.lights) {
    packer.add(light.position).add(light.color).add_flag(light.has_color).add(light.falls_off_from);
    packer.add(light.cone.ahead).add(light.cone.full_degrees).add(light.cone.none_degrees).add(light.cone.edge);
  }
  add_textures(scene.textures, packer);
  packer.add(std::uint64_t{scene.materials.size()});
  for (const core::Material& material : scene.materials) {
    packer.add(material);
  }
  packer.add_text(scene.sky.name).add(scene.sky.width).add(scene.sky.height).add(scene.sky.scale).add(scene.sky.brightest);
  packer.add(scene.sky.coarse);
  add_stored(*scene.stored, packer);
  return packer.bytes();
}

core::Scene unpacked_scene(std::string_view bytes) {
  Unpacker fields(bytes);
  core::Scene scene;
  scene.name = fields.take_text();
  scene.view = fields.take<core::View>();
  scene.background = fields.take<core::Vec3d>();
  scene.ambient = fields.take<core::Vec3d>();
  scene.zenith = fields.take<core::Vec3d>();
  const int bounces = fields.take<int>();
  scene.bounces = bounces < 0 ? std::nullopt : std::optional(bounces);
  scene.coordinate_rounding = fields.take<double>();
  Unpacker::require(!fault_of(scene.view) && scene.view.width >= 1 && scene.view.height >= 1 &&
                    scene.view.width <= resolution_max && scene.view.height <= resolution_max && is_vector(scene.background) &&
                    is_vector(scene.ambient) && is_vector(scene.zenith) && bounces <= core::Scene::bounces_max);
  scene.lights = take_lights(fields, bytes.size());
  scene.textures = take_textures(fields, bytes.size());
  for (std::uint64_t left = take_count(fields, bytes.size()); left > 0; --left) {
    scene.materials.push_back(fields.take<core::Material>());
    check_material(scene.materials.back(), scene.textures.size());
  }
  scene.sky.name = fields.take_text();
  scene.sky.width = fields.take<std::uint32_t>();
  scene.sky.height = fields.take<std::uint32_t>();
  scene.sky.scale = fields.take<double>();
  scene.sky.brightest = fields.take<double>();
  scene.sky.coarse = fields.take<std::uint64_t>();
  Unpacker::require(is_number(scene.sky.scale) && is_number(scene.sky.brightest));
  scene.stored = take_stored(fields, bytes.size());
  fields.finish();
  return scene;
}

}  // namespace dmpc::apps
