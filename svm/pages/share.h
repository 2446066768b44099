// Samples keys where there is memory for a share of them only: the same ones wherever the share is the same.
#pragma once

#include <bit>
#include <cstdint>

#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::svm {

/// One key of every(), a power of two, chosen by a hash; the smaller share is part of the larger. Salted, since core::mix() maps
/// 0 to itself, which every share would contain: with the salt that applies to two keys above 10^9. Not thread-safe.
class Share {
 public:
  /// every() of the least share.
  static constexpr std::uint32_t every_max = std::uint32_t{1} << 31U;

  bool has(std::uint64_t key) const { return (core::mix(key + salt) & (every_ - 1)) == 0; }
  std::uint32_t every() const { return every_; }
  bool is_least() const { return every_ == every_max; }
  /// To one key of `every`, a power of two from every() to every_max.
  void shrink_to(std::uint32_t every) {
    core::expect(std::has_single_bit(every) && every >= every_, "a share shrinks, by halves");
    every_ = every;
  }
  /// Requires that it is not the least.
  void halve() { shrink_to(2 * every_); }

 private:
  static constexpr std::uint64_t salt = 0x9e3779b97f4a7c15ULL;

  std::uint32_t every_ = 1;
};

}  // namespace dmpc::svm
