#include "core/scene/facet_texture.h"

#include <doctest/doctest.h>

#include "core/scene/texel.h"
#include "tests/support/noise_texture.h"

namespace dmpc::core::facet_texture_test {

namespace {

/// Red is of no account, green is roughness, blue is metal.
constexpr std::uint32_t texel(std::uint32_t roughness, std::uint32_t metallic) { return 77U | roughness << 8U | metallic << 16U; }

/// As a picture that was read for colours.
Texture picture(std::vector<std::uint32_t> texels, TexelFormat format = TexelFormat::srgb) {
  const auto width = static_cast<std::uint32_t>(texels.size());
  Texture texture{.name = "a", .format = format, .levels = {{width, 1, std::move(texels)}}};
  add_levels(texture);
  return texture;
}

/// A colour's texture, and behind it that of metal and roughness.
Scene scene_of(Texture facets, FacetTexture use = FacetTexture::placed) {
  Scene scene;
  scene.textures = {picture({0x102030, 0x405060}), std::move(facets)};
  scene.materials = {{.texture = 0, .microfacets = {.roughness = 0.5, .metallic = 0.8, .texture = 1, .use = use}}};
  settle_facet_textures(scene);
  return scene;
}

}  // namespace

TEST_CASE("metal and roughness are 255ths of what a picture's bytes say, without the curve of colours, and so are their means") {
  const Scene scene = scene_of(picture({texel(0, 255), texel(255, 51)}));
  const Texture& numbers = scene.textures.at(1);
  CHECK(numbers.format == TexelFormat::linear);
  CHECK(numbers.levels.at(0).texels.at(1) == texel(255, 51));
  const Color mean = decoded(numbers.format, numbers.levels.at(1).texels.at(0));
  CHECK(mean.y == doctest::Approx(0.5).epsilon(0.005));  // of light on the curve it were 0.735
  CHECK(mean.z == doctest::Approx(0.6));
  CHECK(numbers.darkest == Color{77.0F / 255, 0, 51.0F / 255});
  CHECK(scene.textures.at(0).format == TexelFormat::srgb);
}

TEST_CASE("pictures of more bits, and of floats, say the same numbers") {
  const std::uint32_t fine = 4 * 64U << 10U | 4 * 200U << 20U;  // steps, four of which are a byte's
  CHECK(scene_of(picture({fine}, TexelFormat::fine_srgb)).textures.at(1).levels[0].texels[0] == (64U << 8U | 200U << 16U));
  const std::uint32_t light = encoded(TexelFormat::shared_exponent, {0, 0.25, 1});
  CHECK(scene_of(picture({light}, TexelFormat::shared_exponent)).textures.at(1).levels[0].texels[0] == (64U << 8U | 255U << 16U));
}

TEST_CASE("a mean that is meant is multiplied into the factors, and its texture is gone") {
  const Scene scene = scene_of(picture({texel(0, 255), texel(255, 51), texel(51, 0)}), FacetTexture::mean);
  const Microfacets& facets = scene.materials.at(0).microfacets;
  CHECK(facets.roughness == doctest::Approx(0.5 * 0.4));
  CHECK(facets.metallic == doctest::Approx(0.8 * 0.4));
  CHECK_FALSE(facets.have_texture());
  CHECK(facets.use == FacetTexture::placed);
  CHECK(scene.textures.size() == 1);
}

TEST_CASE("textures of colours keep their order before those of numbers, whose materials find them again") {
  Scene scene;
  scene.textures = {picture({texel(1, 2)}), picture({0x0000ff}), picture({texel(3, 4)}), picture({0x00ff00})};
  scene.materials = {{.texture = 3, .microfacets = {.roughness = 1, .texture = 0}},
                     {.texture = 1, .microfacets = {.roughness = 1, .texture = 2, .use = FacetTexture::mean}},
                     {.texture = 3, .microfacets = {.roughness = 1, .texture = 0, .use = FacetTexture::mean}},
                     {}};
  settle_facet_textures(scene);
  REQUIRE(scene.textures.size() == 3);
  CHECK(scene.textures[scene.materials[0].texture].levels[0].texels[0] == 0x00ff00);
  CHECK(scene.textures[scene.materials[1].texture].levels[0].texels[0] == 0x0000ff);
  CHECK(scene.materials[1].texture == 0);
  CHECK(scene.textures[scene.materials[0].microfacets.texture].levels[0].texels[0] == texel(1, 2));
  CHECK(scene.materials[2].microfacets.roughness == doctest::Approx(1.0 / 255));
  CHECK(scene.materials[3] == Material{});
}

TEST_CASE("a scene without such textures stays as it is") {
  Scene scene;
  scene.textures = {tests::noise_texture(4, 4), tests::noise_texture(2, 2)};
  scene.materials = {{.texture = 1}, {.microfacets = {.roughness = 0.5}}};
  const std::vector<Material> before = scene.materials;
  settle_facet_textures(scene);
  CHECK(scene.materials == before);
  CHECK(scene.textures.size() == 2);
}

}  // namespace dmpc::core::facet_texture_test
