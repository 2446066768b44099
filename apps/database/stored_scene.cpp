#include "apps/database/stored_scene.h"

#include <memory>
#include <utility>

#include "apps/formats/view_faults.h"
#include "core/base/expect.h"
#include "core/record/texture_layout.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t names_before_textures = 2;

void require(bool holds) {
  if (!holds) {
    throw core::InputError("its scene is damaged");
  }
}

core::Texture texture_of(const std::string& name, const StoredTexture& from) {
  require(from.format <= core::TexelFormat::linear && from.width >= 1 && from.width <= core::Texture::size_max &&
          from.height >= 1 && from.height <= core::Texture::size_max);
  core::Texture texture{name, from.format, from.wrap_s, from.wrap_t, from.brightest, from.darkest, {}};
  for (std::uint32_t level = 0; level < core::level_count(from.width, from.height); ++level) {
    texture.levels.push_back({core::level_size(from.width, level), core::level_size(from.height, level), {}});
  }
  return texture;
}

}  // namespace

StoredScene StoredScene::of(const core::Scene& scene) {
  core::expect(scene.stored != nullptr, "what is stored of a scene knows its objects");
  StoredScene all{.summary = {.view = scene.view,
                              .background = scene.background,
                              .ambient = scene.ambient,
                              .zenith = scene.zenith,
                              .coordinate_rounding = scene.coordinate_rounding,
                              .sky_scale = scene.sky.scale,
                              .sky_brightest = scene.sky.brightest,
                              .sky_coarse = scene.sky.coarse,
                              .sky_width = scene.sky.width,
                              .sky_height = scene.sky.height,
                              .bounces = scene.bounces.value_or(-1),
                              .objects = *scene.stored},
                  .lights = scene.lights,
                  .materials = scene.materials,
                  .textures = {},
                  .names = {scene.name, scene.sky.name},
                  .identity = scene.stored->identity};
  for (const core::Texture& texture : scene.textures) {
    const core::TextureLevel& finest = texture.levels.front();
    all.textures.push_back(
        {texture.format, texture.wrap_s, texture.wrap_t, texture.brightest, texture.darkest, finest.width, finest.height});
    all.names.push_back(texture.name);
  }
  return all;
}

core::Scene StoredScene::scene() const {
  const core::View& view = summary.view;
  require(!fault_of(view) && view.width >= 1 && view.height >= 1 && summary.bounces <= core::Scene::bounces_max &&
          names.size() == textures.size() + names_before_textures);
  core::Scene scene{.name = names[0],
                    .view = view,
                    .background = summary.background,
                    .ambient = summary.ambient,
                    .lights = lights,
                    .materials = materials,
                    .zenith = summary.zenith,
                    .bounces = summary.bounces < 0 ? std::nullopt : std::optional(summary.bounces),
                    .coordinate_rounding = summary.coordinate_rounding};
  scene.sky = {.name = names[1],
               .width = summary.sky_width,
               .height = summary.sky_height,
               .texels = {},
               .scale = summary.sky_scale,
               .brightest = summary.sky_brightest,
               .coarse = summary.sky_coarse};
  for (std::size_t i = 0; i < textures.size(); ++i) {
    scene.textures.push_back(texture_of(names[i + names_before_textures], textures[i]));
  }
  const auto is_texture = [&](std::uint32_t index) { return index == core::Material::no_texture || index < textures.size(); };
  for (const core::Material& material : materials) {
    require(is_texture(material.texture) && is_texture(material.microfacets.texture));
  }
  scene.stored = std::make_shared<const core::StoredObjects>(core::StoredObjects{summary.objects, identity});
  return scene;
}

}  // namespace dmpc::apps
