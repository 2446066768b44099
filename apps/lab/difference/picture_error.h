// The difference of a picture from a reference.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// Errors of linear floats over all channels of all pixels, except the perceived ones. A value that is not finite on one side
/// only, or differently, makes the sums infinite.
struct PictureError {
  double root_mean_square = 0;
  double largest = 0;
  /// 99 of 100 pixels have no channel with a larger error.
  double percentile_99 = 0;
  double mean_absolute = 0;
  double peak_signal_to_noise_decibels = 0;  ///< for a peak of 1; infinite for equal pictures
  double relative_mean_square = 0;           ///< mean of (a - b)^2 / (b + 0.01)^2, with b the reference, as in pbrt-v4
  double flip_mean = 0;                      ///< flip()
  double flip_percentile_99 = 0;
  std::uint64_t pixels = 0;
  std::uint64_t differing_pixels = 0;  ///< in which any channel differs at all
};

/// Throws core::InputError if the sizes differ.
PictureError measure_error(const Image& picture, const Image& reference);

/// Returns |a - b| channel by channel. Throws core::InputError if the sizes differ.
Image difference_picture(const Image& picture, const Image& reference);

/// Returns FLIP in all three channels. Throws core::InputError if the sizes differ.
Image flip_picture(const Image& picture, const Image& reference);

/// The paper's observer: 0.7 m before a screen of 0.7 m and 3840 pixels.
inline constexpr double flip_pixels_per_degree = 67.0206;

/// Returns FLIP of every pixel, row by row: 0 for imperceptible differences, up to 1 (P. Andersson, J. Nilsson, T.
/// Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020).
/// Radiance is first clamped to 0 to 1, as by a screen, and NaN counts as black. Requires equal sizes.
std::vector<float> flip(const Image& picture, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);

}  // namespace dmpc::apps
