#include "core/picture/refinement.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "tests/support/film_error.h"
#include "tests/support/small_scenes.h"

namespace refinement_test {

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
    const auto half = static_cast<float>(refinement.pass().samples(pixel).count / 2);
    shine(film, pixel, half, half);
  }
}

/// Those that get more samples than exploration gives.
std::vector<std::uint32_t> pixels_doubled(const Refinement& refinement, std::uint32_t doublings = doublings_max) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t pixel = 0; pixel < refinement.pass().steps().size(); ++pixel) {
    const SampleStep step = refinement.pass().steps()[pixel];
    if (step.to() == step.from() + doublings) {
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

}  // namespace

TEST_CASE("a picture without an error to come down to has one pass, with any number of samples") {
  Film film(3, 2);
  Refinement refinement({}, 3, 3, 2);
  CHECK(refinement.pass().pixel_count() == 6);
  CHECK(refinement.pass().samples(5) == SampleRange{0, 3});
  CHECK(refinement.past().empty());
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

TEST_CASE("a pixel whose planes differ is refined with those around it, as much as a pass may") {
  Film film(7, 5);
  Refinement refinement({.error = 1e-3}, 2, 7, 5);
  shine(film, 2 * 7 + 3, 1, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(2 * 7 + 3) == SampleRange{2, 14});
  CHECK(pixels_doubled(refinement) == std::vector<std::uint32_t>{9, 10, 11, 16, 17, 18, 23, 24, 25});
  CHECK(refinement.result().passes == 2);
}

TEST_CASE("contrast between pixels asks for samples even if their planes agree by chance") {
  Film film(8, 1);
  Refinement refinement({.error = 1e-3}, 2, 8, 1);
  for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
    shine(film, pixel, 1, 1);
  }
  REQUIRE(refinement.next_pass(film));
  CHECK(pixels_doubled(refinement) == std::vector<std::uint32_t>{3, 4});
}

TEST_CASE("one pass brings pixels of all levels as many samples as each of them needs") {
  Film film(30, 1);
  Refinement refinement({.error = 0.03}, 2, 30, 1);
  shine(film, 0, 1, 0);
  shine(film, 29, 0.28F, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(0) == SampleRange{2, 14});
  CHECK(refinement.pass().samples(29) == SampleRange{2, 2});
  shine(film, 0, 14, 0);
  shine(film, 29, 2, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(0) == SampleRange{16, 112});
  CHECK(refinement.pass().samples(29) == SampleRange{4, 28});
}

TEST_CASE("no pass goes beyond the samples a pixel may have, and twelve passes end any picture") {
  Film film(20, 20);
  Refinement refinement({.error = 1e-6, .samples_max = 32768}, 2, 20, 20);
  std::uint32_t seed = 1;
  while (refinement.next_pass(film)) {
    for (std::uint32_t pixel = 0; pixel < 400; ++pixel) {
      CHECK(refinement.pass().samples_end() <= 32768);
      seed = seed * 1664525 + 1013904223;
      if (seed >> 28U == 0 && refinement.pass().has(pixel)) {
        shine(film, pixel, 0, static_cast<float>(refinement.pass().samples(pixel).count));
      }
    }
  }
  CHECK(refinement.result().passes <= passes_max);
}

TEST_CASE("of pixels that look even some get four times their samples, others in each pass") {
  Film film(100, 100);
  Refinement refinement({.error = 4.0 / 255}, 2, 100, 100);
  shine(film, 5050, 100, 0);
  REQUIRE(refinement.next_pass(film));
  const std::vector<std::uint32_t> explored = pixels_doubled(refinement, 2);
  CHECK(explored.size() > 200);
  CHECK(explored.size() < 400);
  shine(film, 5050, 700, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(pixels_doubled(refinement, 2) != explored);
}

TEST_CASE("what explored pixels show of error is expected of those that look as even as they did") {
  Film film(100, 100);
  Refinement refinement({.error = 4.0 / 255}, 2, 100, 100);
  shine(film, 5050, 100, 0);
  REQUIRE(refinement.next_pass(film));
  std::uint32_t found = 0;
  for (const std::uint32_t pixel : pixels_doubled(refinement, 2)) {
    if (++found % 4 == 0) {
      shine(film, pixel, 1, 0);  // one of six samples
    }
  }
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.result().error > 0.05);
}

TEST_CASE("a picture that may not have more samples is left as it is, with its error") {
  Film film(1, 1);
  Refinement refinement({.error = 1e-9, .samples_max = 9}, 2, 1, 1);
  shine(film, 0, 1, 0);
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
    shine(film, 10 * 20 + 10, 100 * static_cast<float>(refinement.pass().samples(10 * 20 + 10).count), 0);
  } while (refinement.next_pass(film));
  CHECK(film.samples(10 * 20 + 10) == 64);
  CHECK(film.samples(0) <= 8);
  CHECK(film.samples() < 400 * 2 + 9 * 64 + 400 * 3);
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
    CHECK(film.samples(0) <= 32);             // the sky
    CHECK(film.samples(16 * 32 + 16) <= 32);  // the disc
  }
}

TEST_CASE("a disc refined needs half of the samples that an even picture of the same error needs") {
  const Film truth = rendered(disc(), 32, 1024, {}), even = rendered(disc(), 32, 64, {});
  const Film refined = rendered(disc(), 32, 2, {.error = root_mean_square(even, truth)});
  CHECK(root_mean_square(refined, truth) < 1.3 * root_mean_square(even, truth));
  CHECK(refined.samples() < even.samples() / 2);
}

}  // namespace refinement_test
