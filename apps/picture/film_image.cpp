#include "apps/picture/film_image.h"

#include <cstddef>
#include <span>

namespace dmpc::apps {

ImageRows rows_of(const core::Film& film) {
  const auto take = [&film](std::size_t first, std::span<float> rgb) { film.copy_radiance(first, rgb); };
  return {film.width(), film.height(), take, {{"filmScale", text_of(film.scale())}}};
}

Image image_of(const core::Film& film) { return image_of(rows_of(film)); }

std::string text_of(core::FilmScale scale) { return scale.exponent == 0 ? "1" : "2^" + std::to_string(scale.exponent); }

}  // namespace dmpc::apps
