// Smaller pictures of pictures.
#pragma once

#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// Each pixel the mean of a square of them, so that neither side is longer than `side_max`.
Image shrunk(const Image& image, int side_max);

}  // namespace dmpc::apps
