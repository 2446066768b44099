// Letters and digits of five by seven dots, for the legends of pictures.
#pragma once

#include <string_view>

#include "apps/picture/image_file.h"
#include "core/base/vec.h"

namespace dmpc::apps {

inline constexpr int glyph_width = 5, glyph_height = 7;

/// The start of a text, and the width and height of its dots in pixels (>= 1).
struct TextPlace {
  int x = 0, y = 0, dot = 1;
};

/// Returns the pixels from the left of the first to the right of the last letter.
int text_width(std::string_view text, int dot);

/// Writes in capitals; each byte of a character without a glyph, such as an accented letter, becomes an empty box. Text outside
/// the image is clipped.
void draw_text(Image& image, const TextPlace& place, std::string_view text, const core::Color& color);

/// Fills the rectangle's pixels that lie in the image.
void fill(Image& image, int x, int y, int width, int height, const core::Color& color);

}  // namespace dmpc::apps
