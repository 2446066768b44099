#include "apps/render/live_picture.h"

#include <algorithm>
#include <utility>

#include "core/base/units.h"

namespace dmpc::apps {

namespace {

constexpr std::uint32_t tile_side = 64;

/// `step`: the film's.
void add_pixel(std::vector<float>& rgb, const core::PixelSums& sums, double step, std::uint32_t samples) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double sum = static_cast<double>(sums.plane[0].channel[channel]) + static_cast<double>(sums.plane[1].channel[channel]);
    rgb.push_back(samples == 0 ? 0.0F : static_cast<float>(sum * step / samples));
  }
}

}  // namespace

LivePicture::LivePicture(std::uint32_t width, std::uint32_t height, const core::PartialPicture* start)
    : width_(width),
      height_(height),
      columns_(core::ceil_divide(width, tile_side)),
      is_dirty_(columns_ * core::ceil_divide(height, tile_side), start != nullptr ? 1 : 0),
      new_samples_(std::size_t{width} * height) {
  if (start != nullptr) {
    pass_ = start->passes;
    for (std::uint32_t pixel = 0; pixel < new_samples_.size(); ++pixel) {
      new_samples_[pixel] = start->done.has(pixel) ? start->pass.samples(pixel).count : 0;
    }
  }
}

void LivePicture::watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
  if (pass.result().passes != pass_) {
    pass_ = pass.result().passes;
    std::fill(new_samples_.begin(), new_samples_.end(), 0);
  }
  new_samples_[pixel] = pass.pass().samples(pixel).count;
  is_dirty_[pixel / width_ / tile_side * columns_ + pixel % width_ / tile_side] = 1;
  if (is_asked_for_.load(std::memory_order_relaxed)) {
    migration(film);
  }
}

void LivePicture::migration(const core::Film& film) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) {
    return;
  }
  is_asked_for_.store(false, std::memory_order_relaxed);
  for (std::uint32_t looks = 0; looks < tile_count() && tiles_.size() < tiles_max; ++looks) {
    if (std::exchange(is_dirty_[next_tile_], std::uint8_t{0}) != 0) {
      tiles_.push_back(tile_of(film, next_tile_));
    }
    next_tile_ = (next_tile_ + 1) % tile_count();
  }
}

std::vector<PictureTile> LivePicture::take() {
  const std::lock_guard lock(mutex_);
  is_asked_for_.store(true, std::memory_order_relaxed);
  return std::exchange(tiles_, {});
}

void LivePicture::begin_again() {
  take();
  std::fill(is_dirty_.begin(), is_dirty_.end(), 0);
  std::fill(new_samples_.begin(), new_samples_.end(), 0);
  pass_ = 0;
}

PictureTile LivePicture::tile_of(const core::Film& film, std::uint32_t index) const {
  const std::uint32_t x = index % columns_ * tile_side, y = index / columns_ * tile_side;
  PictureTile tile{.index = index,
                   .x = x,
                   .y = y,
                   .width = std::min(tile_side, width_ - x),
                   .height = std::min(tile_side, height_ - y),
                   .rgb = {}};
  tile.rgb.reserve(std::size_t{3} * tile.width * tile.height);
  for (std::uint32_t row = y; row < y + tile.height; ++row) {
    for (std::uint32_t pixel = row * width_ + x; pixel < row * width_ + x + tile.width; ++pixel) {
      add_pixel(tile.rgb, film.sums(pixel), film.step(), film.samples(pixel) + new_samples_[pixel]);
    }
  }
  return tile;
}

std::vector<PictureTile> LivePicture::finish(const core::Film& film) {
  std::fill(new_samples_.begin(), new_samples_.end(), 0);  // all samples are counted on the film
  std::vector<PictureTile> all;
  for (std::uint32_t tile = 0; tile < tile_count(); ++tile) {
    all.push_back(tile_of(film, tile));
  }
  return all;
}

}  // namespace dmpc::apps
