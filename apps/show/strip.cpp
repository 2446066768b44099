#include "apps/show/strip.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "apps/edge/line/number_text.h"
#include "apps/picture/film_image.h"
#include "apps/picture/glyphs.h"
#include "apps/picture/inset.h"
#include "apps/picture/shrunk.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr int moment_count = 6;
constexpr core::Color white{1, 1, 1}, black{0, 0, 0};
/// As a page that plays has it, so that what is done and black differs: 26 of 255 on the sRGB curve, in linear light.
constexpr float dark = 0.0103F;
/// Lengths in pixels.
constexpr int gap = 4, line_height = glyph_height + gap;

Image done_by(const Image& picture, const HeatField& done, double moment, int side_max) {
  Image shown = picture;
  for (std::size_t pixel = 0; pixel < done.values.size(); ++pixel) {
    if (done.values[pixel] > moment) {
      std::fill_n(shown.rgb.begin() + static_cast<std::ptrdiff_t>(pixel * 3), 3, dark);
    }
  }
  return shrunk(shown, side_max);
}

/// Of all six alike in unit, so that they compare.
std::string moment_text(double us, double last_us) {
  return last_us < 1e3   ? legend_number(us) + " us"
         : last_us < 1e6 ? legend_number(us / 1e3) + " ms"
                         : legend_number(us / 1e6) + " s";
}

}  // namespace

Image strip_picture(const Image& picture, const HeatField& done, int side_max, const std::string& source) {
  core::expect(done.width == picture.width && done.height == picture.height, "a strip knows when each pixel was done");
  const double last = done.largest();
  std::vector<Image> panels;
  std::vector<std::string> times;
  int column = 0;
  for (int i = 1; i <= moment_count; ++i) {
    const double moment = i == moment_count ? last : last * i / moment_count;
    panels.push_back(done_by(picture, done, moment, side_max));
    times.push_back(moment_text(moment, last));
    column = std::max({column, panels.back().width, text_width(times.back(), 1)});
  }
  const int height = panels.front().height;
  Image strip(std::max(moment_count * (column + gap), text_width(source, 1) + gap) + gap, height + 3 * gap + 2 * line_height);
  fill(strip, 0, 0, strip.width, strip.height, white);
  for (int i = 0; i < moment_count; ++i) {
    const int left = gap + i * (column + gap);
    inset(strip, left, gap, panels[static_cast<std::size_t>(i)]);
    draw_text(strip, {left, height + 2 * gap, 1}, times[static_cast<std::size_t>(i)], black);
  }
  draw_text(strip, {gap, height + 2 * gap + line_height, 1}, source, black);
  return strip;
}

Image strip_picture(const RenderRecord& record, int side_max) {
  const HeatField done = heat_field(core::HeatKind::done, record);
  return strip_picture(image_of(account_of(record.report).film), done, side_max,
                       record.options.picture.scene + ", " + computer_text(record) + ", " + done.clock);
}

}  // namespace dmpc::apps
