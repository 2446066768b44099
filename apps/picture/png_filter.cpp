#include "apps/picture/png_filter.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t pixel_bytes = 3;

/// Paeth's predictor: of left, above and the corner between them, the one nearest to left + above - corner.
int nearest(int left, int above, int corner) {
  const int to_left = std::abs(above - corner), to_above = std::abs(left - corner),
            to_corner = std::abs(left + above - 2 * corner);
  const int upper = to_above <= to_corner ? above : corner;
  return to_left <= to_above && to_left <= to_corner ? left : upper;
}

}  // namespace

PngFilter::PngFilter(std::size_t row_bytes)
    : row_bytes_(row_bytes),
      here_(pixel_bytes + row_bytes),
      above_(pixel_bytes + row_bytes),
      trial_(row_bytes),
      best_(row_bytes) {}

/// Fills the trial, and returns the sum. The loop has no branch and no call, so that it can be vectorized.
template <class Predict>
std::uint32_t PngFilter::differ(Predict predict) {
  const std::uint8_t* const corner = above_.data();
  const std::uint8_t* const above = corner + pixel_bytes;
  const std::uint8_t* const left = here_.data();
  const std::uint8_t* const here = left + pixel_bytes;
  std::uint8_t* const trial = trial_.data();
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < row_bytes_; ++i) {
    const auto difference = static_cast<std::uint8_t>(here[i] - predict(left[i], above[i], corner[i]));
    trial[i] = difference;
    sum += std::min<std::uint8_t>(difference, static_cast<std::uint8_t>(-difference));
  }
  return sum;
}

template <class Predict>
void PngFilter::try_filter(std::uint8_t number, Predict predict) {
  const std::uint32_t sum = differ(predict);
  if (sum < best_sum_) {
    best_sum_ = sum;
    best_number_ = number;
    std::swap(trial_, best_);
  }
}

void PngFilter::filter(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above, std::span<std::uint8_t> room) {
  core::expect(row.size() == row_bytes_ && (above.empty() || above.size() == row_bytes_) && room.size() == 1 + row_bytes_,
               "a row that is filtered has the bytes of a row");
  std::copy(row.begin(), row.end(), here_.begin() + pixel_bytes);
  if (above.empty()) {
    std::fill(above_.begin(), above_.end(), std::uint8_t{0});
  } else {
    std::copy(above.begin(), above.end(), above_.begin() + pixel_bytes);
  }
  best_sum_ = std::numeric_limits<std::uint32_t>::max();
  try_filter(0, [](int, int, int) { return 0; });
  try_filter(1, [](int left, int, int) { return left; });
  try_filter(2, [](int, int up, int) { return up; });
  try_filter(3, [](int left, int up, int) { return (left + up) / 2; });
  try_filter(4, [](int left, int up, int corner) { return nearest(left, up, corner); });
  room[0] = best_number_;
  std::copy(best_.begin(), best_.end(), room.begin() + 1);
}

}  // namespace dmpc::apps
