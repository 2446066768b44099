#include "apps/picture/film_image.h"

#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

Image image_of(const core::Film& film) {
  Image image(film.width(), film.height());
  image.remarks = {{"filmScale", text_of(film.scale())}};
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    const core::Vec3d radiance = film.radiance(pixel);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      image.rgb[std::size_t{pixel} * 3 + channel] = static_cast<float>(radiance[channel]);
    }
  }
  return image;
}

std::string text_of(core::FilmScale scale) { return scale.exponent == 0 ? "1" : "2^" + std::to_string(scale.exponent); }

}  // namespace dmpc::apps
