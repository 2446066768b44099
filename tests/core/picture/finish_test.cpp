// What surfaces have beyond NFF: values that are known on paper.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "core/database/database.h"
#include "core/database/shading/material_records.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "core/scene/texel.h"
#include "tests/support/film_of.h"
#include "tests/support/mesh_surfaces.h"

namespace finish_test {

using namespace dmpc;
using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr double near_enough = 1e-5;

bool is_near(const Vec3d& a, const Vec3d& b, double distance = near_enough) { return length(a - b) < distance; }

/// The light of the pixel in the middle of a view along -z from (0 0 2).
Vec3d seen(Scene scene, int depth_max = 5) {
  scene.view = {.from = {0, 0, 2}, .at = {0, 0, 0}, .up = {0, 1, 0}};
  const Database database = build_database(scene, {});
  const Camera camera(scene.view, database.header().frame, 1, 1, 1);
  return film_of(database, {database.header(), camera, {.depth_max = depth_max, .pixel_share = 0}, {}}).radiance(0);
}

/// A triangle in z = 0 around the view's middle, which is the middle of its corners.
const std::vector<Vec3d> corners{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}};

Scene scene_with(const Material& material, const Vec3d& background = {}) {
  Scene scene;
  scene.background = background;
  SceneBuilder builder(scene);
  builder.material(material);
  builder.polygon(corners);
  return scene;
}

/// Straight ahead, so that a mirror sends all of it back.
Scene lit(Scene scene) {
  scene.lights = {{{0, 0, 2}, {1, 1, 1}, true}};
  return scene;
}

Scene with_corners(const Material& material, const std::vector<TexturedCorner>& colors, const Vec3d& background = {}) {
  Scene scene;
  scene.background = background;
  SceneBuilder builder(scene);
  builder.material(material);
  builder.textured(corners, colors);
  return scene;
}

/// The triangle with one texel all over it.
Scene painted(Material material, std::uint32_t texel, const Vec3d& background) {
  Scene scene;
  scene.background = background;
  scene.textures = {alpha_texture(1, 1, {texel})};
  material.texture = 0;
  SceneBuilder builder(scene);
  builder.material(material);
  builder.textured(corners, {{{}, {0, 0}}, {{}, {1, 0}}, {{}, {1, 1}}});
  return scene;
}

const Vec3d gold{1, 0.75, 0.25};

}  // namespace

TEST_CASE("a gold plane that mirrors a white sky is gold") {
  CHECK(is_near(seen(scene_with({.color = gold, .diffuse = 0, .tinted_specular = 1}, {1, 1, 1})), gold));
  CHECK(is_near(seen(scene_with({.color = {0, 0, 0}, .specular = 0.5, .specular_color = gold}, {1, 1, 1})), gold * 0.5));
  const Material both{.color = gold, .diffuse = 0, .specular = 0.25, .specular_color = {0, 1, 0}, .tinted_specular = 0.5};
  CHECK(is_near(seen(scene_with(both, {1, 1, 1})), gold * 0.5 + Vec3d{0, 0.25, 0}));
}

TEST_CASE("a highlight has the colour of its surface, and need not mirror") {
  const Material paint{.color = {0.5, 0.5, 0.5}, .diffuse = 0, .specular = 0.5, .shine = 50, .specular_color = gold, .mirror = 0};
  CHECK(is_near(seen(lit(scene_with(paint, {9, 9, 9}))), gold * 0.5));
  Material mirror = paint;
  mirror.mirror = 0.5;
  CHECK(is_near(seen(scene_with(mirror, {1, 1, 1})), gold * 0.25));
}

TEST_CASE("a surface's own light is added as it is, whatever falls on it") {
  const Vec3d own{0.25, 2, 0.0625};
  CHECK(seen(scene_with({.color = {0, 0, 0}, .emission = own})) == own);
  const Material paint{.color = {0.5, 0.25, 0.125}, .emission = own};
  CHECK(is_near(seen(lit(scene_with(paint))), own + paint.color));
  CHECK(is_near(seen(scene_with({.color = {0, 0, 0}, .specular = 0.5, .emission = own}, {1, 1, 1})), own + Vec3d{0.5, 0.5, 0.5}));
}

TEST_CASE("corners' colours lie between them by the corners' weights") {
  const std::vector<TexturedCorner> primary{colored_corner({}, {1, 0, 0}), colored_corner({}, {0, 1, 0}),
                                            colored_corner({}, {0, 0, 1})};
  CHECK(is_near(seen(lit(with_corners({.color = {1, 1, 1}}, primary))), Vec3d{1, 1, 1} * (1.0 / 3), 1e-4));
  CHECK(is_near(seen(lit(with_corners({.color = {0.3, 0.6, 0.9}}, primary))), {0.1, 0.2, 0.3}, 1e-4));
  // As metals have it, the mirror's colour is the surface's.
  CHECK(is_near(seen(with_corners({.color = {1, 1, 1}, .diffuse = 0, .tinted_specular = 1}, primary, {1, 1, 1})),
                Vec3d{1, 1, 1} * (1.0 / 3), 1e-4));
}

TEST_CASE("where a texel's alpha is 0 there is what lies behind") {
  const Vec3d behind{0.25, 0.5, 0.75};
  const std::uint32_t nothing = texel_of(255, 255, 255, 0), half = texel_of(255, 255, 255, 128);
  const Material veil{.color = {1, 1, 1}, .specular = 0.5, .alpha = AlphaUse::blend, .emission = {1, 1, 1}};
  CHECK(is_near(seen(lit(painted(veil, nothing, behind))), behind));
  const double share = 128.0 / 255;
  CHECK(is_near(seen(painted({.color = {1, 1, 1}, .alpha = AlphaUse::blend}, half, behind)), behind * (1 - share)));
  CHECK(is_near(seen(lit(painted({.color = {1, 1, 1}, .alpha = AlphaUse::blend}, half, behind))),
                behind * (1 - share) + Vec3d{share, share, share}));
}

TEST_CASE("a cutoff leaves all or nothing") {
  const Vec3d behind{0.25, 0.5, 0.75}, white{1, 1, 1};
  const auto cut = [&](double cutoff, std::uint32_t alpha) {
    return seen(
        lit(painted({.color = white, .alpha = AlphaUse::cut, .alpha_cutoff = cutoff}, texel_of(255, 255, 255, alpha), behind)));
  };
  CHECK(is_near(cut(0.5, 127), behind));
  CHECK(is_near(cut(0.5, 128), white));
  CHECK(is_near(cut(1, 254), behind));
  CHECK(is_near(cut(1, 255), white));
  CHECK(is_near(cut(1e-9, 1), white));
  CHECK(is_near(cut(1e-9, 0), behind));
}

TEST_CASE("alpha of corners blends as a texture's does") {
  const Vec3d behind{0.25, 0.5, 0.75};
  const std::vector<TexturedCorner> thin{colored_corner({}, {1, 1, 1}, 0), colored_corner({}, {1, 1, 1}, 0.25),
                                         colored_corner({}, {1, 1, 1}, 0.5)};
  CHECK(is_near(seen(with_corners({.color = {1, 1, 1}, .alpha = AlphaUse::blend}, thin, behind)), behind * 0.75, 1e-4));
}

TEST_CASE("a coarser level counts texels by what of them is there") {
  const Texture texture = alpha_texture(2, 1, {texel_of(255, 0, 0, 255), texel_of(0, 255, 0, 0)});
  const std::uint32_t mean = texture.levels.at(1).texels.at(0);
  CHECK(decoded(texture.format, mean) == Color{1, 0, 0});
  CHECK(alpha_of(texture.format, mean) == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("a material that NFF can say has the record that it always had") {
  const MaterialRecords records = material_records(
      {{.color = gold, .diffuse = 0.5, .specular = 0.25, .shine = 9, .transmittance = 0.125, .refraction_index = -2},
       {.color = gold, .specular = 0.5, .refraction_index = 3, .emission = {1, 2, 3}},
       {}});
  REQUIRE(records.materials.size() == 3);
  REQUIRE(records.finishes.size() == 1);
  const float plain[] = {1, 0.75F, 0.25F, 0.5F, 0.25F, 9, 0.125F, -2};
  CHECK(std::memcmp(&records.materials[0], plain, sizeof plain) == 0);
  CHECK(!records.materials[0].has_extension());
  CHECK(!records.materials[2].has_extension());
  REQUIRE(records.materials[1].has_extension());
  CHECK(records.materials[1].finish() == 3);
  CHECK(records.finishes[0].refraction_index == 3);
  CHECK(records.finishes[0].emission == Color{1, 2, 3});
}

TEST_CASE("the finishes of a database are no materials of its scene, and it knows so once its records are forgotten") {
  const Scene plain = scene_with({.color = gold}, {0.5, 3, 1}),
              fine = scene_with({.color = gold, .emission = {1, 2, 3}}, {0.5, 3, 1});
  for (const Scene& scene : {plain, fine}) {
    Database database = build_database(scene, {});
    database.forget_records();
    CHECK(database.records().materials == scene.materials.size());
  }
}

TEST_CASE("no ray finds more light than the bound, whatever tint, emission or alpha the surfaces have") {
  const auto bound = [](const Material& material) { return radiance_bound(lit(scene_with(material, {0.5, 3, 1})), 2); };
  const auto deep_bound = [](const Material& material) { return radiance_bound(scene_with(material, {0.5, 3, 1}), 3); };
  CHECK(bound({.color = {0.5, 0.25, 0}, .emission = {1, 4, 2}}) == doctest::Approx(4.5));
  CHECK(bound({.color = {0, 0, 0}, .specular = 8, .specular_color = {0.25, 0.5, 0}, .mirror = 0}) == doctest::Approx(4));
  CHECK(bound({.color = {0.5, 0.25, 0}, .diffuse = 0, .tinted_specular = 10}) == doctest::Approx(5));
  CHECK(deep_bound({.color = {0, 0, 0}, .emission = {1, 0, 0}}) == doctest::Approx(3));
  CHECK(deep_bound({.color = {0, 0, 0}, .alpha = AlphaUse::blend, .emission = {1, 0, 0}}) == doctest::Approx(4));
  CHECK(deep_bound({.color = {0, 0, 0}, .specular = 0.5, .mirror = 0, .emission = {2, 0, 0}}) == doctest::Approx(3));
}

}  // namespace finish_test
