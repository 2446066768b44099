// The product's picture of one scene against the same picture in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/lab/oracle/reference/picture.h"
#include "apps/lab/oracle/reference/pixel_judge.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct Precision {
  std::uint64_t pixels = 0;
  std::uint64_t primitives = 0;
  std::uint64_t rays = 0;              ///< the reference renderer's, of all kinds
  std::uint64_t differing_pixels = 0;  ///< in 8 bits with the sRGB curve, in any channel
  double root_mean_square = 0;         ///< linear radiance, over all channels of all pixels
  double largest = 0;
  std::array<std::uint64_t, pixel_cause_count> causes{};  ///< counts of differing pixels by cause
  double largest_step = 0;                                ///< largest in any audit of these pixels
  std::vector<std::string> errors;                        ///< "pixel (3, 4): ..." for each unexplained one, row by row
  bool is_by_paths = false;  ///< pixels that differ have no causes; there is one error if their mean differs
};

/// Renders `scene` in float, with the same bits as every strategy, and in double with the same samples. Judges every pixel that
/// differs in 8 bits; for paths, which rounding leads elsewhere, judges all pixels by their mean. Uses all cores; the result is
/// the same for every number of them. `picture` requests one sample a pixel. Progress counts rows of the reference picture.
/// Throws Interrupted when a stop is requested.
Precision measure_precision(const core::Scene& scene, const PictureOptions& picture, const Attendance& attendance = {});

}  // namespace dmpc::apps
