// A picture of one value.
#pragma once

#include "apps/picture/image_file.h"

namespace dmpc::tests {

inline apps::Image gray(int width, int height, float value) {
  apps::Image image(width, height);
  image.rgb.assign(image.rgb.size(), value);
  return image;
}

}  // namespace dmpc::tests
