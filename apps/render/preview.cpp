#include "apps/render/preview.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/base/units.h"

namespace dmpc::apps {

namespace {

constexpr std::uint32_t tile_side = 64;
/// Handed over at a time, and how long to wait until the next time: about a hundredth of the host's time at most.
constexpr std::size_t tiles_max = 64;
constexpr std::chrono::milliseconds interval{250};
/// For a viewer that takes nothing.
constexpr std::chrono::milliseconds patience{500};
/// For all that is to be sent in the end.
constexpr std::chrono::seconds patience_at_the_end{2};
/// The clock is asked once in so many pixels.
constexpr std::uint32_t pixels_a_look = 64;

/// `step`: the film's.
void add_pixel(std::vector<float>& rgb, const core::PixelSums& sums, double step, std::uint32_t samples) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double sum = static_cast<double>(sums.plane[0].channel[channel]) + static_cast<double>(sums.plane[1].channel[channel]);
    rgb.push_back(samples == 0 ? 0.0F : static_cast<float>(sum * step / samples));
  }
}

}  // namespace

std::unique_ptr<Preview> Preview::to_viewer(const ViewerAddress& address, const std::string& picture, int width, int height,
                                            const core::PartialPicture* start, std::stop_token stop, TilePacket tile_packet) {
  std::unique_ptr<Preview> preview(new Preview(address, picture, width, height, start, std::move(stop), std::move(tile_packet)));
  return preview->connection_.is_open() ? std::move(preview) : nullptr;
}

Preview::Preview(const ViewerAddress& address, std::string picture, int width, int height, const core::PartialPicture* start,
                 std::stop_token stop, TilePacket tile_packet)
    : connection_(address, patience,
                  [this, stop = std::move(stop)] {
                    return stop.stop_requested() || Clock::now() >= deadline_.load(std::memory_order_relaxed);
                  }),
      picture_(std::move(picture)),
      tile_packet_(std::move(tile_packet)),
      width_(static_cast<std::uint32_t>(width)),
      height_(static_cast<std::uint32_t>(height)),
      columns_(core::ceil_divide(width_, tile_side)),
      is_dirty_(columns_ * core::ceil_divide(height_, tile_side), start != nullptr ? 1 : 0),
      new_samples_(std::size_t{width_} * height_),
      next_(Clock::now()) {
  if (start != nullptr) {
    pass_ = start->passes;
    for (std::uint32_t pixel = 0; pixel < new_samples_.size(); ++pixel) {
      new_samples_[pixel] = start->done.has(pixel) ? start->pass.samples(pixel).count : 0;
    }
  }
  if (connection_.is_open()) {
    sender_ = std::jthread([this](const std::stop_token& ending) { run_sender(ending); });
  }
}

void Preview::watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
  if (is_gone_.load(std::memory_order_relaxed)) {  // a late look is as good
    return;
  }
  if (pass.result().passes != pass_) {
    pass_ = pass.result().passes;
    std::fill(new_samples_.begin(), new_samples_.end(), 0);
  }
  new_samples_[pixel] = pass.pass().samples(pixel).count;
  is_dirty_[pixel / width_ / tile_side * columns_ + pixel % width_ / tile_side] = 1;
  if (++calls_ % pixels_a_look == 0 && Clock::now() >= next_) {
    hand_over(film);
  }
}

/// Unless the sender has something to do.
void Preview::hand_over(const core::Film& film) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || !tiles_.empty() || is_sending_) {
    return;
  }
  const auto tile_count = static_cast<std::uint32_t>(is_dirty_.size());
  for (std::uint32_t looks = 0; looks < tile_count && tiles_.size() < tiles_max; ++looks) {
    if (std::exchange(is_dirty_[next_tile_], std::uint8_t{0}) != 0) {
      tiles_.push_back(tile_of(film, next_tile_));
    }
    next_tile_ = (next_tile_ + 1) % tile_count;
  }
  handed_over_.notify_one();
  next_ = Clock::now() + interval;
}

PictureTile Preview::tile_of(const core::Film& film, std::uint32_t index) const {
  const std::uint32_t x = index % columns_ * tile_side, y = index / columns_ * tile_side;
  const std::uint32_t width = std::min(tile_side, width_ - x), height = std::min(tile_side, height_ - y);
  PictureTile tile{static_cast<std::int32_t>(x),
                   static_cast<std::int32_t>(y),
                   static_cast<std::int32_t>(width),
                   static_cast<std::int32_t>(height),
                   {}};
  tile.rgb.reserve(std::size_t{3} * width * height);
  for (std::uint32_t row = y; row < y + height; ++row) {
    for (std::uint32_t pixel = row * width_ + x; pixel < row * width_ + x + width; ++pixel) {
      add_pixel(tile.rgb, film.sums(pixel), film.step(), film.samples(pixel) + new_samples_[pixel]);
    }
  }
  return tile;
}

/// Nobody would catch what leaves the thread: the picture goes on without a viewer.
void Preview::run_sender(const std::stop_token& stop) {
  try {
    send_tiles(stop);
  } catch (const std::exception&) {
    connection_.close();
    is_gone_.store(true, std::memory_order_relaxed);
  }
}

void Preview::send_tiles(const std::stop_token& stop) {
  connection_.send(create_packet(picture_, static_cast<std::int32_t>(width_), static_cast<std::int32_t>(height_)));
  std::unique_lock lock(mutex_);
  while (handed_over_.wait(lock, stop, [this] { return !tiles_.empty(); })) {
    const std::vector<PictureTile> tiles = std::exchange(tiles_, {});
    is_sending_ = true;
    lock.unlock();
    for (const PictureTile& tile : tiles) {
      connection_.send(tile_packet_(picture_, tile));
    }
    is_gone_.store(!connection_.is_open(), std::memory_order_relaxed);
    lock.lock();
    is_sending_ = false;
  }
}

void Preview::finish(const core::Film& film) {
  deadline_.store(Clock::now() + patience_at_the_end, std::memory_order_relaxed);  // the sender may see it a little later
  sender_.request_stop();
  sender_.join();
  std::fill(new_samples_.begin(), new_samples_.end(), 0);  // all samples are counted on the film
  for (std::uint32_t tile = 0; tile < is_dirty_.size() && connection_.is_open(); ++tile) {
    connection_.send(tile_packet_(picture_, tile_of(film, tile)));
  }
}

}  // namespace dmpc::apps
