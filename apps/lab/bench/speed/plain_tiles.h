// A plain renderer's picture, tile by tile.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <vector>

#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/bench/speed/plain_stage.h"
#include "core/base/units.h"

namespace dmpc::apps {

/// On so many threads, each of which takes the next tile when it is done with one, and asks a Worker of its own, made from the
/// stage, for each pixel: color(worker, column, row). Workers count rays().
template <class Worker, class Color>
PlainPicture painted(const PlainStage& stage, std::uint32_t thread_count, const Color& color) {
  const int width = stage.settings().camera.width(), height = stage.settings().camera.height();
  const int columns = core::ceil_divide(width, plain_tile_side), tiles = columns * core::ceil_divide(height, plain_tile_side);
  PlainPicture picture{.pixels = core::ZeroedArray<core::Color>(stage.settings().camera.pixel_count())};
  std::vector<std::uint64_t> rays(thread_count);
  std::atomic<int> next_tile = 0;
  on_threads(thread_count, [&](std::size_t thread) {
    Worker worker(stage);
    for (int tile = next_tile++; tile < tiles; tile = next_tile++) {
      const int left = tile % columns * plain_tile_side, top = tile / columns * plain_tile_side;
      for (int y = top; y < std::min(top + plain_tile_side, height); ++y) {
        for (int x = left; x < std::min(left + plain_tile_side, width); ++x) {
          picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              color(worker, x, y);
        }
      }
    }
    rays[thread] = worker.rays();
  });
  picture.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return picture;
}

}  // namespace dmpc::apps
