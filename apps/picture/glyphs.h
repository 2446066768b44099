// Letters and digits of five by seven dots, for the legends of pictures.
#pragma once

#include <cstddef>
#include <string_view>

#include "apps/picture/image_file.h"
#include "core/base/vec.h"

namespace dmpc::apps {

inline constexpr int glyph_width = 5, glyph_height = 7;

/// Where text begins, and how many pixels wide and high a dot of it is (>= 1).
struct TextPlace {
  int x = 0, y = 0, dot = 1;
};

/// Pixels from the left of the first to the right of the last letter.
int text_width(std::string_view text, int dot);

/// Writes in capitals; what has no glyph, such as a letter with an accent, is an empty box for each of its bytes. What lies
/// outside the image is cut off.
void draw_text(Image& image, const TextPlace& place, std::string_view text, const core::Color& color);

/// Fills the rectangle's pixels that lie in the image.
void fill(Image& image, int x, int y, int width, int height, const core::Color& color);

}  // namespace dmpc::apps
