// A digest of bytes. It detects accidental changes, not intended ones.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace dmpc::apps {

/// Adds eight bytes a step, each by an invertible change of the state, so two inputs that differ in one word never have the same
/// digest. The digest also depends on how the bytes are divided into calls. Not thread-safe.
class Digest {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15U;
    value_ ^= value_ >> 32U;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  /// Also adds their number.
  void add(std::span<const std::byte> bytes) {
    add(std::uint64_t{bytes.size()});
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(sizeof(std::uint64_t), bytes.size()))) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data(), std::min(sizeof(word), bytes.size()));
      add(word);
    }
  }
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace dmpc::apps
