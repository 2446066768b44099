#include "apps/edge/picture/indexed_png.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "apps/edge/picture/packed_runs.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::string big_endian(std::uint32_t number) {
  return {static_cast<char>(number >> 24U), static_cast<char>(number >> 16U), static_cast<char>(number >> 8U),
          static_cast<char>(number)};
}

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

/// As zlib's format has it (RFC 1950).
std::string packed(std::string_view bytes, std::size_t row_bytes) {
  return std::string("\x78\x01", 2) + packed_runs(bytes, row_bytes) + big_endian(adler_sum(bytes));
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
  core::expect(width > 0 && width < 32'768 && height > 0 &&
                   indices.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               "a picture has a number for each of its pixels");
  core::expect(!palette.empty() && palette.size() <= 256 && *std::max_element(indices.begin(), indices.end()) < palette.size(),
               "each pixel has one of up to 256 colours");
  const auto columns = static_cast<std::size_t>(width);
  std::string colors;
  for (const PaletteColor& color : palette) {
    colors.append(color.begin(), color.end());
  }
  const std::string eight_bits_by_palette("\x08\x03\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height)) +
                           eight_bits_by_palette) +
         chunk("PLTE", colors) + chunk("IDAT", packed(unfiltered(columns, indices), columns + 1)) + chunk("IEND", "");
}

}  // namespace dmpc::apps
