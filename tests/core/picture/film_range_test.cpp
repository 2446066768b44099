#include "core/picture/film.h"

#include <doctest/doctest.h>

namespace film_range_test {

using namespace dmpc::core;

namespace {

void put(Film& film, std::uint32_t pixel, const Color& light) {
  film.deposit(pixel, {{to_fixed(light, film.scale()), FixedColor{}}});
  film.add_samples(pixel, 2);
}

}  // namespace

TEST_CASE("a film tells its brightest radiance, as it is without the scale") {
  for (const int exponent : {-20, 0, 20}) {
    Film film(2, 1, {exponent});
    put(film, 0, {1, 2, 3});
    put(film, 1, {8, 0, 0});
    const FilmRange range = range_of(film);
    CHECK(range.brightest == 4);
    CHECK(range.pixels_cut == 0);
    CHECK(range.cut_from == 0);
  }
}

TEST_CASE("pixels of which a channel is full are counted once, with the least radiance that was cut") {
  Film film(3, 1, {10});
  put(film, 0, {1e9F, 1e9F, 0});
  put(film, 1, {0x1p20F, 0, 0});
  put(film, 2, {1e9F, 0, 0});
  film.add_samples(2, 2);
  const FilmRange range = range_of(film);
  CHECK(range.pixels_cut == 2);
  CHECK(range.cut_from == doctest::Approx(0x1p21 / 4));
  CHECK(range.brightest == doctest::Approx(0x1p21 / 2));
}

}  // namespace film_range_test
