#include "apps/frontend/show/page/number_map.h"

#include <algorithm>
#include <cmath>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/picture/color_map.h"
#include "apps/frontend/picture/indexed_png.h"
#include "apps/frontend/show/page/data_url.h"
#include "apps/frontend/show/page/escaped.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps::html {

namespace {

// Pixels, as in the plots beside it.
constexpr double width = 480, left = 58, top = 34, field_width = 330;
constexpr double scale_left = left + field_width + 16, scale_width = 14;
constexpr double row_height_max = field_width / 8, field_height_min = 140, bottom = 46;
/// Squares of this size have space for a number.
constexpr double number_width_min = 34, number_height_min = 16;

constexpr std::size_t ticks_max = 8, scale_steps = 64, color_count = 256;

/// Above this share of the scale a square is so light that what is written in it has to be dark.
constexpr double light_share = 0.55;

constexpr const char* map_style =
    "<style>text{font:12px sans-serif;fill:#1a1a1a}.title{font-size:13px}.in{font-size:11px}.dark{fill:#111}.light{fill:#fff}"
    "line,rect.frame{stroke:#5c5c5c;fill:none}image{image-rendering:pixelated}"
    "@media(prefers-color-scheme:dark){text{fill:#e4e4e4}.dark{fill:#111}.light{fill:#fff}line,rect.frame{stroke:#a5a9b0}}"
    "</style>\n";

struct Place {
  double x = 0, y = 0;
};

std::string attribute(const std::string& name, double value) { return " " + name + "=\"" + rounded(value) + "\""; }

std::string text_at(Place place, const std::string& text, const std::string& attributes) {
  return "<text" + attribute("x", place.x) + attribute("y", place.y) + " " + attributes + ">" + escaped(text) + "</text>\n";
}

std::string line(Place from, Place to) {
  return "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) + attribute("y2", to.y) + "/>\n";
}

std::string box(const std::string& name, Place at, Place size, const std::string& attributes) {
  return "<" + name + attribute("x", at.x) + attribute("y", at.y) + attribute("width", size.x) + attribute("height", size.y) +
         " " + attributes + "/>\n";
}

/// The colours from the least to the largest number.
const std::vector<PaletteColor>& palette() {
  static const std::vector<PaletteColor> colors = [] {
    std::vector<PaletteColor> all;
    for (std::size_t i = 0; i < color_count; ++i) {
      const core::Color color = color_map(static_cast<double>(i) / (color_count - 1));
      PaletteColor& bytes = all.emplace_back();
      for (std::size_t channel = 0; channel < bytes.size(); ++channel) {
        bytes[channel] = core::srgb_byte(static_cast<float>(color[channel]));
      }
    }
    return all;
  }();
  return colors;
}

/// A square of colour for each number.
std::string squares(std::span<const double> values, std::size_t rows, std::size_t columns, double most, Place at, Place size) {
  const std::string png = indexed_png(static_cast<int>(columns), static_cast<int>(rows), color_numbers(values, most), palette());
  return box("image", at, size, "preserveAspectRatio=\"none\" href=\"" + data_url("image/png", png) + "\"") +
         box("rect", at, size, "class=\"frame\"");
}

/// 1, 2 or 5 times a power of ten, so that `count` has no more than ticks_max of them.
std::size_t tick_step(std::size_t count) {
  for (std::size_t power = 1;; power *= 10) {
    for (const std::size_t digit : {1U, 2U, 5U}) {
      if (count <= digit * power * ticks_max) {
        return digit * power;
      }
    }
  }
}

/// Where the numbers are, and how much of the picture they take.
class Field {
 public:
  explicit Field(const NumberMap& map) : map_(map) {
    const double largest = map.values.empty() ? 0 : *std::max_element(map.values.begin(), map.values.end());
    most_ = map.most.value_or(largest);
    height_ = std::clamp(row_height_max * static_cast<double>(map.rows), field_height_min, field_width);
  }

  double height() const { return top + height_ + bottom; }

  std::string text() const {
    return squares(map_.values, map_.rows, map_.columns, most_, {left, top}, {field_width, height_}) + numbers() + row_axis() +
           column_axis() + scale();
  }

 private:
  double cell_width() const { return field_width / static_cast<double>(map_.columns); }
  double cell_height() const { return height_ / static_cast<double>(map_.rows); }

  std::string numbers() const {
    if (cell_width() < number_width_min || cell_height() < number_height_min) {
      return "";
    }
    std::string text;
    for (std::size_t i = 0; i < map_.values.size(); ++i) {
      const Place middle{left + (static_cast<double>(i % map_.columns) + 0.5) * cell_width(),
                         top + (static_cast<double>(i / map_.columns) + 0.5) * cell_height() + 4};
      const bool is_light = most_ > 0 && map_.values[i] > light_share * most_;
      text += text_at(middle, cell_text(map_.values[i]),
                      is_light ? "class=\"in dark\" text-anchor=\"middle\"" : "class=\"in light\" text-anchor=\"middle\"");
    }
    return text;
  }

  /// Short enough for its square.
  std::string cell_text(double value) const {
    return value >= 1e6   ? rounded(value / 1e6).substr(0, 4) + "M"
           : value >= 1e5 ? grouped(value / 1e3, 0) + "K"
                          : grouped(value, 0);
  }

  std::string row_axis() const {
    std::string text;
    for (std::size_t row = 0; row < map_.rows; row += tick_step(map_.rows)) {
      const double y = top + (static_cast<double>(row) + 0.5) * cell_height();
      text += line({left - 4, y}, {left, y}) + text_at({left - 7, y + 4}, std::to_string(row), "text-anchor=\"end\"");
    }
    const std::string middle = rounded(top + height_ / 2);
    return text +
           text_at({0, 0}, map_.row_label, "text-anchor=\"middle\" transform=\"translate(16 " + middle + ") rotate(-90)\"");
  }

  std::string column_axis() const {
    std::string text = map_.column_ns ? measured_columns() : counted_columns();
    return text + text_at({left + field_width / 2, top + height_ + 38}, map_.column_label, "text-anchor=\"middle\"");
  }

  std::string column_tick(double x, const std::string& name) const {
    return line({x, top + height_}, {x, top + height_ + 4}) + text_at({x, top + height_ + 18}, name, "text-anchor=\"middle\"");
  }

  std::string counted_columns() const {
    std::string text;
    for (std::size_t column = 0; column < map_.columns; column += tick_step(map_.columns)) {
      text += column_tick(left + (static_cast<double>(column) + 0.5) * cell_width(), std::to_string(column));
    }
    return text;
  }

  std::string measured_columns() const {
    const double end = *map_.column_ns * static_cast<double>(map_.columns);
    std::string text;
    for (const Tick& tick : amount_ticks(0, end, false, "ns")) {
      text += column_tick(left + tick.position / end * field_width, tick.text);
    }
    return text;
  }

  std::string scale() const {
    std::vector<double> steps(scale_steps);
    for (std::size_t step = 0; step < scale_steps; ++step) {
      steps[step] = static_cast<double>(scale_steps - 1 - step);
    }
    std::string text =
        squares(steps, scale_steps, 1, static_cast<double>(scale_steps - 1), {scale_left, top}, {scale_width, height_});
    for (const Tick& tick : amount_ticks(0, most_, false, map_.unit)) {
      if (map_.unit.empty() && tick.position != std::floor(tick.position)) {
        continue;  // there is no half of a thing that is counted
      }
      const double y = top + height_ * (1 - (most_ > 0 ? tick.position / most_ : 0)), end = scale_left + scale_width;
      text += line({end, y}, {end + 4, y}) + text_at({end + 7, y + 4}, tick.text, "");
    }
    return text + text_at({width - 4, top - 12}, map_.value_label, "text-anchor=\"end\"");
  }

  const NumberMap& map_;
  double most_ = 0;
  double height_ = 0;
};

}  // namespace

std::string svg_of(const NumberMap& map) {
  core::expect(map.values.size() == map.rows * map.columns && !map.values.empty(), "a map of numbers has one for each place");
  const Field field(map);
  const std::string size = rounded(width) + " " + rounded(field.height());
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + "\"" + attribute("width", width) +
         attribute("height", field.height()) + " role=\"img\">\n<title>" + escaped(map.title) + "</title>\n" + map_style +
         text_at({left + field_width / 2, 18}, map.title, "class=\"title\" text-anchor=\"middle\"") + field.text() + "</svg>\n";
}

std::vector<std::uint8_t> color_numbers(std::span<const double> values, double most) {
  std::vector<std::uint8_t> numbers;
  for (const double value : values) {
    const double position = most > 0 ? std::clamp(value / most, 0.0, 1.0) : 0;
    numbers.push_back(static_cast<std::uint8_t>(std::lround(position * (color_count - 1))));
  }
  return numbers;
}

}  // namespace dmpc::apps::html
