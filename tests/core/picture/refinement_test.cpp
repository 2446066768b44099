#include "core/picture/refinement.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/base/expect.h"
#include "core/build/database.h"
#include "core/picture/render.h"
#include "tests/support/small_scenes.h"

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Gray light on both planes of a pixel.
void shine(Film& film, std::uint32_t pixel, float even, float odd) {
  film.deposit(pixel, {{to_fixed({even, even, even}), to_fixed({odd, odd, odd})}});
}

/// Every pixel of the pass gets light of 1 and 1 for two samples, on average.
void shine_evenly(Film& film, const Refinement& refinement) {
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    if (refinement.pixels().has(pixel)) {
      const auto half = static_cast<float>(refinement.samples().count / 2);
      shine(film, pixel, half, half);
    }
  }
}

std::vector<std::uint32_t> pixels_of(const Refinement& refinement, const Film& film) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    if (refinement.pixels().has(pixel)) {
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

/// A black disc on a white background, no lights: every error is the disc's edge.
Scene disc() {
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.sphere({0, 0, 0}, 1);
  scene.view = {.from = {0, 0, 4}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 40};
  return scene;
}

Film rendered(const Scene& scene, int side, int samples, const RefinementOptions& refinement) {
  const Database database = build_database(scene, {});
  LocalRecords records(database.bytes());
  GridTracer<LocalRecords> tracer(records, database.header(), {});
  Operations operations;
  return render(tracer, {database.header(), Camera(scene.view, database.header().frame, side, side, samples), {}, refinement},
                operations);
}

double root_mean_square(const Film& film, const Film& truth) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    const Vec3d difference = film.radiance(pixel) - truth.radiance(pixel);
    sum += dot(difference, difference) / 3;
  }
  return std::sqrt(sum / static_cast<double>(film.pixels().size()));
}

}  // namespace

TEST_CASE("a mask has the pixels that were added, or all, and none beyond") {
  PixelMask none(70), all(70, true);
  CHECK(none.count() == 0);
  CHECK(all.count() == 70);
  none.add(69);
  none.add(69);
  CHECK(none.has(69));
  CHECK_FALSE(none.has(68));
  CHECK(none.count() == 1);
}

TEST_CASE("a picture without an error to come down to has one pass, with any number of samples") {
  Film film(3, 2);
  Refinement refinement({}, 3, 3, 2);
  CHECK(refinement.pixels().count() == 6);
  CHECK(refinement.samples() == SampleRange{0, 3});
  CHECK_FALSE(refinement.next_pass(film));
  CHECK(film.samples() == 18);
  CHECK(refinement.result().passes == 1);
  CHECK(refinement.result().error == 0);
}

TEST_CASE("where both planes and all neighbours agree one pass is enough") {
  Film film(5, 5);
  Refinement refinement({.error = 1e-6}, 2, 5, 5);
  shine_evenly(film, refinement);
  CHECK_FALSE(refinement.next_pass(film));
  CHECK(refinement.result().error == 0);
}

TEST_CASE("the error of a picture of one pixel is half of the difference of its planes' means") {
  Film film(1, 1);
  Refinement refinement({.error = 0.01}, 2, 1, 1);
  shine(film, 0, 1, 0.5F);
  CHECK(refinement.next_pass(film));
  CHECK(refinement.result().error == doctest::Approx(0.25));
}

TEST_CASE("a pixel whose planes differ is refined with those around it, its samples doubled") {
  Film film(7, 5);
  Refinement refinement({.error = 1e-3}, 2, 7, 5);
  shine(film, 2 * 7 + 3, 1, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.samples() == SampleRange{2, 2});
  CHECK(pixels_of(refinement, film) == std::vector<std::uint32_t>{9, 10, 11, 16, 17, 18, 23, 24, 25});
  CHECK(refinement.pixel_count() == 9);
  CHECK(refinement.result().passes == 2);
}

TEST_CASE("contrast between pixels asks for samples even if their planes agree by chance") {
  Film film(8, 1);
  Refinement refinement({.error = 1e-3}, 2, 8, 1);
  for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
    shine(film, pixel, 1, 1);
  }
  REQUIRE(refinement.next_pass(film));
  CHECK(pixels_of(refinement, film) == std::vector<std::uint32_t>{3, 4});
}

TEST_CASE("pixels of the lowest level come first, and each pass takes one level") {
  Film film(9, 1);
  Refinement refinement({.error = 1e-4}, 2, 9, 1);
  shine(film, 0, 100, 0);
  shine(film, 8, 1, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(pixels_of(refinement, film) == std::vector<std::uint32_t>{0, 1, 7, 8});
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.samples() == SampleRange{4, 4});
  CHECK(film.samples(0) == 4);
  CHECK(film.samples(4) == 2);
}

TEST_CASE("a picture that may not have more samples is left as it is, with its error") {
  Film film(1, 1);
  Refinement refinement({.error = 1e-9, .samples_max = 9}, 2, 1, 1);
  shine(film, 0, 1, 0);
  CHECK(refinement.next_pass(film));
  CHECK(refinement.next_pass(film));
  CHECK_FALSE(refinement.next_pass(film));
  CHECK(film.samples(0) == 8);
  CHECK(refinement.result().error > 1e-9);
}

TEST_CASE("a pixel that stays bad with all its samples costs only those around it") {
  Film film(20, 20);
  Refinement refinement({.error = 1e-3, .samples_max = 64}, 2, 20, 20);
  for (std::uint32_t pixel = 0; pixel < 400; ++pixel) {
    shine(film, pixel, 0, 1e-6F);
  }
  do {
    shine_evenly(film, refinement);
    shine(film, 10 * 20 + 10, 100 * static_cast<float>(refinement.samples().count), 0);
  } while (refinement.next_pass(film));
  CHECK(film.samples(10 * 20 + 10) == 64);
  CHECK(film.samples(0) == 2);
  CHECK(film.samples() < 400 * 2 + 9 * 64 + 1);
  CHECK(refinement.result().error > 1e-3);
}

TEST_CASE("a picture to be refined needs samples on both planes from the start") {
  CHECK_THROWS_AS(Refinement({.error = 0.1}, 1, 2, 2), InternalError);
  CHECK_THROWS_AS(Refinement({.error = 0.1, .samples_max = 2}, 4, 2, 2), InternalError);
  CHECK_THROWS_AS(Refinement({}, 0, 2, 2), InternalError);
}

TEST_CASE("a disc's edge gets the samples, and the error is what was asked for") {
  const Film truth = rendered(disc(), 32, 1024, {});
  for (const double error : {8.0 / 255, 2.0 / 255, 0.5 / 255}) {
    CAPTURE(error);
    const Film film = rendered(disc(), 32, 2, {.error = error});
    CHECK(root_mean_square(film, truth) < 1.3 * error);
    CHECK(root_mean_square(film, truth) > 0.4 * error);
    CHECK(film.samples(0) == 2);             // the sky
    CHECK(film.samples(16 * 32 + 16) == 2);  // the disc
  }
}

TEST_CASE("a disc refined needs two fifths of the samples that an even picture of the same error needs") {
  const Film truth = rendered(disc(), 32, 1024, {}), even = rendered(disc(), 32, 64, {});
  const Film refined = rendered(disc(), 32, 2, {.error = root_mean_square(even, truth)});
  CHECK(root_mean_square(refined, truth) < 1.3 * root_mean_square(even, truth));
  CHECK(refined.samples() < even.samples() * 2 / 5);
}
