#include "apps/show/page/play_cells.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::apps::html {

PlayCells::PlayCells(int width, int height, std::size_t cells_max) : width_(width), height_(height) {
  core::expect(width > 0 && height > 0 && cells_max > 0, "a picture that is played has a pixel");
  while (cell_count() > cells_max) {
    side_ *= 2;
  }
}

std::size_t PlayCells::cell_of(std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(width_), side = static_cast<std::size_t>(side_);
  return pixel / width / side * static_cast<std::size_t>(wide()) + pixel % width / side;
}

std::vector<std::uint64_t> PlayCells::sums(std::span<const std::uint64_t> values) const {
  std::vector<std::uint64_t> cells(cell_count());
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
    cells[cell_of(pixel)] += values[pixel];
  }
  return cells;
}

std::vector<std::uint64_t> PlayCells::largest(std::span<const std::uint64_t> values) const {
  std::vector<std::uint64_t> cells(cell_count());
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
    std::uint64_t& cell = cells[cell_of(pixel)];
    cell = std::max(cell, values[pixel]);
  }
  return cells;
}

std::vector<std::uint64_t> PlayCells::of_last(std::span<const std::uint64_t> values, std::span<const std::uint64_t> done) const {
  std::vector<std::uint64_t> cells(cell_count()), last(cell_count());
  std::vector<bool> is_set(cell_count());
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
    if (const std::size_t cell = cell_of(pixel); !is_set[cell] || done[pixel] > last[cell]) {
      cells[cell] = values[pixel];
      last[cell] = done[pixel];
      is_set[cell] = true;
    }
  }
  return cells;
}

}  // namespace dmpc::apps::html
