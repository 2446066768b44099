#include "apps/picture/png_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "apps/picture/deflate.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Byte = std::uint8_t;
using Bytes = std::span<const Byte>;
using namespace std::string_view_literals;

constexpr std::size_t channels = 3;
constexpr int effort = 6;
constexpr std::size_t chunk_bytes_max = std::size_t{1} << 30U;

std::string big_endian(std::uint32_t number) {
  std::string text;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    text.push_back(static_cast<char>(number >> shift & 0xffU));
  }
  return text;
}

void add_chunk(std::string& file, std::string_view name, std::string_view content) {
  file += big_endian(static_cast<std::uint32_t>(content.size()));
  const std::size_t checked = file.size();
  file.append(name).append(content);
  file += big_endian(crc_32(std::string_view(file).substr(checked)));
}

/// Clause 9.4: which of the bytes to the left, above, and above that comes nearest to a + b - c.
Byte paeth(int left, int above, int above_left) {
  const int estimate = left + above - above_left;
  const int to_left = std::abs(estimate - left), to_above = std::abs(estimate - above),
            to_above_left = std::abs(estimate - above_left);
  const int nearest = to_left <= to_above && to_left <= to_above_left ? left : to_above <= to_above_left ? above : above_left;
  return static_cast<Byte>(nearest);
}

enum class Filter : Byte { none, left, above, average, paeth };

Byte predicted(Filter filter, Byte left, Byte above, Byte above_left) {
  switch (filter) {
    case Filter::none:
      return 0;
    case Filter::left:
      return left;
    case Filter::above:
      return above;
    case Filter::average:
      return static_cast<Byte>((left + above) / 2);
    case Filter::paeth:
      return paeth(left, above, above_left);
  }
  return 0;
}

/// A row as the differences from what is predicted, with the filter's number before it.
struct Filtered {
  std::vector<Byte> bytes;
  std::uint64_t size = 0;  ///< of the differences, with their signs left out

  explicit Filtered(std::size_t row_bytes) : bytes(1 + row_bytes) {}
  void take(Filter filter, Bytes row, Bytes row_above);
};

void Filtered::take(Filter filter, Bytes row, Bytes row_above) {
  bytes.front() = static_cast<Byte>(filter);
  size = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_first = i < channels;
    const Byte left = is_first ? Byte{0} : row[i - channels], above_left = is_first ? Byte{0} : row_above[i - channels];
    const auto difference = static_cast<Byte>(row[i] - predicted(filter, left, row_above[i], above_left));
    bytes[1 + i] = difference;
    size += static_cast<std::uint64_t>(std::min<int>(difference, 256 - difference));
  }
}

/// Each row by the filter that leaves the least, as the standard advises (clause 12.7).
std::string filtered(Bytes rgb, std::size_t row_bytes) {
  const std::vector<Byte> black(row_bytes);
  Filtered best(row_bytes), other(row_bytes);
  std::string all;
  all.reserve(rgb.size() + rgb.size() / row_bytes);
  Bytes above = black;
  for (std::size_t first = 0; first < rgb.size(); first += row_bytes) {
    const Bytes row = rgb.subspan(first, row_bytes);
    best.take(Filter::none, row, above);
    for (const Filter filter : {Filter::left, Filter::above, Filter::average, Filter::paeth}) {
      other.take(filter, row, above);
      if (other.size < best.size) {
        std::swap(best, other);
      }
    }
    all.append(reinterpret_cast<const char*>(best.bytes.data()), best.bytes.size());
    above = row;
  }
  return all;
}

}  // namespace

std::string png_file(int width, int height, Bytes rgb) {
  const std::size_t row_bytes = channels * static_cast<std::size_t>(width);
  core::expect(width > 0 && height > 0 && rgb.size() == row_bytes * static_cast<std::size_t>(height),
               "a picture has three bytes for each of its pixels");
  std::string file("\x89PNG\r\n\x1a\n"sv);
  constexpr std::string_view eight_bits_rgb = "\x08\x02\0\0\0"sv;
  add_chunk(file, "IHDR",
            big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height)) +
                std::string(eight_bits_rgb));
  add_chunk(file, "gAMA", big_endian(45455));  // for those who do not know sRGB
  add_chunk(file, "sRGB", "\0"sv);             // perceptual
  add_chunk(file, "tEXt", "Software\0dmpc"sv);
  const std::string packed = deflated(filtered(rgb, row_bytes), effort);
  for (std::size_t first = 0; first < packed.size(); first += chunk_bytes_max) {
    add_chunk(file, "IDAT", std::string_view(packed).substr(first, chunk_bytes_max));
  }
  add_chunk(file, "IEND", "");
  return file;
}

}  // namespace dmpc::apps
