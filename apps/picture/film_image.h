// A film as a picture.
#pragma once

#include "apps/picture/image_file.h"
#include "core/picture/film.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel; requires samples > 0.
Image image_of(const core::Film& film);

}  // namespace dmpc::apps
