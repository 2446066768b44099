#include "apps/edge/show/page/data_url.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dmpc::apps::html {

namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Four letters for one to three bytes.
std::string group(std::string_view bytes) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    bits = bits << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
  }
  std::string text(4, '=');
  for (std::size_t i = 0; i <= bytes.size(); ++i) {
    text[i] = letters[bits >> (18 - 6 * i) & 63U];
  }
  return text;
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    text += group(bytes.substr(at, 3));
  }
  return text;
}

std::string data_url(std::string_view type, std::string_view bytes) {
  return "data:" + std::string(type) + ";base64," + base64(bytes);
}

}  // namespace dmpc::apps::html
