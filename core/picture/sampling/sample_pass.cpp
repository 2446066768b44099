#include "core/picture/sampling/sample_pass.h"

#include <algorithm>
#include <bit>

#include "core/base/units.h"

namespace dmpc::core {

PixelMask::PixelMask(std::uint32_t pixel_count, bool all) : words_(ceil_divide(pixel_count, 64U), all ? ~std::uint64_t{0} : 0) {
  if (all && pixel_count % 64 != 0) {
    words_.back() = (std::uint64_t{1} << (pixel_count % 64)) - 1;
  }
}

std::uint32_t PixelMask::count() const {
  std::uint32_t sum = 0;
  for (const std::uint64_t word : words_) {
    sum += static_cast<std::uint32_t>(std::popcount(word));
  }
  return sum;
}

std::uint32_t Pass::pixel_count() const {
  return static_cast<std::uint32_t>(
      std::count_if(steps_.begin(), steps_.end(), [](const SampleStep& step) { return !step.is_none(); }));
}

bool Pass::is_first() const {
  return std::all_of(steps_.begin(), steps_.end(), [](const SampleStep& step) { return step == SampleStep::first(); });
}

std::uint32_t Pass::samples_end() const {
  std::uint32_t level = 0;
  for (const SampleStep& step : steps_) {
    level = std::max(level, step.is_none() ? 0 : step.to());
  }
  return SampleStep::samples_at(level, first_samples_);
}

PixelMask Pass::pixels() const {
  PixelMask mask(static_cast<std::uint32_t>(steps_.size()));
  for (std::uint32_t pixel = 0; pixel < steps_.size(); ++pixel) {
    if (has(pixel)) {
      mask.add(pixel);
    }
  }
  return mask;
}

}  // namespace dmpc::core
