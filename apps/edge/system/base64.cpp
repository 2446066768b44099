#include "apps/edge/system/base64.h"

#include <cstdint>

namespace dmpc::apps {
namespace {

/// 64 for what is no digit.
std::uint32_t digit_of(char letter) {
  if (letter >= 'A' && letter <= 'Z') {
    return static_cast<std::uint32_t>(letter - 'A');
  }
  if (letter >= 'a' && letter <= 'z') {
    return static_cast<std::uint32_t>(letter - 'a' + 26);
  }
  if (letter >= '0' && letter <= '9') {
    return static_cast<std::uint32_t>(letter - '0' + 52);
  }
  return letter == '+' || letter == '-' ? 62 : letter == '/' || letter == '_' ? 63 : 64;
}

bool is_blank(char letter) { return letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t'; }

}  // namespace

std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text) {
  while (!text.empty() && (text.back() == '=' || is_blank(text.back()))) {
    text.remove_suffix(1);
  }
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char letter : text) {
    const std::uint32_t digit = digit_of(letter);
    if (digit == 64) {
      if (is_blank(letter)) {
        continue;
      }
      return std::nullopt;
    }
    bits = bits << 6U | digit;
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> static_cast<unsigned>(bit_count) & 0xffU));
    }
  }
  return bytes;
}

}  // namespace dmpc::apps
