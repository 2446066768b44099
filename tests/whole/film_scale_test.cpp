// A film's scale: the same for every strategy, and light is what it would be if lights were brighter and the scale 1.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/picture/film/film_scale.h"
#include "core/picture/render.h"
#include "core/picture/shade.h"
#include "dataflow/run.h"
#include "svm/run.h"
#include "tests/support/film_of.h"
#include "tests/support/same_sums.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::film_scale_test {

namespace {

constexpr int side = 12;

/// Mirrors and glass in `factor` times the light that they have.
core::Scene lit_by(double factor) {
  core::Scene scene = mirrors_and_glass();
  scene.background = scene.background * factor;
  for (core::PointLight& light : scene.lights) {
    light.color = intensity_of(light, scene) * factor;
  }
  for (core::PointLight& light : scene.lights) {
    light.has_color = true;
  }
  return scene;
}

/// Times as much light, a power of two, that no sample has more than 1/2 to 1 of it.
const double plain = std::ldexp(1.0, -1 - std::ilogb(core::radiance_bound(lit_by(1), 6)));

struct Picture {
  core::Database database;
  core::RenderSettings settings;

  explicit Picture(const core::Scene& scene, const core::RefinementOptions& refinement = {})
      : database(core::build_database(scene, {.structure = core::Structure::extents})),
        settings{database.header(),
                 core::Camera(scene.view, database.header().frame, side, side, 2),
                 {.first_samples = 2, .film_scale = core::film_scale_for(scene, 5, 64)},
                 refinement} {}

  core::Film film() const {
    core::Operations operations;
    const core::FineDetail detail = settings.fine_detail(database);
    return film_of(database, settings, operations, &detail);
  }
};

}  // namespace

TEST_CASE("in the dark and in glaring light a film has what it has in light between, but for the scale") {
  const core::Film bright = Picture(lit_by(plain)).film();
  REQUIRE(bright.scale() == core::FilmScale{});
  for (const int exponent : {30, 60}) {
    const core::Film dim = Picture(lit_by(std::ldexp(plain, -exponent))).film();
    CHECK(dim.scale().exponent == exponent);
    CHECK(same_sums(dim, bright));
    CHECK(dim.hash() != bright.hash());
    CHECK(dim.radiance(40).x == std::ldexp(bright.radiance(40).x, -exponent));
  }
  const core::Film glaring = Picture(lit_by(std::ldexp(plain, 50))).film();
  CHECK(glaring.scale().exponent < 0);
  for (std::uint32_t pixel = 0; pixel < side * side; ++pixel) {
    CHECK(std::fabs(glaring.radiance(pixel).x * 0x1p-50 - bright.radiance(pixel).x) < 1e-7);
  }
}

TEST_CASE("every strategy has the film of the reference renderer, scaled") {
  for (const double factor : {0x1p-40, 0x1p50}) {
    const Picture picture(lit_by(factor));
    const std::uint64_t expected = picture.film().hash();
    CHECK(svm::run_svm(picture.database, picture.settings, {.computer = {.node_count = 3}}, {}).film.hash() == expected);
    CHECK(svm::run_forest(picture.database, picture.settings, {.computer = {.node_count = 3}}, {}).film.hash() == expected);
    CHECK(svm::run_replicated(picture.database, picture.settings, {.computer = {.node_count = 2}}, {}).film.hash() == expected);
    CHECK(dataflow::run_dataflow(picture.database, picture.settings, {.computer = {.node_count = 3}}, {}).film.hash() ==
          expected);
  }
}

TEST_CASE("a picture in the dark is refined to its own error as one in plain light is") {
  const core::RefinementOptions good{.error = 0x1p-11, .samples_max = 64};
  const core::Film bright = Picture(lit_by(plain), good).film();
  CHECK(bright.samples() > std::uint64_t{2} * side * side);
  CHECK(same_sums(bright, Picture(lit_by(std::ldexp(plain, -30)), {.error = 0x1p-41, .samples_max = 64}).film()));
  CHECK(Picture(lit_by(std::ldexp(plain, -30)), good).film().samples() == std::uint64_t{2} * side * side);
}

}  // namespace dmpc::tests::film_scale_test
