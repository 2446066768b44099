// A PNG's rows before they are packed: what their bytes differ by from their neighbours (ISO 15948, clause 9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::apps {

/// Filters rows of three bytes a pixel. Thread safety: one thread at a time.
class PngFilter {
 public:
  explicit PngFilter(std::size_t row_bytes);

  /// `row` as PNG has it: the filter's number, then what is left of each byte. Of the five filters it is the one whose
  /// differences are the least in sum, signs apart, as the standard advises (12.8). `above`: the row above, none for the first.
  /// Requires `room` for a byte more than a row has.
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
