#include "core/scene/facet_texture.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

/// Undoes the sRGB decoding of bytes; floats are unchanged.
std::uint32_t as_numbers(TexelFormat format, std::uint32_t texel) {
  const bool had_curve = format != TexelFormat::shared_exponent;
  return encoded(had_curve ? TexelFormat::srgb : TexelFormat::linear, Vec3d(decoded(format, texel)));
}

void make_linear(Texture& texture) {
  if (texture.format == TexelFormat::linear) {
    return;
  }
  texture.levels.resize(1);
  for (std::uint32_t& texel : texture.levels.front().texels) {
    texel = as_numbers(texture.format, texel);
  }
  texture.format = TexelFormat::linear;
  texture.brightest = 0;
  add_levels(texture);
}

Vec3d mean_of(const Texture& texture) {
  Vec3d sum;
  for (const std::uint32_t texel : texture.levels.front().texels) {
    sum = sum + Vec3d(decoded(texture.format, texel));
  }
  return sum * (1.0 / static_cast<double>(texture.levels.front().texels.size()));
}

void take_mean(Microfacets& facets, const Texture& texture) {
  const Vec3d mean = mean_of(texture);
  facets.roughness *= mean.y;
  facets.metallic *= mean.z;
  facets.texture = Microfacets::no_texture;
  facets.use = FacetTexture::placed;
}

/// Colours keep their order and precede numbers; numbers that no material uses are removed.
void arrange(Scene& scene) {
  std::vector<bool> used(scene.textures.size());
  for (const Material& material : scene.materials) {
    if (material.microfacets.have_texture()) {
      used[material.microfacets.texture] = true;
    }
  }
  std::vector<std::uint32_t> places(used.size());
  std::vector<Texture> arranged;
  for (const bool are_numbers : {false, true}) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      const bool is_linear = scene.textures[i].format == TexelFormat::linear;
      if (is_linear == are_numbers && (used[i] || !is_linear)) {
        places[i] = static_cast<std::uint32_t>(arranged.size());
        arranged.push_back(std::move(scene.textures[i]));
      }
    }
  }
  scene.textures = std::move(arranged);
  for (Material& material : scene.materials) {
    for (std::uint32_t* const texture : {&material.texture, &material.microfacets.texture}) {
      *texture = *texture == Material::no_texture ? Material::no_texture : places[*texture];
    }
  }
}

}  // namespace

void settle_facet_textures(Scene& scene) {
  for (const Material& material : scene.materials) {
    if (material.microfacets.have_texture()) {
      make_linear(scene.textures[material.microfacets.texture]);
    }
  }
  for (Material& material : scene.materials) {
    expect(material.texture == Material::no_texture || scene.textures[material.texture].format != TexelFormat::linear,
           "no texture is one of a colour and one of metal and roughness");
    if (material.microfacets.have_texture() && material.microfacets.use == FacetTexture::mean) {
      take_mean(material.microfacets, scene.textures[material.microfacets.texture]);
    }
  }
  arrange(scene);
}

}  // namespace dmpc::core
