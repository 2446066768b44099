#include "core/picture/film/film.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/expect.h"

namespace film_test {

using namespace dmpc::apps;
using namespace dmpc::core;
using dmpc::apps::Random;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();

PixelSums even(const Color& light) { return {{to_fixed(light), FixedColor{}}}; }

void put(Film& film, std::uint32_t pixel, const Color& light) {
  film.deposit(pixel, {{to_fixed(light, film.scale()), FixedColor{}}});
  film.add_samples(pixel, 2);
}

}  // namespace

TEST_CASE("one unit of light is two to the 32nd") {
  CHECK(to_fixed({1, 0.5F, 0}).channel == std::array<std::int64_t, 3>{1LL << 32U, 1LL << 31U, 0});
}

TEST_CASE("light below half the resolution is none") {
  CHECK(to_fixed({0x1p-34F, 0x1.8p-33F, 0x1p-32F}).channel == std::array<std::int64_t, 3>{0, 1, 1});
}

TEST_CASE("negative light and NaN deposit nothing, too much light saturates") {
  CHECK(to_fixed({-1, std::numeric_limits<float>::quiet_NaN(), -infinite}) == FixedColor{});
  CHECK(to_fixed({3e38F, infinite, 0x1p31F}).channel == std::array<std::int64_t, 3>{most, most, most});
}

TEST_CASE("a sum that saturates says so and stays there") {
  FixedColor sum = to_fixed({0x1p30F, 0, 0});
  CHECK_FALSE(add(sum, to_fixed({0x1p29F, 0, 0})));
  CHECK(add(sum, to_fixed({0x1p30F, 0, 0})));
  CHECK(sum.channel[0] == most);
  CHECK(add(sum, to_fixed({1, 0, 0})));
  CHECK(sum.channel[0] == most);
  CHECK(sum.channel[1] == 0);
}

TEST_CASE("sums do not depend on the order of the deposits, saturated or not") {
  for (const double brightest : {1.0, 0x1p30}) {
    Random random(1);
    std::vector<Color> deposits;
    for (int i = 0; i < 1000; ++i) {
      deposits.push_back(Color(random.in_box(0, brightest)));
    }
    FixedColor forward, backward;
    for (const Color& light : deposits) {
      add(forward, to_fixed(light));
    }
    std::reverse(deposits.begin(), deposits.end());
    for (const Color& light : deposits) {
      add(backward, to_fixed(light));
    }
    CHECK(forward == backward);
  }
}

TEST_CASE("a pixel's radiance is the mean of both planes over the samples") {
  Film film(2, 1);
  CHECK_FALSE(film.deposit(1, {{to_fixed({1, 2, 3}), to_fixed({3, 2, 1})}}));
  film.add_samples(0, 1);
  film.add_samples(1, 1);
  film.add_samples(1, 3);
  CHECK(film.radiance(1) == Vec3d{1, 1, 1});
  CHECK(film.radiance(0) == Vec3d{});
  CHECK(film.samples(1) == 4);
  CHECK(film.samples() == 5);
}

TEST_CASE("samples of all pixels and a pixel's own add up") {
  Film film(2, 2);
  film.add_samples_to_all(2);
  CHECK(film.samples(0) == 2);
  CHECK(film.samples() == 8);
  film.add_samples(3, 4);
  film.add_samples_to_all(1);
  CHECK(film.samples(0) == 3);
  CHECK(film.samples(3) == 7);
  CHECK(film.samples() == 16);
}

TEST_CASE("groups of samples that double those before fall on the planes by turns") {
  for (const auto& [sample, plane] : {std::pair(0U, 0U), {1U, 1U}, {2U, 0U}, {3U, 0U}, {4U, 1U}, {7U, 1U}, {8U, 0U}}) {
    CHECK(plane_of(sample) == plane);
  }
  for (const std::uint32_t samples : {0U, 1U, 2U, 3U, 7U, 100U}) {
    std::uint32_t counted = 0;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      counted += plane_of(sample);
    }
    CHECK(samples_on(1, samples) == counted);
    CHECK(samples_on(0, samples) == samples - counted);
  }
}

TEST_CASE("planes gathered leave the light of the leaf that follows alone on its plane") {
  Film film(1, 1);
  film.deposit(0, {{to_fixed({6, 0, 2}), to_fixed({1, 1, 1})}});
  film.add_samples(0, 2);
  film.gather_planes(0);
  CHECK(film.sums(0) == PixelSums{{FixedColor{}, to_fixed({7, 1, 3})}});
  PixelSums third;
  third.plane[plane_of(2)] = to_fixed({1, 0, 0});
  film.deposit(0, third);
  CHECK(film.scaled_sum(0, plane_of(2)) == Vec3d{1, 0, 0});
  CHECK(film.radiance(0) == Vec3d{4, 0.5, 1.5});
}

TEST_CASE("planes gathered hold 32,768 samples of 2^16, but for the last unit, and say so when a channel is full") {
  Film film(1, 1);
  const float half = 0x1p30F;  // 2^14 samples of 2^16
  film.deposit(0, {{to_fixed({half, half, 0}), to_fixed({half * (1 - 0x1p-24F), 0, 0})}});
  film.add_samples(0, 32768);
  CHECK_FALSE(film.gather_planes(0));
  CHECK(film.radiance(0).x == 0x1p16 - 0x1p-9);
  film.deposit(0, {{to_fixed({half, 0, 0}), FixedColor{}}});
  CHECK(film.gather_planes(0));
  CHECK(film.radiance(0) == Vec3d{0x1p16, 0x1p15, 0});
}

TEST_CASE("a film tells of saturation, of pixels beyond it and of no samples") {
  Film film(2, 2);
  CHECK(film.deposit(3, even({infinite, 0, 0})));
  CHECK_THROWS_AS(film.deposit(4, {}), InternalError);
  CHECK_THROWS_AS(film.radiance(0), InternalError);
  CHECK_THROWS_AS(film.gather_planes(0), InternalError);
  CHECK_THROWS_AS(Film(0, 1), InternalError);
}

TEST_CASE("a film of one plane is as one of two on which no second sample has fallen") {
  const auto deposit_on = [](Film film) {
    film.deposit(1, even({1, 2, 3}));
    film.add_samples(1, 1);
    return film;
  };
  const Film one = deposit_on(Film(2, 1, {}, planes_for(1))), two = deposit_on(Film(2, 1, {}, planes_for(2)));
  CHECK(one.hash() == two.hash());
  CHECK(one.sums(1) == even({1, 2, 3}));
  CHECK(one.radiance(1) == two.radiance(1));
  CHECK(one.scaled_sum(1, 1) == Vec3d{});
}

TEST_CASE("light of a second sample and planes that are gathered want a second plane") {
  Film film(1, 1, {}, 1);
  CHECK_THROWS_AS(film.deposit(0, {{FixedColor{}, to_fixed({1, 0, 0})}}), InternalError);
  film.add_samples(0, 1);
  CHECK_THROWS_AS(film.gather_planes(0), InternalError);
  CHECK_THROWS_AS(Film(1, 1, {}, 3), InternalError);
}

TEST_CASE("a film's hash tells its integers, its planes and its size apart") {
  Film one(2, 2), same(2, 2), other(2, 2), odd(2, 2), row(4, 1);
  one.deposit(0, even({1, 2, 3}));
  same.deposit(0, even({0.5F, 2, 3}));
  same.deposit(0, even({0.5F, 0, 0}));
  other.deposit(1, even({1, 2, 3}));
  odd.deposit(0, {{FixedColor{}, to_fixed({1, 2, 3})}});
  row.deposit(0, even({1, 2, 3}));
  CHECK(one.hash() == same.hash());
  CHECK(one.hash() != other.hash());
  CHECK(one.hash() != odd.hash());
  CHECK(one.hash() != row.hash());
}

TEST_CASE("the radiance of several pixels at once is that of each, however many samples they have, and of none without one") {
  for (const std::uint32_t planes : {1U, 2U}) {
    Random random(planes);
    Film film(40, 1, {3}, planes);
    for (std::uint32_t pixel = 0; pixel < 39; ++pixel) {
      const auto light = [&] { return to_fixed(Color(random.in_box(0, 9)), film.scale()); };
      film.deposit(pixel, {{light(), planes == 2 ? light() : FixedColor{}}});
      film.add_samples(pixel, random.below(3) + 1);
    }
    std::array<float, 3 * 20> rgb{};
    film.copy_radiance(19, rgb);
    for (std::uint32_t place = 0; place < rgb.size(); ++place) {
      CHECK(rgb[place] == static_cast<float>(film.radiance(19 + place / 3)[place % 3]));
    }
    CHECK_THROWS_AS(film.copy_radiance(20, rgb), InternalError);
  }
}

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

}  // namespace film_test
