#include "apps/foreign/polygon/screen_colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/srgb.h"

namespace dmpc::apps {
namespace {

constexpr int byte_max = 255;

constexpr auto light_of_bytes = [] {
  std::array<float, byte_max + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(core::linear_from_srgb(static_cast<double>(i) / byte_max));
  }
  return table;
}();

float light_of(double channel, double most) {
  const double byte = channel / most * byte_max;
  const bool is_byte = byte >= 0 && byte <= byte_max && std::floor(byte) >= byte;
  return is_byte               ? light_of_bytes[static_cast<std::size_t>(byte)]
         : std::isnan(channel) ? 0
                               : static_cast<float>(core::linear_from_srgb(channel / most));
}

}  // namespace

Color linear_color(const Color& color, double most) {
  return {light_of(double{color[0]}, most), light_of(double{color[1]}, most), light_of(double{color[2]}, most)};
}

void make_linear(std::vector<Color>& colors, double most) {
  for (Color& color : colors) {
    color = linear_color(color, most);
  }
}

double full_light(const std::vector<Color>& colors) {
  const auto is_beyond = [](const Color& color) { return *std::max_element(color.begin(), color.end()) > 1; };
  return std::any_of(colors.begin(), colors.end(), is_beyond) ? byte_max : 1;
}

}  // namespace dmpc::apps
