#include "apps/picture/glyphs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

#include "apps/frontend/line/text_table.h"
#include "core/base/expect.h"

namespace dmpc::apps {

extern const char* const glyphs_file;  // defined in a source that CMake generates from glyphs.txt

namespace {

/// Rows, with a '#' for each dot.
using Glyph = std::array<std::string_view, glyph_height>;

using Glyphs = std::map<char, Glyph>;

Glyphs read_glyphs() {
  Glyphs glyphs;
  for (const auto& row : table_rows(glyphs_file, 2)) {
    Glyph& glyph = glyphs[row[0].empty() ? ' ' : row[0].front()];
    const std::vector<std::string_view> dots = parts_between(row[1], " ");
    const auto is_whole = [](std::string_view row_of_dots) { return row_of_dots.size() == std::size_t{glyph_width}; };
    core::expect(dots.size() == glyph.size() && std::all_of(dots.begin(), dots.end(), is_whole), "all glyphs are of one size");
    std::copy(dots.begin(), dots.end(), glyph.begin());
  }
  return glyphs;
}

const Glyph& glyph_of(char letter) {
  static const Glyphs glyphs = read_glyphs();
  const auto found = glyphs.find(static_cast<char>(std::toupper(static_cast<unsigned char>(letter))));
  return found == glyphs.end() ? glyphs.at('?') : found->second;
}

void draw(Image& image, const TextPlace& place, const Glyph& glyph, const core::Color& color) {
  for (int row = 0; row < glyph_height; ++row) {
    for (int column = 0; column < glyph_width; ++column) {
      if (glyph[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#') {
        fill(image, place.x + column * place.dot, place.y + row * place.dot, place.dot, place.dot, color);
      }
    }
  }
}

}  // namespace

int text_width(std::string_view text, int dot) {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * (glyph_width + 1) - 1) * dot;
}

void draw_text(Image& image, const TextPlace& place, std::string_view text, const core::Color& color) {
  TextPlace next = place;
  for (const char letter : text) {
    draw(image, next, glyph_of(letter), color);
    next.x += (glyph_width + 1) * place.dot;
  }
}

void fill(Image& image, int x, int y, int width, int height, const core::Color& color) {
  for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row) {
    for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        image.rgb[pixel * 3 + channel] = color[channel];
      }
    }
  }
}

}  // namespace dmpc::apps
