// A film as a picture.
#pragma once

#include <string>

#include "apps/picture/image_file.h"
#include "core/picture/film/film.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel, with the film's scale as a remark, as it is asked for. The film outlives it; requires
/// samples > 0.
ImageRows rows_of(const core::Film& film);

/// All of it at once.
Image image_of(const core::Film& film);

/// "1", "2^34": a scale as people read it, and as files have it.
std::string text_of(core::FilmScale scale);

}  // namespace dmpc::apps
