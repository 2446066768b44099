#include "svm/work_items.h"

#include <algorithm>
#include <bit>

#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::svm {
namespace {

/// The part of `length` for `part` of `whole` nodes, rounded to nearest.
std::uint32_t portion(std::uint32_t length, std::uint32_t part, std::uint32_t whole) {
  return static_cast<std::uint32_t>((std::uint64_t{length} * part + whole / 2) / whole);
}

/// The first `part` (or, with `second`, the rest) of the rectangle of `whole` nodes, cut across its longer side.
PixelRectangle half(PixelRectangle rectangle, std::uint32_t part, std::uint32_t whole, bool second) {
  const bool wide = rectangle.width >= rectangle.height;
  std::uint32_t& length = wide ? rectangle.width : rectangle.height;
  std::uint32_t& start = wide ? rectangle.x : rectangle.y;
  const std::uint32_t cut = portion(length, part, whole);
  start += second ? cut : 0;
  length = second ? length - cut : cut;
  return rectangle;
}

}  // namespace

PixelRectangle submap_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count) {
  if (index >= worker_count) {
    return {};
  }
  PixelRectangle submap = image;
  while (worker_count > 1) {
    const std::uint32_t first = worker_count / 2;
    const bool second = index >= first;
    submap = half(submap, first, worker_count, second);
    index -= second ? first : 0;
    worker_count = second ? worker_count - first : first;
  }
  return submap;
}

PixelRectangle interleaved_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count) {
  if (index >= worker_count) {
    return {};
  }
  std::uint32_t rows = 1;
  for (std::uint32_t n = 2; n * n <= worker_count; ++n) {
    rows = worker_count % n == 0 ? n : rows;
  }
  const std::uint32_t columns = worker_count / rows, column = index % columns, row = index / columns;
  if (column >= image.width || row >= image.height) {
    return {};
  }
  return {image.x + column * image.step_x,
          image.y + row * image.step_y,
          core::ceil_divide(image.width - column, columns),
          core::ceil_divide(image.height - row, rows),
          image.step_x * columns,
          image.step_y * rows};
}

PixelRectangle share_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count, PixelShares shares) {
  return shares == PixelShares::submaps ? submap_of(image, index, worker_count) : interleaved_of(image, index, worker_count);
}

WorkItems::WorkItems(const PixelRectangle& share, std::uint32_t side)
    : share_(share),
      side_x_(side == 0 ? std::max(share.width, 1U) : side),
      side_y_(side == 0 ? std::max(share.height, 1U) : side) {
  if (share.pixel_count() > 0) {
    columns_ = core::ceil_divide<std::uint64_t>(share.width, side_x_);
    end_ = columns_ * core::ceil_divide<std::uint64_t>(share.height, side_y_);
  }
}

std::optional<PixelRectangle> WorkItems::front() const {
  if (empty()) {
    return std::nullopt;
  }
  return item(next_);
}

std::optional<PixelRectangle> WorkItems::take() {
  const std::optional<PixelRectangle> first = front();
  next_ += first ? 1 : 0;
  return first;
}

std::optional<PixelRectangle> WorkItems::give() {
  if (empty()) {
    return std::nullopt;
  }
  return item(--end_);
}

PixelRectangle WorkItems::item(std::uint64_t index) const {
  const auto left = static_cast<std::uint32_t>(index % columns_ * side_x_);
  const auto top = static_cast<std::uint32_t>(index / columns_ * side_y_);
  return {share_.x + left * share_.step_x,
          share_.y + top * share_.step_y,
          std::min(side_x_, share_.width - left),
          std::min(side_y_, share_.height - top),
          share_.step_x,
          share_.step_y};
}

PixelScan::PixelScan(const PixelRectangle& item, const PixelTile& tile, std::uint64_t wanted)
    : item_(item), tile_(tile), left_(static_cast<std::uint64_t>(std::popcount(wanted))), wanted_(wanted) {
  core::expect(item.pixel_count() <= 64 && (item.pixel_count() == 64 || wanted >> item.pixel_count() == 0),
               "a masked item has a bit for each of its pixels");
  while (left_ > 0 && !is_wanted()) {
    step();
  }
}

/// Advances to the next pixel of the tile, or the first of the next tile.
void PixelScan::step() {
  const std::uint32_t left = x_ - x_ % tile_.width, top = y_ - y_ % tile_.height;
  const std::uint32_t right = std::min(left + tile_.width, item_.width), bottom = std::min(top + tile_.height, item_.height);
  if (++x_ < right) {
    return;
  }
  x_ = left;
  if (++y_ < bottom) {
    return;
  }
  in_tile_ = false;
  x_ = right < item_.width ? right : 0;
  y_ = right < item_.width ? top : bottom;
}

std::uint32_t PixelScan::next(std::uint32_t image_width) {
  core::expect(!empty(), "a scan gives each pixel of its item once");
  const std::uint32_t pixel = item_.pixel(x_, y_, image_width);
  in_tile_ = true;
  for (--left_, step(); left_ > 0 && !is_wanted();) {
    step();
  }
  return pixel;
}

}  // namespace dmpc::svm
