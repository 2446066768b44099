// The picture in a viewer while it comes into being.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "apps/edge/viewer/connection.h"
#include "apps/edge/viewer/tev_packet.h"
#include "core/picture/film.h"
#include "core/picture/partial_picture.h"
#include "core/picture/refinement.h"

namespace dmpc::apps {

/// Cuts the film into tiles and sends those on which light has fallen, a few times a second. A thread of its own does the
/// sending; the host's thread copies tiles only while that has nothing to send, so it never waits. A viewer that goes away is
/// left alone.
///
/// What goes wrong on that thread, memory that is short above all, ends the preview and nothing else.
///
/// Thread safety: made, finished and destroyed by one thread; in between one other thread, the host's, calls watch().
class Preview {
 public:
  /// How a viewer is told of a tile; it may throw.
  using TilePacket = std::function<std::string(const std::string& picture, const PictureTile& tile)>;

  /// Nothing, if no viewer listens at `address`. `picture` is what the viewer is to call it; `start`: what is done before, if
  /// anything. Once `stop` is requested nothing more is sent.
  static std::unique_ptr<Preview> to_viewer(const ViewerAddress& address, const std::string& picture, int width, int height,
                                            const core::PartialPicture* start = nullptr, std::stop_token stop = {},
                                            TilePacket tile_packet = update_packet);
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  /// Light has come to a pixel of the pass.
  void watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel);
  /// Sends the whole picture as it is in the end, or what of it a viewer takes within two seconds. Requires that watch() is not
  /// called any more.
  void finish(const core::Film& film);

 private:
  using Clock = std::chrono::steady_clock;

  Preview(const ViewerAddress& address, std::string picture, int width, int height, const core::PartialPicture* start,
          std::stop_token stop, TilePacket tile_packet);

  PictureTile tile_of(const core::Film& film, std::uint32_t index) const;
  void hand_over(const core::Film& film);
  void run_sender(const std::stop_token& stop);
  void send_tiles(const std::stop_token& stop);

  std::atomic<Clock::time_point> deadline_ = Clock::time_point::max();
  ViewerConnection connection_;  ///< the sender's
  std::string picture_;
  TilePacket tile_packet_;
  std::uint32_t width_, height_, columns_;
  std::vector<std::uint8_t> is_dirty_;      ///< tile by tile: to be sent
  std::vector<std::uint32_t> new_samples_;  ///< of each pixel, in the pass under way: those that light has come of
  std::uint32_t next_tile_ = 0;             ///< at which to look first, so that each has its turn
  std::uint32_t pass_ = 0;
  std::uint32_t calls_ = 0;
  Clock::time_point next_;
  std::mutex mutex_;
  std::condition_variable_any handed_over_;
  std::vector<PictureTile> tiles_;  ///< handed over, and not taken; mutex_ guards this and is_sending_
  bool is_sending_ = false;
  std::atomic<bool> is_gone_ = false;  ///< the viewer
  std::jthread sender_;
};

}  // namespace dmpc::apps
