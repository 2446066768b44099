// Makes smaller versions of pictures.
#pragma once

#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// Returns an image whose pixels are the means of squares of pixels, so that neither side is longer than `side_max`.
Image shrunk(const Image& image, int side_max);

}  // namespace dmpc::apps
