#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "apps/foreign/plain_picture.h"

namespace dmpc::apps {
namespace {

using Byte = std::uint8_t;

/// The bytes from a place on. What would go beyond the end is nothing.
class HdrBytes {
 public:
  explicit HdrBytes(std::span<const std::byte> file) : rest_(reinterpret_cast<const char*>(file.data()), file.size()) {}

  /// Without the character that ends it.
  std::optional<std::string_view> take_line() {
    constexpr std::size_t longest = 126;  // OpenImageIO cuts others in two
    const std::size_t length = rest_.find('\n');
    if (length > longest) {
      return std::nullopt;
    }
    return take(length + 1)->substr(0, length);
  }
  std::optional<std::string_view> take(std::size_t count) {
    if (count > rest_.size()) {
      return std::nullopt;
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::optional<Byte> take_byte() {
    const auto one = take(1);
    return one ? std::optional(static_cast<Byte>(one->front())) : std::nullopt;
  }

 private:
  std::string_view rest_;
};

/// "-Y 512 +X 1024": rows from the top, each from the left.
std::optional<std::pair<std::uint32_t, std::uint32_t>> size_in(std::string_view line) {
  std::uint32_t width = 0, height = 0;
  const char* const end = line.data() + line.size();
  const auto number = [&](std::string_view before, const char* from, std::uint32_t& value) -> const char* {
    if (from == nullptr || !std::string_view(from, static_cast<std::size_t>(end - from)).starts_with(before)) {
      return nullptr;
    }
    const auto [after, error] = std::from_chars(from + before.size(), end, value);
    return error == std::errc{} ? after : nullptr;
  };
  const bool is_size = number(" +X ", number("-Y ", line.data(), height), width) == end;
  return is_size ? std::optional(std::pair(width, height)) : std::nullopt;
}

/// The picture's size, behind a head that says its format.
std::optional<std::pair<std::uint32_t, std::uint32_t>> take_head(HdrBytes& bytes) {
  bool has_format = false;
  auto line = bytes.take_line();
  for (; line && !line->empty(); line = bytes.take_line()) {
    has_format = has_format || *line == "FORMAT=32-bit_rle_rgbe";
  }
  line = line && has_format ? bytes.take_line() : std::nullopt;
  return line ? size_in(*line) : std::nullopt;
}

/// A row of one of the four components, in runs of one byte and of different ones. False if they do not fill it.
bool take_component(HdrBytes& bytes, std::span<Byte> row) {
  constexpr Byte different_max = 128;
  while (!row.empty()) {
    const auto code = bytes.take_byte();
    const std::size_t count = !code ? 0 : *code > different_max ? *code - std::size_t{different_max} : *code;
    if (count == 0 || count > row.size()) {
      return false;
    }
    if (*code > different_max) {
      const auto value = bytes.take_byte();
      if (!value) {
        return false;
      }
      std::memset(row.data(), *value, count);
    } else {
      const auto values = bytes.take(count);
      if (!values) {
        return false;
      }
      std::memcpy(row.data(), values->data(), count);
    }
    row = row.subspan(count);
  }
  return true;
}

/// OpenImageIO has some others a little wrong: 40, 223 and 226.
constexpr Byte exponent_min = 64, exponent_max = 192;

bool is_plain_exponent(Byte exponent) { return exponent == 0 || (exponent >= exponent_min && exponent <= exponent_max); }

/// What the mantissas of that exponent are multiples of.
float unit_of(Byte exponent) { return exponent == 0 ? 0 : std::ldexp(1.0F, exponent - 128 - 8); }

/// A row of the kind that says its width (Ward, "Real Pixels", Graphics Gems II, 1991), as floats. False if it is not one.
bool take_row(HdrBytes& bytes, std::span<Byte> components, Byte* values) {
  const std::size_t width = components.size() / 4;
  const auto head = bytes.take(4);
  if (!head || (*head)[0] != 2 || (*head)[1] != 2 ||
      (std::size_t{static_cast<Byte>((*head)[2])} << 8U | static_cast<Byte>((*head)[3])) != width) {
    return false;
  }
  for (std::size_t component = 0; component < 4; ++component) {
    if (!take_component(bytes, components.subspan(component * width, width))) {
      return false;
    }
  }
  const std::span exponents = components.subspan(3 * width, width);
  if (!std::all_of(exponents.begin(), exponents.end(), is_plain_exponent)) {
    return false;
  }
  for (std::size_t pixel = 0; pixel < width; ++pixel) {
    const float unit = unit_of(exponents[pixel]);
    for (std::size_t component = 0; component < 3; ++component) {
      const float value = static_cast<float>(components[component * width + pixel]) * unit;
      std::memcpy(values + (3 * pixel + component) * sizeof(float), &value, sizeof(value));
    }
  }
  return true;
}

}  // namespace

std::optional<RawPicture> hdr_picture(std::span<const std::byte> file, std::uint64_t pixels_max) {
  HdrBytes bytes(file);
  const auto size = take_head(bytes);
  constexpr std::uint32_t width_min = 8, width_max = 32767;  // of rows that say theirs
  if (!size || size->first < width_min || size->first > width_max ||
      !is_plain_size(size->first, size->second, sizeof(float), file.size(), pixels_max)) {
    return std::nullopt;
  }
  RawPicture picture{.width = size->first, .height = size->second, .channels = 3, .value_bytes = sizeof(float), .values = {}};
  const std::size_t row_bytes = std::size_t{picture.width} * 3 * sizeof(float);
  picture.values.resize(row_bytes * picture.height);
  std::vector<Byte> components(std::size_t{4} * picture.width);
  for (std::uint32_t row = 0; row < picture.height; ++row) {
    if (!take_row(bytes, components, picture.values.data() + row * row_bytes)) {
      return std::nullopt;
    }
  }
  return picture;
}

}  // namespace dmpc::apps
