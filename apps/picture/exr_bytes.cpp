#include "apps/picture/exr_bytes.h"

#include <cstddef>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::uint8_t difference(std::uint8_t byte, std::uint8_t before) { return static_cast<std::uint8_t>(byte - before + 128); }

}  // namespace

void split_bytes(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room) {
  core::expect(!bytes.empty() && bytes.size() % 2 == 0 && room.size() == bytes.size(), "numbers have an even number of bytes");
  const std::size_t half = bytes.size() / 2;
  const std::uint8_t* const from = bytes.data();
  std::uint8_t* const even = room.data();
  std::uint8_t* const odd = even + half;
  even[0] = from[0];
  odd[0] = difference(from[1], from[2 * half - 2]);
  for (std::size_t i = 1; i < half; ++i) {
    even[i] = difference(from[2 * i], from[2 * i - 2]);
    odd[i] = difference(from[2 * i + 1], from[2 * i - 1]);
  }
}

}  // namespace dmpc::apps
