// Filters a PNG's rows before compression: bytes are replaced by differences to their neighbours (ISO 15948, clause 9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::apps {

/// Filters rows of three bytes a pixel. Not thread-safe.
class PngFilter {
 public:
  explicit PngFilter(std::size_t row_bytes);

  /// Returns `row` in PNG's form: the filter's number, then the filtered bytes. Of the five filters it takes the one with the
  /// least sum of absolute differences, as the standard advises (12.8). `above` is the row above, empty for the first. Requires
  /// `room` for one byte more than a row has.
  void filter(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above, std::span<std::uint8_t> room);

 private:
  template <class Predict>
  std::uint32_t differ(Predict predict);
  template <class Predict>
  void try_filter(std::uint8_t number, Predict predict);

  std::size_t row_bytes_;
  std::vector<std::uint8_t> here_, above_;  ///< rows, a pixel of zeros before each
  std::vector<std::uint8_t> trial_, best_;  ///< differences
  std::uint8_t best_number_ = 0;
  std::uint32_t best_sum_ = 0;
};

}  // namespace dmpc::apps
