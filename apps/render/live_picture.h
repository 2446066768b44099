// The picture while it comes into being, for a thread that shows it.
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

/// Cuts the film into tiles and hands over those on which light has fallen, as soon as light comes after it was asked for them:
/// the host's thread never waits. Takes 4 bytes a pixel.
///
/// Thread safety: made, begun again and finished by one thread; in between one other thread, the host's, calls watch(), and any
/// calls take().
class LivePicture {
 public:
  /// `start`: what is done before, if anything.
  LivePicture(std::uint32_t width, std::uint32_t height, const core::PartialPicture* start = nullptr);

  /// At a time; as many as a picture of 512x512 has.
  static constexpr std::size_t tiles_max = 64;

  std::uint32_t tile_count() const { return static_cast<std::uint32_t>(is_dirty_.size()); }

  /// Light has come to a pixel of the pass.
  void watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel);
  /// What was handed over since the last call, up to `tiles_max`; more is asked for.
  std::vector<PictureTile> take();
  /// Another picture of the same size.
  void begin_again();
  /// The whole picture as it is in the end. Requires that watch() is not called any more.
  std::vector<PictureTile> finish(const core::Film& film);

 private:
  PictureTile tile_of(const core::Film& film, std::uint32_t index) const;
  void migration(const core::Film& film);

  std::uint32_t width_, height_, columns_;
  std::vector<std::uint8_t> is_dirty_;      ///< tile by tile: to be handed over
  std::vector<std::uint32_t> new_samples_;  ///< samples per pixel that have arrived in the current pass
  std::uint32_t next_tile_ = 0;             ///< at which to look first, so that each has its turn
  std::uint32_t pass_ = 0;
  std::atomic<bool> is_asked_for_ = false;
  std::mutex mutex_;
  std::vector<PictureTile> tiles_;  ///< handed over, and not taken; mutex_ guards this
};

}  // namespace dmpc::apps
