// The picture during its rendering, for a thread that shows it.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/sampling/refinement.h"

namespace dmpc::apps {

/// A rectangle of a picture.
struct PictureTile {
  std::uint32_t index = 0;     ///< index of the tile, row by row
  std::uint32_t x = 0, y = 0;  ///< upper left pixel
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;  ///< linear, row by row
};

/// Divides the film into tiles and passes on those that have changed: the host's thread copies a tile at the next change after it
/// was requested, and never waits. Takes 4 bytes a pixel.
///
/// Thread safety: made, begun again and finished by one thread; in between one other thread, the host's, calls watch(), and any
/// thread calls take().
class LivePicture {
 public:
  /// `start`: what is already rendered, if anything.
  LivePicture(std::uint32_t width, std::uint32_t height, const core::PartialPicture* start = nullptr);

  /// Maximum at a time; a picture of 512x512 has as many.
  static constexpr std::size_t tiles_max = 64;

  std::uint32_t tile_count() const { return static_cast<std::uint32_t>(is_dirty_.size()); }

  /// To be called when a pixel of the pass has received light.
  void watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel);
  /// The tiles passed on since the last call, up to `tiles_max`; requests more.
  std::vector<PictureTile> take();
  /// Begins another picture of the same size.
  void begin_again();
  /// The finished picture. Requires that watch() is not called any more.
  std::vector<PictureTile> finish(const core::Film& film);

 private:
  PictureTile tile_of(const core::Film& film, std::uint32_t index) const;
  void migration(const core::Film& film);

  std::uint32_t width_, height_, columns_;
  std::vector<std::uint8_t> is_dirty_;      ///< per tile: to be passed on
  std::vector<std::uint32_t> new_samples_;  ///< samples per pixel that have arrived in the current pass
  std::uint32_t next_tile_ = 0;             ///< tile to check first, so that each has its turn
  std::uint32_t pass_ = 0;
  std::atomic<bool> is_asked_for_ = false;
  std::mutex mutex_;
  std::vector<PictureTile> tiles_;  ///< passed on, but not taken; guarded by mutex_
};

}  // namespace dmpc::apps
