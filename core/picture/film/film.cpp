#include "core/picture/film/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>

#include "core/base/expect.h"
#include "core/base/vec.h"

namespace dmpc::core {
namespace {

std::int64_t fixed(float light, double units) {
  const double scaled = double{light} * units;
  if (!(scaled > 0.0)) {
    return 0;
  }
  return scaled >= 9.2e18 ? film_channel_max : static_cast<std::int64_t>(std::llrint(scaled));
}

class Fnv1a {
 public:
  /// From the lowest byte up. Bytes of 0 only multiply, so the leading zeros, common in films, take one multiplication.
  void add(std::uint64_t value) {
    std::size_t zeros = 8;
    for (; value != 0; value >>= 8U, --zeros) {
      hash_ = (hash_ ^ (value & 0xffU)) * prime_powers[1];
    }
    hash_ *= prime_powers[zeros];
  }
  void add(const FixedColor& plane) {
    for (const std::int64_t channel : plane.channel) {
      add(static_cast<std::uint64_t>(channel));
    }
  }
  /// As add(FixedColor{}).
  void add_no_light() { hash_ *= prime_powers[8] * prime_powers[8] * prime_powers[8]; }
  std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::array<std::uint64_t, 9> prime_powers = [] {
    std::array<std::uint64_t, 9> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i) {
      powers[i] = powers[i - 1] * 0x100000001b3ULL;
    }
    return powers;
  }();

  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

std::size_t pixel_count_of(int width, int height) {
  expect(width > 0 && height > 0, "a film has pixels");
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

Vec3d sum_of(const FixedColor& plane) {
  return {static_cast<double>(plane.channel[0]), static_cast<double>(plane.channel[1]), static_cast<double>(plane.channel[2])};
}

/// Film::radiance() of one pixel after the other: divides only where the number of samples changes.
class Means {
 public:
  explicit Means(const Film& film) : film_(film), by_scale_(1 / film.scale().factor()) {}

  Vec3d radiance(std::uint32_t pixel) {
    const std::uint32_t samples = film_.samples(pixel);
    expect(samples > 0, "a picture has samples");
    if (samples != samples_) {
      samples_ = samples;
      unit_ = film_resolution / samples;
    }
    const PixelSums sums = film_.sums(pixel);
    return (sum_of(sums.plane[0]) + sum_of(sums.plane[1])) * unit_ * by_scale_;
  }

 private:
  const Film& film_;
  double by_scale_, unit_ = 0;
  std::uint32_t samples_ = 0;
};

bool is_full(const PixelSums& sums, std::size_t channel) {
  return std::any_of(sums.plane.begin(), sums.plane.end(),
                     [channel](const FixedColor& plane) { return plane.channel[channel] == film_channel_max; });
}

}  // namespace

FixedColor to_fixed(const Color& light, FilmScale scale) {
  const double units = scale.factor() / film_resolution;
  return {{fixed(light.x, units), fixed(light.y, units), fixed(light.z, units)}};
}

bool add(FixedColor& sum, const FixedColor& deposit) {
  bool saturated = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (__builtin_add_overflow(sum.channel[i], deposit.channel[i], &sum.channel[i])) {
      sum.channel[i] = film_channel_max;
    }
    saturated = saturated || sum.channel[i] == film_channel_max;
  }
  return saturated;
}

Film::Film(int width, int height, FilmScale scale, std::uint32_t planes)
    : width_(width),
      height_(height),
      scale_(scale),
      own_samples_(pixel_count_of(width, height)),
      first_(own_samples_.size()),
      second_(planes == 2 ? own_samples_.size() : 0) {
  expect(planes == 1 || planes == 2, "a film has one plane or two");
  expect(std::abs(scale.exponent) <= FilmScale::exponent_max, "a film's scale is one that doubles hold");
}

bool Film::deposit(std::uint32_t pixel, const PixelSums& sums) {
  expect(pixel < pixel_count(), "a deposit falls on the film");
  const bool first = add(first_[pixel], sums.plane[0]);
  if (!has_second()) {
    expect(sums.plane[1] == FixedColor{}, "a film of one plane is of pictures with one sample a pixel");
    return first;
  }
  const bool second = add(second_[pixel], sums.plane[1]);
  return first || second;
}

std::uint64_t Film::samples() const {
  const std::uint64_t of_all = std::uint64_t{samples_of_all_} * pixel_count();
  const std::span<const std::uint32_t> own = has_own_samples_ ? own_samples_.span() : std::span<const std::uint32_t>();
  return std::accumulate(own.begin(), own.end(), of_all);
}

void Film::copy_radiance(std::size_t first, std::span<float> rgb) const {
  Means means(*this);
  for (std::size_t place = 0; place < rgb.size(); place += 3) {
    const Vec3d radiance = means.radiance(static_cast<std::uint32_t>(first + place / 3));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      rgb[place + channel] = static_cast<float>(radiance[channel]);
    }
  }
}

Vec3d Film::scaled_mean(std::uint32_t pixel) const {
  expect(samples(pixel) > 0, "a picture has samples");
  const Vec3d first = sum_of(first_[pixel]);
  return (has_second() ? first + sum_of(second_[pixel]) : first) * (film_resolution / samples(pixel));
}

Vec3d Film::scaled_sum(std::uint32_t pixel, std::uint32_t plane) const {
  return sum_of(sums(pixel).plane[plane]) * film_resolution;
}

bool Film::gather_planes(std::uint32_t pixel) {
  expect(samples(pixel) > 0, "a picture has samples");
  expect(has_second(), "planes that are gathered are two");
  const bool is_last_second = plane_of(samples(pixel) - 1) == 1;
  FixedColor& last = is_last_second ? second_[pixel] : first_[pixel];
  FixedColor& other = is_last_second ? first_[pixel] : second_[pixel];
  const bool is_saturated = add(last, other);
  other = {};
  return is_saturated;
}

std::uint64_t Film::hash() const {
  Fnv1a hash;
  hash.add(static_cast<std::uint64_t>(width_));
  hash.add(static_cast<std::uint64_t>(height_));
  if (scale_ != FilmScale{}) {
    hash.add(static_cast<std::uint64_t>(std::int64_t{scale_.exponent}));
  }
  for (std::size_t pixel = 0; pixel < pixel_count(); ++pixel) {
    hash.add(first_[pixel]);
    has_second() ? hash.add(second_[pixel]) : hash.add_no_light();
  }
  return hash.value();
}

FilmRange range_of(const Film& film) {
  FilmRange range;
  Means means(film);
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    const Vec3d radiance = means.radiance(pixel);
    bool is_cut = false;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      range.brightest = std::max(range.brightest, radiance[channel]);
      if (is_full(film.sums(pixel), channel)) {
        range.cut_from = is_cut || range.pixels_cut > 0 ? std::min(range.cut_from, radiance[channel]) : radiance[channel];
        is_cut = true;
      }
    }
    range.pixels_cut += is_cut ? 1 : 0;
  }
  return range;
}

}  // namespace dmpc::core
