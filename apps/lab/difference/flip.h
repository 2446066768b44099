// The perceived difference of two pictures, flipped between on a screen.
#pragma once

#include <vector>

#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// The paper's observer: 0.7 m before a screen of 0.7 m and 3840 pixels.
inline constexpr double flip_pixels_per_degree = 67.0206;

/// FLIP of every pixel, row by row: 0 for what no eye tells apart, up to 1 (P. Andersson, J. Nilsson, T. Akenine-Moller, M.
/// Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020). Radiance outside 0 to 1
/// is clamped first, as a screen does, and what is no number counts as black. Requires equal sizes.
std::vector<float> flip(const Image& picture, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);

}  // namespace dmpc::apps
