#include "apps/edge/picture/indexed_png.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// The most bytes of a block that is stored as it is (RFC 1951).
constexpr std::size_t stored_block_max = 65535;

std::string big_endian(std::uint32_t number) {
  return {static_cast<char>(number >> 24U), static_cast<char>(number >> 16U), static_cast<char>(number >> 8U),
          static_cast<char>(number)};
}

std::string little_endian_16(std::size_t number) { return {static_cast<char>(number), static_cast<char>(number >> 8U)}; }

/// CRC-32 of ISO 3309.
std::uint32_t cyclic_sum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0xedb88320U : 0U);
    }
  }
  return ~sum;
}

/// Adler-32 of RFC 1950.
std::uint32_t adler_sum(std::string_view bytes) {
  constexpr std::uint32_t prime = 65521;
  std::uint32_t low = 1, high = 0;
  for (const char byte : bytes) {
    low = (low + static_cast<unsigned char>(byte)) % prime;
    high = (high + low) % prime;
  }
  return high << 16U | low;
}

std::string chunk(std::string_view type, std::string_view data) {
  const std::string content = std::string(type) + std::string(data);
  return big_endian(static_cast<std::uint32_t>(data.size())) + content + big_endian(cyclic_sum(content));
}

/// As zlib's format has what it does not pack (RFC 1950).
std::string stored(std::string_view bytes) {
  std::string stream("\x78\x01", 2);
  for (std::size_t at = 0; at < bytes.size(); at += stored_block_max) {
    const std::string_view block = bytes.substr(at, stored_block_max);
    const bool is_last = at + block.size() == bytes.size();
    stream += static_cast<char>(is_last ? 1 : 0);
    stream += little_endian_16(block.size()) + little_endian_16(~block.size());
    stream += block;
  }
  return stream + big_endian(adler_sum(bytes));
}

/// Each row behind a zero, which says that its bytes are the pixels themselves.
std::string unfiltered(std::size_t width, std::span<const std::uint8_t> indices) {
  std::string rows;
  for (std::size_t at = 0; at < indices.size(); at += width) {
    rows += '\0';
    rows.append(indices.begin() + static_cast<std::ptrdiff_t>(at), indices.begin() + static_cast<std::ptrdiff_t>(at + width));
  }
  return rows;
}

}  // namespace

std::string indexed_png(int width, int height, std::span<const std::uint8_t> indices, std::span<const PaletteColor> palette) {
  core::expect(width > 0 && height > 0 && indices.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               "a picture has a number for each of its pixels");
  core::expect(!palette.empty() && palette.size() <= 256 && *std::max_element(indices.begin(), indices.end()) < palette.size(),
               "each pixel has one of up to 256 colours");
  std::string colors;
  for (const PaletteColor& color : palette) {
    colors.append(color.begin(), color.end());
  }
  const std::string eight_bits_by_palette("\x08\x03\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height)) +
                           eight_bits_by_palette) +
         chunk("PLTE", colors) + chunk("IDAT", stored(unfiltered(static_cast<std::size_t>(width), indices))) + chunk("IEND", "");
}

}  // namespace dmpc::apps
