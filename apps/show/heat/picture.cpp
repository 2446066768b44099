#include "apps/show/heat/picture.h"

#include <algorithm>
#include <array>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/scale.h"
#include "apps/frontend/picture/color_map.h"
#include "apps/picture/glyphs.h"
#include "core/base/ranges.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps {
namespace {

Channels channel_of(const HeatField& field, const RenderRecord& record) {
  Channels channel{.width = field.width, .height = field.height, .names = {std::string(core::name_of(field.kind))}};
  channel.values.assign(field.values.begin(), field.values.end());
  channel.remarks = {{"dmpc:meaning", field.meaning},
                     {"dmpc:unit", field.unit},
                     {"dmpc:scene", record.options.picture.scene},
                     {"dmpc:strategy", name_of(record.options.strategy)},
                     {"dmpc:nodes", std::to_string(record.options.computer.node_count)},
                     {"dmpc:runner", name_of(record.options.runner.kind)},
                     {"dmpc:repeatable", field.is_repeatable ? "yes" : "no"}};
  if (!field.clock.empty()) {
    channel.remarks.push_back({"dmpc:clock", field.clock});
  }
  return channel;
}

constexpr core::Color white{1, 1, 1}, black{0, 0, 0};

/// All lengths in dots.
constexpr int margin = 6, bar_height = 10, tick_height = 3, line_height = glyph_height + 4;
constexpr int legend_height = margin + bar_height + tick_height + 4 * line_height + margin;
/// Width that gives numbers below the bar enough space.
constexpr int bar_width_min = 240;
/// Dots between numbers below the bar.
constexpr int number_gap = 8;

/// Numbers that are names have no meaningful mean.
std::string mean_of(const HeatField& field) {
  return field.kind == core::HeatKind::node ? ""
                                            : ", mean " + legend_number(field.sum() / static_cast<double>(field.values.size()));
}

std::string scale_text(const NumberScale& scale, const HeatField& field) {
  return !scale.is_logarithmic ? "linear scale" : field.least() > 0 ? "logarithmic scale" : "logarithmic scale (0: black)";
}

std::array<std::string, 3> lines_of(const HeatField& field, const NumberScale& scale, const std::string& source) {
  return {std::string(core::name_of(field.kind)) + ": " + field.meaning + ", " + (field.clock.empty() ? "" : field.clock + ", ") +
              "unit " + field.unit,
          "least " + legend_number(field.least()) + ", largest " + legend_number(field.largest()) + mean_of(field) + ", " +
              scale_text(scale, field),
          source};
}

/// In dots.
int width_of_legend(const std::array<std::string, 3>& lines) {
  const int width = core::max_over(lines, bar_width_min, [&](const std::string& line) { return text_width(line, 1); });
  return width + 2 * margin;
}

core::Color color_of(double value, const NumberScale& scale) {
  return scale.is_logarithmic && value <= 0 ? black : color_map(scale.position(value));
}

void draw_values(Image& image, const HeatField& field, const NumberScale& scale) {
  std::size_t pixel = 0;
  for (int y = 0; y < field.height; ++y) {
    for (int x = 0; x < field.width; ++x) {
      fill(image, x, y, 1, 1, color_of(field.values[pixel++], scale));
    }
  }
}

/// The bar of all colours.
struct Bar {
  int x, y, width, dot;

  /// Returns the coordinate of a position on the scale.
  int at(double position) const { return x + static_cast<int>(position * (width - 1)); }
};

void draw_colors(Image& image, const Bar& bar) {
  for (int i = 0; i < bar.width; ++i) {
    fill(image, bar.x + i, bar.y, 1, bar_height * bar.dot, color_map(static_cast<double>(i) / (bar.width - 1)));
  }
}

/// Numbers that would touch the one before are left out, but not their ticks.
void draw_ticks(Image& image, const Bar& bar, const NumberScale& scale) {
  const int top = bar.y + bar_height * bar.dot;
  int free_from = 0;
  for (const double tick : scale.ticks()) {
    const std::string text = legend_number(tick);
    const int middle = bar.at(scale.position(tick)), width = text_width(text, bar.dot);
    const int left = std::clamp(middle - width / 2, bar.x, bar.x + bar.width - width);
    fill(image, middle, top, bar.dot, tick_height * bar.dot, black);
    if (left >= free_from) {
      draw_text(image, {left, top + (tick_height + 2) * bar.dot, bar.dot}, text, black);
      free_from = left + width + number_gap * bar.dot;
    }
  }
}

}  // namespace

std::string heat_file(const HeatRequest& request, const RenderRecord& record) {
  const HeatField field = heat_field(request.kind, record);
  return holds_numbers(request)
             ? encoded_picture(request.path, channel_of(field, record))
             : encoded_picture(request.path, heat_picture(field, record.options.picture.scene + ", " + computer_text(record)));
}

Image heat_picture(const HeatField& field, const std::string& source) {
  const NumberScale scale = scale_for(field.values);
  const std::array<std::string, 3> lines = lines_of(field, scale, source);
  const int dots = width_of_legend(lines);
  const int dot = std::max(1, field.width / dots);
  const int width = std::max(field.width, dots * dot);
  Image image(width, field.height + legend_height * dot);
  fill(image, 0, 0, image.width, image.height, white);
  draw_values(image, field, scale);
  const Bar bar{margin * dot, field.height + margin * dot, width - 2 * margin * dot, dot};
  draw_colors(image, bar);
  draw_ticks(image, bar, scale);
  int y = bar.y + (bar_height + tick_height + line_height) * dot;
  for (const std::string& line : lines) {
    y += 2 * dot;
    draw_text(image, {bar.x, y, dot}, line, black);
    y += (line_height - 2) * dot;
  }
  return image;
}

}  // namespace dmpc::apps
