#include "apps/frontend/picture/indexed_png.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t run_min = 3, run_max = 258, distance_max = 32768;

/// Bits one after the other, the lowest of a byte first.
class Bits {
 public:
  void put(std::uint32_t value, unsigned count) {
    pending_ |= std::uint64_t{value} << count_;
    count_ += count;
    for (; count_ >= 8; count_ -= 8, pending_ >>= 8U) {
      bytes_ += static_cast<char>(pending_ & 0xffU);
    }
  }
  /// A code, whose highest bit comes first.
  void put_code(std::uint32_t code, unsigned count) {
    for (unsigned bit = count; bit-- > 0;) {
      put(code >> bit & 1U, 1);
    }
  }
  std::string take() {
    put(0, 7);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
  std::uint64_t pending_ = 0;
  unsigned count_ = 0;
};

/// The fixed code of a byte, of the end (256) or of a length (from 257 on).
void put_symbol(Bits& bits, std::uint32_t symbol) {
  if (symbol < 144) {
    bits.put_code(0x30 + symbol, 8);
  } else if (symbol < 256) {
    bits.put_code(0x190 + symbol - 144, 9);
  } else if (symbol < 280) {
    bits.put_code(symbol - 256, 7);
  } else {
    bits.put_code(0xc0 + symbol - 280, 8);
  }
}

/// Numbers from 0 on in groups of 2^`low_bits` codes an octave: the code, and what follows it.
struct Grouped {
  std::uint32_t code, extra;
  unsigned extra_bits;
};
Grouped grouped_by_octave(std::uint32_t number, unsigned low_bits) {
  const auto width = static_cast<unsigned>(std::bit_width(number));
  const unsigned extra_bits = width > low_bits + 1 ? width - low_bits - 1 : 0;
  const std::uint32_t code = (extra_bits << low_bits) + (number >> extra_bits);
  return {code, number & ((1U << extra_bits) - 1), extra_bits};
}

void put_run(Bits& bits, std::size_t length, std::size_t distance) {
  if (length == run_max) {  // has a code of its own
    put_symbol(bits, 285);
  } else {
    const Grouped of_length = grouped_by_octave(static_cast<std::uint32_t>(length - run_min), 2);
    put_symbol(bits, 257 + of_length.code);
    bits.put(of_length.extra, of_length.extra_bits);
  }
  const Grouped of_distance = grouped_by_octave(static_cast<std::uint32_t>(distance - 1), 1);
  bits.put_code(of_distance.code, 5);
  bits.put(of_distance.extra, of_distance.extra_bits);
}

/// How far the bytes from `at` on are those `distance` before.
std::size_t run_length(std::string_view bytes, std::size_t at, std::size_t distance) {
  if (at < distance) {
    return 0;
  }
  const std::string_view rest = bytes.substr(at, run_max);
  return static_cast<std::size_t>(
      std::mismatch(rest.begin(), rest.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at - distance)).first - rest.begin());
}

/// A stream of P. Deutsch, "DEFLATE Compressed Data Format Specification", RFC 1951, 1996, with its fixed codes: what repeats the
/// byte before, or what stands `row_bytes` before, 1 to 32,768, is said as a length. Never longer than 9/8 of the bytes and 2.
std::string packed_runs(std::string_view bytes, std::size_t row_bytes) {
  core::expect(row_bytes >= 1 && row_bytes <= distance_max, "what is repeated lies near enough");
  Bits bits;
  bits.put(1 | 1U << 1U, 3);  // the last block, of fixed codes
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t along = run_length(bytes, at, 1), below = run_length(bytes, at, row_bytes);
    const std::size_t length = std::max(along, below);
    if (length < run_min) {
      put_symbol(bits, static_cast<unsigned char>(bytes[at++]));
    } else {
      put_run(bits, length, along >= below ? 1 : row_bytes);
      at += length;
    }
  }
  put_symbol(bits, 256);
  return bits.take();
}

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
