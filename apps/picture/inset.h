// One picture within another.
#pragma once

#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// Puts `part` into `image`, its upper left pixel there. Requires room for all of it.
void inset(Image& image, int left, int top, const Image& part);

}  // namespace dmpc::apps
