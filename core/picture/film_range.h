// How a picture's light lies in what its film can hold: what was too much for it, and what was hardly anything.
#pragma once

#include <cstdint>

#include "core/picture/film.h"

namespace dmpc::core {

struct FilmRange {
  std::uint64_t pixels_cut = 0;  ///< with a channel whose sum is full
  double cut_from = 0;           ///< the least radiance that such a channel shows, which is less than it should; 0: none is full
  double brightest = 0;          ///< the largest radiance of a channel
};

/// Of a film whose pixels all have samples.
FilmRange range_of(const Film& film);

}  // namespace dmpc::core
