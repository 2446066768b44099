#include "apps/frontend/system/base64.h"

#include <cstdint>

namespace dmpc::apps {
namespace {

/// Returns 64 for a letter that is no digit.
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

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Returns four digits for one to three bytes.
std::string four_digits(std::string_view bytes) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    bits = bits << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
  }
  std::string text(4, '=');
  for (std::size_t i = 0; i <= bytes.size(); ++i) {
    text[i] = base64_digits[bits >> (18 - 6 * i) & 63U];
  }
  return text;
}

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

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    text += four_digits(bytes.substr(at, 3));
  }
  return text;
}

}  // namespace dmpc::apps
