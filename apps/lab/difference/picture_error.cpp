#include "apps/lab/difference/picture_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Returns |a - b|: 0 for equal values, including infinities, and infinity if either is otherwise not finite.
double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) {
    return 0;
  }
  const double gap = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isfinite(gap) ? gap : std::numeric_limits<double>::infinity();
}

/// Returns gap^2 / (b + 0.01)^2, without 0/0 or infinity/infinity; it uses |b|, so that it has no pole.
double relative_square(double gap, float reference) {
  if (gap == 0 || std::isinf(gap)) {
    return gap;
  }
  const double whole = std::abs(static_cast<double>(reference)) + 0.01;
  return gap * gap / (whole * whole);
}

void check_sizes(const Image& picture, const Image& reference) {
  const auto size = [](const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); };
  if (picture.width != reference.width || picture.height != reference.height) {
    throw core::InputError("the pictures differ in size, " + size(picture) + " and " + size(reference) +
                           ": only pictures of one size can be compared");
  }
}

/// Adds sums; finish() turns them into means.
void add_channel(PictureError& sum, double gap, float reference) {
  sum.root_mean_square += gap * gap;
  sum.largest = std::max(sum.largest, gap);
  sum.mean_absolute += gap;
  sum.relative_mean_square += relative_square(gap, reference);
}

void finish(PictureError& sum) {
  const double channels = 3 * static_cast<double>(std::max<std::uint64_t>(sum.pixels, 1));
  sum.root_mean_square = std::sqrt(sum.root_mean_square / channels);
  sum.mean_absolute /= channels;
  sum.relative_mean_square /= channels;
  sum.peak_signal_to_noise_decibels = -20 * std::log10(sum.root_mean_square);
}

/// Returns the least value that 99 of 100 do not exceed; 0 for none.
template <class Value>
double percentile_99(std::vector<Value> values) {
  if (values.empty()) {
    return 0;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() * 99 + 99) / 100 - 1);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

void measure_flip(PictureError& error, const Image& picture, const Image& reference) {
  const std::vector<float> perceived = flip(picture, reference);
  for (const float value : perceived) {
    error.flip_mean += static_cast<double>(value) / static_cast<double>(perceived.size());
  }
  error.flip_percentile_99 = percentile_99(perceived);
}

}  // namespace

PictureError measure_error(const Image& picture, const Image& reference) {
  check_sizes(picture, reference);
  PictureError result;
  std::vector<double> of_pixels;
  for (std::size_t pixel = 0; pixel < picture.rgb.size(); pixel += 3) {
    double most = 0;
    for (std::size_t index = pixel; index < pixel + 3; ++index) {
      const double gap = distance(picture.rgb[index], reference.rgb[index]);
      most = std::max(most, gap);
      add_channel(result, gap, reference.rgb[index]);
    }
    of_pixels.push_back(most);
    result.differing_pixels += most != 0 ? 1 : 0;
  }
  result.pixels = of_pixels.size();
  finish(result);
  result.percentile_99 = percentile_99(std::move(of_pixels));
  measure_flip(result, picture, reference);
  return result;
}

Image difference_picture(const Image& picture, const Image& reference) {
  check_sizes(picture, reference);
  Image result(picture.width, picture.height);
  std::transform(picture.rgb.begin(), picture.rgb.end(), reference.rgb.begin(), result.rgb.begin(),
                 [](float a, float b) { return static_cast<float>(distance(a, b)); });
  return result;
}

Image flip_picture(const Image& picture, const Image& reference) {
  check_sizes(picture, reference);
  Image result(picture.width, picture.height);
  const std::vector<float> perceived = flip(picture, reference);
  for (std::size_t i = 0; i < result.rgb.size(); ++i) {
    result.rgb[i] = perceived[i / 3];
  }
  return result;
}

}  // namespace dmpc::apps
