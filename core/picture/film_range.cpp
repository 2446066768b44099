#include "core/picture/film_range.h"

#include <algorithm>

#include "core/base/vec.h"

namespace dmpc::core {
namespace {

bool is_full(const PixelSums& sums, std::size_t channel) {
  return std::any_of(sums.plane.begin(), sums.plane.end(),
                     [channel](const FixedColor& plane) { return plane.channel[channel] == film_channel_max; });
}

}  // namespace

FilmRange range_of(const Film& film) {
  FilmRange range;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    const Vec3d radiance = film.radiance(pixel);
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
