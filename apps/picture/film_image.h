// A film as a picture.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "core/picture/film/film.h"

namespace dmpc::apps {

/// Returns the mean linear radiance of each pixel, computed on demand, with the film's scale as a remark. The film outlives it;
/// requires samples > 0.
ImageRows rows_of(const core::Film& film);

/// As above, but with all pixels.
Image image_of(const core::Film& film);

/// Returns a scale as text: "1", "2^34".
std::string text_of(core::FilmScale scale);

}  // namespace dmpc::apps
