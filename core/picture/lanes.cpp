#include "core/picture/lanes.h"

#include <hwy/targets.h>

namespace dmpc::core {

/// Where there is AVX3, to Highway, there is all of x86-64-v4, and where there is AVX2, of v3.
VectorWidth vector_width() {
  static const auto targets = hwy::SupportedTargets();
  return (targets & HWY_AVX3) != 0 ? VectorWidth::bits_512 : (targets & HWY_AVX2) != 0 ? VectorWidth::bits_256 : VectorWidth::any;
}

}  // namespace dmpc::core
