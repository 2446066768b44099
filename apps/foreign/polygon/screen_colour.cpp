#include "apps/foreign/polygon/screen_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

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

void set_last(std::vector<Color>& colors, std::size_t count, const Color& color) {
  colors.resize(count, not_yet);
  colors.back() = color;
}

Color linear_color(const Color& color, double most) {
  return {double{light_of(color.x, most)}, double{light_of(color.y, most)}, double{light_of(color.z, most)}};
}

void make_linear(std::vector<Color>& colors, std::size_t count, double most, const Color& plain) {
  colors.resize(colors.empty() ? 0 : count, not_yet);
  for (Color& color : colors) {
    color = color == not_yet ? plain : linear_color(color, most);
  }
}

double full_light(const std::vector<Color>& colors) {
  const auto is_beyond = [](const Color& color) { return largest_component(color) > 1; };
  return std::any_of(colors.begin(), colors.end(), is_beyond) ? byte_max : 1;
}

}  // namespace dmpc::apps
