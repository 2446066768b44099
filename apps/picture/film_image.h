// A film as a picture.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "core/picture/film/film.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel, computed on demand, with the film's scale as a remark. The film outlives it; requires
/// samples > 0.
ImageRows rows_of(const core::Film& film);

/// As above, as a whole.
Image image_of(const core::Film& film);

/// A scale for people and files: "1", "2^34".
std::string text_of(core::FilmScale scale);

}  // namespace dmpc::apps
