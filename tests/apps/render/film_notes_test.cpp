#include "apps/render/film_notes.h"

#include <doctest/doctest.h>

#include "tests/support/text.h"

namespace dmpc::apps::film_notes_test {

using tests::contains;

namespace {

core::Film film_of(const core::Color& light) {
  core::Film film(2, 1);
  for (const std::uint32_t pixel : {0U, 1U}) {
    film.deposit(pixel, {{core::to_fixed(light), core::FixedColor{}}});
    film.add_samples(pixel, 1);
  }
  return film;
}

}  // namespace

TEST_CASE("nothing is said of light that a film can hold, and of the dark") {
  CHECK(film_notes(film_of({1, 0.5F, 0}), 7).empty());
  CHECK(film_notes(film_of({1e-6F, 0, 0}), 7).empty());
  CHECK(film_notes(film_of({}), 0).empty());
}

TEST_CASE("light that was cut is said, with how many pixels and from where on") {
  const auto notes = film_notes(film_of({1e12F, 0, 0}), 7);
  REQUIRE(notes.size() == 1);
  CHECK(contains(notes[0], "2 of 2 pixels are brighter than the film can hold and were cut, from a radiance of 2.14748e+09 on"));
}

TEST_CASE("a picture so dark that the film's steps show in it says so, and a black one that light has reached") {
  const auto dark = film_notes(film_of({1e-8F, 0, 0}), 7);
  REQUIRE(dark.size() == 1);
  CHECK(contains(dark[0], "no pixel is brighter than 1.00117e-08, and the film counts light in steps of 2.32831e-10"));
  CHECK(contains(dark[0], "off by 1.2 % and more"));
  const auto black = film_notes(film_of({}), 7);
  REQUIRE(black.size() == 1);
  CHECK(contains(black[0], "the picture is black, though 7 shadow rays reached a light"));
}

}  // namespace dmpc::apps::film_notes_test
