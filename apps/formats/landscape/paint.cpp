#include "apps/formats/landscape/paint.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "apps/formats/landscape/terrain.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/database/parallel.h"

namespace dmpc::apps {

namespace {

constexpr std::size_t rows_together = 16;
/// Painted by all cores before word of it is given.
constexpr std::size_t rows_reported = 256;

/// Paints some rows of a picture.
class Painter {
 public:
  explicit Painter(Image& image) : image_(image), side_(static_cast<std::size_t>(image.width)) {}

  void paint(std::size_t first_row, std::size_t end_row) const {
    std::vector<double> here = heights(first_row);
    for (std::size_t row = first_row; row < end_row; ++row) {
      std::vector<double> below = heights(row + 1);
      for (std::size_t column = 0; column < side_; ++column) {
        paint(row, column, here, below);
      }
      here = std::move(below);
    }
  }

 private:
  double place(std::size_t index) const { return (static_cast<double>(index) + 0.5) / static_cast<double>(side_); }

  /// The heights of a row and one texel more; it may be the row below the last.
  std::vector<double> heights(std::size_t row) const {
    std::vector<double> heights(side_ + 1);
    for (std::size_t column = 0; column <= side_; ++column) {
      heights[column] = ground_height(2 * place(column) - 1, place(row) - 0.5);
    }
    return heights;
  }

  void paint(std::size_t row, std::size_t column, const std::vector<double>& here, const std::vector<double>& below) const {
    const double side = static_cast<double>(side_), height = here[column];
    const core::Vec3d normal =
        core::normalize(core::Vec3d{(height - here[column + 1]) * side / 2, 1, (height - below[column]) * side});
    const core::Vec3d color = ground_color(2 * place(column) - 1, place(row) - 0.5, height, normal.y);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      image_.rgb[(row * side_ + column) * 3 + channel] = static_cast<float>(color[channel]);
    }
  }

  Image& image_;
  std::size_t side_;
};

}  // namespace

Image ground_picture(int side, const RowsDone& rows_done) {
  core::expect(side > 0, "a picture has a texel");
  Image image(side, side);
  const Painter painter(image);
  const auto rows = static_cast<std::size_t>(side);
  for (std::size_t first = 0; first < rows; first += rows_reported) {
    const std::size_t end = std::min(rows, first + rows_reported);
    core::Parallel(0).for_each(core::ceil_divide(end - first, rows_together), [&](std::size_t band) {
      const std::size_t begin = first + band * rows_together;
      painter.paint(begin, std::min(end, begin + rows_together));
    });
    if (rows_done) {
      rows_done(end, rows);
    }
  }
  return image;
}

}  // namespace dmpc::apps
