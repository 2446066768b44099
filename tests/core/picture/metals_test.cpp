// Pictures of surfaces of tiny mirrors, by paths, against what can be said on paper.
#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/database/database.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/film_of.h"
#include "tests/support/microfacet_hits.h"
#include "tests/support/path_studio.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"

namespace metals_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr Transport white_sky{.kind = TransportKind::paths, .has_sky = true};
const Vec3d white{1, 1, 1}, gold{1, 0.75, 0.25};

Film film_of(const Scene& scene, int side, int samples, const Transport& transport, int bounces, bool for_paths = true) {
  const Database database = build_database(scene, {.emitters_max = for_paths ? 100U : 0U, .for_paths = for_paths});
  return dmpc::tests::film_of(database, scene.view, {transport, side, side, samples, bounces});
}

Vec3d mean_of(const Film& film) {
  Vec3d sum;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    sum = sum + film.radiance(pixel) * (1.0 / static_cast<double>(film.pixel_count()));
  }
  return sum;
}

/// A floor of the material under white, of which the eye sees next to nothing, at this cosine.
Scene floor_of(const Material& material, double cosine) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material(material);
  builder.polygon({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
  scene.view = {.from = eye_at(cosine) * 3.0, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1e-3};
  return scene;
}

/// The floor of gold, with a texture of metal and roughness with these texels side by side.
Scene textured_floor(std::vector<std::uint32_t> texels, Microfacets facets) {
  Scene scene;
  const auto width = static_cast<std::uint32_t>(texels.size());
  scene.textures = {
      {.name = "white", .levels = {{1, 1, {0xffffff}}}},
      {.name = "facets", .format = TexelFormat::linear, .wrap_s = TextureWrap::clamp, .levels = {{width, 1, std::move(texels)}}}};
  for (Texture& texture : scene.textures) {
    add_levels(texture);
  }
  facets.texture = 1;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material({.color = gold, .texture = 0, .microfacets = facets});
  builder.textured({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}},
                   {{{}, {0, 1}}, {{}, {1, 1}}, {{}, {1, 0}}, {{}, {0, 0}}});
  scene.view = {.from = {0, 0, 3}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1e-3};
  return scene;
}

}  // namespace

TEST_CASE("under a white sky tiny mirrors that reflect all show what one scattering leaves, however often light may bounce") {
  for (const auto& [alpha, cosine, share] : {std::tuple{0.04, 1.0, .9983},
                                             {0.04, 0.5, .9955},
                                             {0.04, 0.1, .929},
                                             {0.25, 1.0, .9158},
                                             {0.25, 0.5, .8573},
                                             {0.25, 0.1, .8916},
                                             {0.5, 1.0, .6879},
                                             {0.5, 0.5, .6983},
                                             {0.5, 0.1, .8601},
                                             {1.0, 1.0, .3069},
                                             {1.0, 0.5, .4507},
                                             {1.0, 0.1, .760}}) {
    CAPTURE(alpha);
    CAPTURE(cosine);
    const int samples = 16384 / static_cast<int>(slowness);
    for (const int bounces : {0, 3}) {
      const Vec3d light = mean_of(film_of(floor_of(microfacets(white, 1, alpha), cosine), 1, samples, white_sky, bounces));
      CHECK(light.x == doctest::Approx(share).epsilon(0.005).scale(0));
      CHECK(light.z == light.x);
    }
  }
}

TEST_CASE("a white lacquer that is smooth is white under a white sky, and gold has its colour") {
  const int samples = 16384 / static_cast<int>(slowness);
  for (const double cosine : {1.0, 0.5, 0.2}) {
    CHECK(mean_of(film_of(floor_of(microfacets(white, 0, 0), cosine), 1, samples, white_sky, 0)).x ==
          doctest::Approx(1).epsilon(0.002).scale(0));
  }
  const Vec3d smooth = mean_of(film_of(floor_of(microfacets(gold, 1, 0), 1), 1, 16, white_sky, 2));
  CHECK(length(smooth - gold) < 1e-6);
  const Vec3d rough = mean_of(film_of(floor_of(microfacets(gold, 1, 0.25), 1), 1, samples, white_sky, 2));
  CHECK(rough.y / rough.x == doctest::Approx(0.75).epsilon(0.005).scale(0));
  CHECK(rough.z / rough.x == doctest::Approx(0.25).epsilon(0.02).scale(0));
}

TEST_CASE("a point light shows as bright on a metal as its normals are dense, and the backdrop in mirrors alone") {
  Scene scene = floor_of(microfacets(gold, 1, 0.25), 1);
  scene.lights = {{{0, 0, 6}, {2, 2, 2}, true}};
  const Vec3d lit = mean_of(film_of(scene, 1, 1, paths, 0));  // pi D V F with D = 1 / (pi alpha^2), V = 1/4
  CHECK(length(lit - gold * (2 / (4 * 0.0625))) < 1e-3);
  CHECK(mean_of(film_of(floor_of(microfacets(gold, 1, 0.25), 1), 1, 4, paths, 3)) == Vec3d{});
  CHECK(length(mean_of(film_of(floor_of(microfacets(gold, 1, 0), 1), 1, 4, paths, 3)) - gold) < 1e-6);
}

TEST_CASE(
    "what shines above tiny mirrors has one mean, aimed at, met by chance, or both; both vary little more than the better") {
  constexpr Transport aiming_alone{.kind = TransportKind::paths, .only_aims = true};
  const int side = scaled_edge(8), samples = 64;
  for (const auto& [metallic, alpha] : {std::pair{1.0, 0.05}, {1.0, 0.5}, {0.0, 0.1}}) {
    CAPTURE(metallic);
    CAPTURE(alpha);
    Scene scene = floor_of(microfacets(gold, metallic, alpha), 1);
    SceneBuilder builder(scene);
    builder.material({.color = {0, 0, 0}, .emission = {3, 3, 3}, .microfacets = {.roughness = 0.5}});
    builder.sphere({0.3, 0.2, 1}, 0.4);
    scene.view = {.from = {0, -3, 1.2}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 30};
    const Studio aiming(scene, 10), meeting(scene);
    WaysToLight{.reference = aiming.square(side, 2048, 0, 3),
                .both = aiming.square(side, samples, 0, 1),
                .aimed = aiming.square(side, samples, 0, 1, aiming_alone),
                .met = meeting.square(side, samples, 0, 1)}
        .check(slowness == 1 ? 1.1 : 2.0);
  }
}

TEST_CASE("a ball of half-transparent rough plastic that absorbs nothing cannot be told from the white around it") {
  Material plastic = microfacets(white, 0, 0.25);
  plastic.microfacets.transmission = plastic.transmittance = 0.5;
  plastic.refraction_index = 1.5;
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material(plastic);
  builder.sphere({0, 0, 0}, 1);
  scene.view = {.from = {0, 0, 4}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1e-3};
  const int samples = 16384 / static_cast<int>(slowness);
  CHECK(mean_of(film_of(scene, 1, samples, white_sky, 60)).x == doctest::Approx(1).epsilon(0.02).scale(0));
}

TEST_CASE("a smooth metal aims at nothing: what shines is met in its mirror") {
  Scene scene = floor_of(microfacets(gold, 1, 0), 0.8);
  SceneBuilder builder(scene);
  builder.material(grey(0, 2));
  builder.sphere({-2, 0, 1.5}, 0.5);
  scene.view.from = {2, 0, 1.5};
  const Studio studio(scene, 10);
  const Film film = studio.film(1, 4, paths, 0);
  CHECK(film.radiance(0).x == doctest::Approx(2));
  CHECK(studio.operations.rays[static_cast<std::size_t>(RayKind::shadow)] == 0);
}

TEST_CASE("where a texture says what is metal, it is, and elsewhere a lacquer shines over the same colour") {
  Scene scene = textured_floor({0xff0000, 0x000000}, {.roughness = 0, .metallic = 1});  // blue: the left half is metal
  const auto seen_at = [&scene](double x) {
    scene.view = {.from = {x, 0, 3}, .at = {x, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1e-3};
    return mean_of(film_of(scene, 1, 4096 / static_cast<int>(slowness), white_sky, 0));
  };
  CHECK(length(seen_at(-25) - gold) < 1e-5);  // the middles of both texels
  const Vec3d lacquer = gold * 0.96 + Vec3d{0.04, 0.04, 0.04};
  CHECK(length(seen_at(25) - lacquer) < 0.01);
  CHECK(length(seen_at(0) - (gold + lacquer) * 0.5) < 0.01);  // half metal, half not
}

TEST_CASE("a texture that is alike everywhere is what factors would be") {
  Scene textured = textured_floor({0xcc8000}, {.roughness = 0.9, .metallic = 0.75, .transmission = 0.5, .opacity = 0.8});
  Scene plain = textured;
  plain.materials[0].microfacets.texture = Microfacets::no_texture;
  plain.materials[0].microfacets.roughness *= 128.0 / 255;
  plain.materials[0].microfacets.metallic *= 0.8;
  for (Scene* const scene : {&textured, &plain}) {
    SceneBuilder builder(*scene);
    builder.material(grey(0, 2));
    builder.sphere({-2, 0, 1.5}, 0.5);
    scene->view.from = {2, 0, 1.5};
    scene->view.angle_degrees = 40;
    scene->lights = {{{3, 1, 5}, {1, 1, 1}, true}};
  }
  const Film one = film_of(textured, 8, 16, white_sky, 2), other = film_of(plain, 8, 16, white_sky, 2);
  for (std::uint32_t pixel = 0; pixel < one.pixel_count(); ++pixel) {
    CHECK(length(one.radiance(pixel) - other.radiance(pixel)) < 1e-4);
  }
  CHECK(radiance_bound(textured, 3, white_sky) >= radiance_bound(plain, 3, white_sky) * (1 - 1e-6));
  CHECK(build_database(textured, {.for_paths = true}).records().faceted == 2);
  CHECK(build_database(textured, {}).records().faceted == 0);
  CHECK(build_database(textured, {}).records().texture_tiles == build_database(plain, {}).records().texture_tiles);
}

TEST_CASE("pictures by Whitted's transport know nothing of them: the records and the film are those that approximate them") {
  const Scene faceted = faceted_surfaces();
  Scene plain = faceted;
  for (Material& material : plain.materials) {
    material.microfacets = {};
  }
  const Database one = build_database(faceted, {}), other = build_database(plain, {});
  CHECK(std::ranges::equal(one.bytes(), other.bytes()));
  CHECK(film_of(faceted, 24, 2, {}, 4, false).hash() == film_of(plain, 24, 2, {}, 4, false).hash());
  CHECK(film_of(faceted, 24, 2, white_sky, 2).hash() != film_of(plain, 24, 2, white_sky, 2).hash());
  CHECK(build_database(plain, {.for_paths = true}).header().material_count == other.header().material_count);
}

TEST_CASE("no sample finds more light than the bound says") {
  Scene scene = faceted_surfaces();
  SceneBuilder builder(scene);
  builder.material(grey(0, 5));
  builder.sphere({1, -1.2, 1.5}, 0.3);
  for (const int bounces : {0, 2, 6}) {
    check_bounded(film_of(scene, 16, 1, white_sky, bounces), radiance_bound(scene, bounces + 2, white_sky));
  }
}

}  // namespace metals_test
