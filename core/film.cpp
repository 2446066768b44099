#include "core/film.h"

#include <cmath>
#include <limits>

#include "core/expect.h"

namespace dmpc::core {
namespace {

constexpr std::int64_t channel_max = std::numeric_limits<std::int64_t>::max();

std::int64_t fixed(float light) {
  const double scaled = double{light} / film_resolution;
  if (!(scaled > 0.0)) {
    return 0;
  }
  return scaled >= 9.2e18 ? channel_max : static_cast<std::int64_t>(std::nearbyint(scaled));
}

class Fnv1a {
 public:
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ = (hash_ ^ (value >> (8 * byte) & 0xffU)) * 0x100000001b3ULL;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

FixedColor to_fixed(const Color& light) { return {{fixed(light.x), fixed(light.y), fixed(light.z)}}; }

bool add(FixedColor& sum, const FixedColor& deposit) {
  bool saturated = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (__builtin_add_overflow(sum.channel[i], deposit.channel[i], &sum.channel[i])) {
      sum.channel[i] = channel_max;
    }
    saturated = saturated || sum.channel[i] == channel_max;
  }
  return saturated;
}

Film::Film(int width, int height) : width_(width), height_(height) {
  expect(width > 0 && height > 0, "a film has pixels");
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

bool Film::deposit(std::uint32_t pixel, const PixelSums& sums) {
  expect(pixel < pixels_.size(), "a deposit falls on the film");
  const bool even = add(pixels_[pixel].plane[0], sums.plane[0]);
  const bool odd = add(pixels_[pixel].plane[1], sums.plane[1]);
  return even || odd;
}

Vec3d Film::radiance(std::uint32_t pixel, int samples) const {
  expect(samples > 0, "a picture has samples");
  const PixelSums& sums = pixels_[pixel];
  Vec3d mean;
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = static_cast<double>(sums.plane[0].channel[i]) + static_cast<double>(sums.plane[1].channel[i]);
    mean[i] = sum * film_resolution / samples;
  }
  return mean;
}

std::uint64_t Film::hash() const {
  Fnv1a hash;
  hash.add(static_cast<std::uint64_t>(width_));
  hash.add(static_cast<std::uint64_t>(height_));
  for (const PixelSums& sums : pixels_) {
    for (const FixedColor& plane : sums.plane) {
      for (const std::int64_t channel : plane.channel) {
        hash.add(static_cast<std::uint64_t>(channel));
      }
    }
  }
  return hash.value();
}

}  // namespace dmpc::core
