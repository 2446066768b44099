#include "core/picture/sampling/refinement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "tests/support/film_error.h"
#include "tests/support/film_of.h"
#include "tests/support/small_scenes.h"

namespace refinement_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Gray light on both planes of a pixel.
void shine(Film& film, std::uint32_t pixel, float first, float second) {
  film.deposit(pixel, {{to_fixed({first, first, first}), to_fixed({second, second, second})}});
}

/// Every sample of the pass brings light of 1.
void shine_evenly(Film& film, const Refinement& refinement) {
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    const SampleRange samples = refinement.pass().samples(pixel);
    const auto brought = [&](std::uint32_t plane) {
      return static_cast<float>(samples_on(plane, samples.first + samples.count) - samples_on(plane, samples.first));
    };
    shine(film, pixel, brought(0), brought(1));
  }
}

/// The pixels whose samples are doubled twice, because they are chosen or explored.
std::vector<std::uint32_t> pixels_doubled(const Refinement& refinement) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t pixel = 0; pixel < refinement.pass().steps().size(); ++pixel) {
    const SampleStep step = refinement.pass().steps()[pixel];
    if (step.to() == step.from() + doublings_max) {
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

bool are_doubled(const Refinement& refinement, const std::vector<std::uint32_t>& pixels) {
  const std::vector<std::uint32_t> doubled = pixels_doubled(refinement);
  return std::includes(doubled.begin(), doubled.end(), pixels.begin(), pixels.end());
}

/// The doubled pixels that do not touch a given one: if no other shows an error, they are explored.
std::vector<std::uint32_t> pixels_explored(const Refinement& refinement, std::uint32_t bad, std::uint32_t width) {
  std::vector<std::uint32_t> pixels = pixels_doubled(refinement);
  const auto touches = [&](std::uint32_t pixel) {
    const std::uint32_t columns = std::max(pixel % width, bad % width) - std::min(pixel % width, bad % width);
    const std::uint32_t rows = std::max(pixel / width, bad / width) - std::min(pixel / width, bad / width);
    return columns <= 1 && rows <= 1;
  };
  pixels.erase(std::remove_if(pixels.begin(), pixels.end(), touches), pixels.end());
  return pixels;
}

/// The error by an estimate of pixels that have eight samples, two of them in the first pass, where the mean of the first two
/// differs from that of all by `change_from_two`, and that of the first four by 0.1.
double error_by_changes(double change_from_two) {
  Film film(40, 40);
  Refinement refinement({.error = 1e-3}, 2, 40, 40);
  for (std::uint32_t pixel = 0; pixel < 1600; ++pixel) {
    shine(film, pixel, 1, 0);
  }
  REQUIRE(refinement.next_pass(film));
  REQUIRE(refinement.pass().samples(0) == SampleRange{2, 6});
  const double mean = 0.5 - change_from_two, third_and_fourth = 2 * (mean + 0.1) - 0.5, others = mean - 0.1;
  for (std::uint32_t pixel = 0; pixel < 1600; ++pixel) {
    shine(film, pixel, static_cast<float>(2 * third_and_fourth), static_cast<float>(4 * others));
  }
  refinement.next_pass(film);
  return refinement.result().error;
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
  return film_of(database, {database.header(), Camera(scene.view, database.header().frame, side, side, samples), {}, refinement});
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

TEST_CASE("where both samples and all neighbours agree one pass is enough") {
  Film film(5, 5);
  Refinement refinement({.error = 1e-6}, 2, 5, 5);
  shine_evenly(film, refinement);
  CHECK_FALSE(refinement.next_pass(film));
  CHECK(refinement.result().error == 0);
}

TEST_CASE("a picture that is cut short is the one of as many passes, and can be gone on with") {
  const auto shone = [](Film& film, Refinement& refinement, const EndsBefore& ends_before) {
    for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
      shine(film, pixel, 1, pixel % 2 == 0 ? 0.5F : 1);
    }
    return refinement.next_pass(film, ends_before);
  };
  Film cut(6, 6), whole(6, 6), few(6, 6);
  Refinement of_cut({.error = 0.01}, 2, 6, 6), of_whole = of_cut, of_few({.error = 0.01, .passes = 1}, 2, 6, 6);
  REQUIRE(shone(whole, of_whole, {}));
  CHECK_FALSE(shone(few, of_few, {}));
  CHECK_FALSE(of_few.result().is_cut_short);
  PassEnd end;
  CHECK_FALSE(shone(cut, of_cut, [&end](const PassEnd& at) {
    end = at;
    return true;
  }));
  CHECK(of_cut.result().is_cut_short);
  CHECK(of_cut.result().passes == 1);
  CHECK(end.result.error == of_cut.result().error);
  CHECK(end.samples_done == 72);
  CHECK(end.samples_chosen > 0);
  CHECK(cut.hash() == few.hash());
  of_cut.begin_chosen(cut);
  CHECK(cut.hash() == whole.hash());
  CHECK(of_cut.pass() == of_whole.pass());
  CHECK(of_cut.result().passes == 2);
}

TEST_CASE("the square error of a pixel of two samples is by a half less than what its mean has changed by from one") {
  Film film(1, 1);
  Refinement refinement({.error = 0.01}, 2, 1, 1);
  shine(film, 0, 1, 0.5F);
  CHECK(refinement.next_pass(film));
  CHECK(refinement.result().error == doctest::Approx(0.25 / std::sqrt(1.5)));
}

TEST_CASE("an error is found by how a mean has changed, and how much less than before") {
  // Where samples meet this and that at random V(n) is 1 / n, so V(8) is V(4) - V(8), of which V(2) - V(8) is three times as
  // much.
  CHECK(error_by_changes(0.1 * std::sqrt(3.0)) == doctest::Approx(0.1).scale(0).epsilon(0.02));
  // Where edges make it V(n) is n^-1.5, so V(8) is the second change over 2^1.5 - 1, and the first is 2^1.5 + 1 times the second.
  CHECK(error_by_changes(0.1 * std::sqrt(std::exp2(1.5) + 1)) ==
        doctest::Approx(0.1 / std::sqrt(std::exp2(1.5) - 1)).scale(0).epsilon(0.02));
}

TEST_CASE("a pixel whose samples differ is refined with those around it, as much as a pass may") {
  Film film(7, 5);
  Refinement refinement({.error = 1e-3}, 2, 7, 5);
  shine(film, 2 * 7 + 3, 1, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(2 * 7 + 3) == SampleRange{2, 6});
  CHECK(are_doubled(refinement, {9, 10, 11, 16, 17, 18, 23, 24, 25}));
  CHECK(refinement.pass().pixel_count() < 20);  // and what is explored
  CHECK(refinement.result().passes == 2);
}

TEST_CASE("contrast between pixels asks for samples even if theirs agree by chance") {
  Film film(8, 1);
  Refinement refinement({.error = 1e-3}, 2, 8, 1);
  for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
    shine(film, pixel, 1, 1);
  }
  REQUIRE(refinement.next_pass(film));
  CHECK(are_doubled(refinement, {3, 4}));
  CHECK(pixels_doubled(refinement).size() <= 4);  // with what is explored of the six others
}

TEST_CASE("one pass brings pixels of all levels as many samples as each of them needs") {
  Film film(30, 1);
  Refinement refinement({.error = 0.03}, 2, 30, 1);
  shine(film, 0, 1, 0);
  shine(film, 29, 0.22F, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(0) == SampleRange{2, 6});
  CHECK(refinement.pass().samples(29) == SampleRange{2, 2});
  shine(film, 0, 2, 0);
  shine(film, 29, 2, 0);
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.pass().samples(0) == SampleRange{8, 24});
  CHECK(refinement.pass().samples(29) == SampleRange{4, 12});
}

TEST_CASE("what is worth far less than the rest waits for the next pass, though all is needed") {
  // One of ten pixels has an error, and another a smaller one.
  const auto is_chosen = [](float faint) {
    Film film(400, 1);
    Refinement refinement({.error = 1e-4}, 2, 400, 1);
    for (std::uint32_t pixel = 0; pixel < 400; pixel += 5) {
      shine(film, pixel, pixel % 10 == 0 ? 1 : faint, 0);
    }
    CHECK(refinement.next_pass(film));
    std::uint32_t chosen = 0;
    for (std::uint32_t pixel = 5; pixel < 400; pixel += 10) {
      chosen += refinement.pass().has(pixel) ? 1 : 0;
    }
    return chosen > 20;
  };
  CHECK(is_chosen(0.7F));
  CHECK_FALSE(is_chosen(0.1F));
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
  const std::vector<std::uint32_t> explored = pixels_explored(refinement, 5050, 100);
  CHECK(explored.size() > 200);
  CHECK(explored.size() < 400);
  shine(film, 5050, 700, 0);
  REQUIRE(refinement.next_pass(film));
  const std::vector<std::uint32_t> others = pixels_explored(refinement, 5050, 100);
  CHECK_FALSE(others.empty());
  CHECK_FALSE(std::includes(explored.begin(), explored.end(), others.begin(), others.end()));
}

TEST_CASE("what explored pixels show of error is expected of those that look as even as they did") {
  Film film(100, 100);
  Refinement refinement({.error = 4.0 / 255}, 2, 100, 100);
  shine(film, 5050, 100, 0);
  REQUIRE(refinement.next_pass(film));
  std::uint32_t found = 0;
  for (const std::uint32_t pixel : pixels_explored(refinement, 5050, 100)) {
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

TEST_CASE("a picture to be refined has two samples a pixel from the start") {
  CHECK_THROWS_AS(Refinement({.error = 0.1}, 1, 2, 2), InternalError);
  CHECK_THROWS_AS(Refinement({.error = 0.1}, 4, 2, 2), InternalError);
  CHECK_THROWS_AS(Refinement({.error = 0.1, .samples_max = 1}, 2, 2, 2), InternalError);
  CHECK_THROWS_AS(Refinement({}, 0, 2, 2), InternalError);
}

TEST_CASE("two samples come nearer to a disc than the middles of pixels do") {
  const Film truth = rendered(disc(), 80, 256, {});
  CHECK(root_mean_square(rendered(disc(), 80, 2, {}), truth) < 0.85 * root_mean_square(rendered(disc(), 80, 1, {}), truth));
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
