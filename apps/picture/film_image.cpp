#include "apps/picture/film_image.h"

#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

ImageRows rows_of(const core::Film& film) {
  const auto take = [&film](std::size_t first, std::span<float> rgb) {
    for (std::size_t place = 0; place < rgb.size(); place += 3) {
      const core::Vec3d radiance = film.radiance(static_cast<std::uint32_t>(first + place / 3));
      for (std::size_t channel = 0; channel < 3; ++channel) {
        rgb[place + channel] = static_cast<float>(radiance[channel]);
      }
    }
  };
  return {film.width(), film.height(), take, {{"filmScale", text_of(film.scale())}}};
}

Image image_of(const core::Film& film) { return image_of(rows_of(film)); }

std::string text_of(core::FilmScale scale) { return scale.exponent == 0 ? "1" : "2^" + std::to_string(scale.exponent); }

}  // namespace dmpc::apps
