#include "core/picture/film/film_scale.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/families/scenes.h"

namespace film_scale_test {

using namespace dmpc::core;

TEST_CASE("a film has the scale 1 for light within bounds, and where there is none or no bound") {
  for (const double bound : {0x1p-8, 1.0, 1e6, 0x1p31, 0.0, std::numeric_limits<double>::infinity()}) {
    CAPTURE(bound);
    CHECK(film_scale_for(bound, bound, 32768) == FilmScale{});
  }
}

TEST_CASE("light that is too little is brought to next below 1") {
  CHECK(film_scale_for(0x1.8p-9, 0x1.8p-9, 1) == FilmScale{8});
  CHECK(film_scale_for(1e-10, 1e-10, 4096) == FilmScale{33});
  for (const double bound : {0x1.fp-9, 1e-7, 1e-20, 1e-38}) {
    CAPTURE(bound);
    const double scaled = bound * film_scale_for(bound, bound, 32768).factor();
    CHECK(scaled >= 0.5);
    CHECK(scaled < 1);
  }
}

TEST_CASE("light that is too much is brought to where no sum of a pixel's samples saturates") {
  for (const double bound : {0x1.1p31, 1e12, 1e20, 3e38}) {
    for (const std::uint32_t samples : {1U, 16U, 32768U}) {
      CAPTURE(bound);
      CAPTURE(samples);
      const double sum = bound * samples * film_scale_for(bound, bound, samples).factor();
      CHECK(sum < 0x1p31);
      CHECK(sum >= 0x1p30);
    }
  }
}

TEST_CASE("what mirrors and glass multiply without end does not make a film coarse for what lights bring") {
  CHECK(film_scale_for(0x1p80, 1, 1) == FilmScale{});
  CHECK(film_scale_for(0x1p80, 0x1p20, 1) == FilmScale{-10});
}

TEST_CASE("a scale is a power of two, whatever its exponent") {
  for (const int exponent : {-256, -33, 0, 1, 34, 256}) {
    CHECK(FilmScale{exponent}.factor() == std::ldexp(1.0, exponent));
  }
}

TEST_CASE("the built-in scenes have films of scale 1") {
  for (SceneName name : default_scenes()) {
    name.size = 1;
    CHECK(film_scale_for(built_in_scene(name), 255, 32768) == FilmScale{});
  }
}

}  // namespace film_scale_test
