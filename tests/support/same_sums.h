// Whether two films of one size hold the same.
#pragma once

#include <cstdint>

#include "core/picture/film/film.h"

namespace dmpc::tests {

inline bool same_sums(const core::Film& a, const core::Film& b) {
  for (std::uint32_t pixel = 0; pixel < a.pixel_count(); ++pixel) {
    if (a.sums(pixel) != b.sums(pixel)) {
      return false;
    }
  }
  return a.pixel_count() == b.pixel_count();
}

}  // namespace dmpc::tests
