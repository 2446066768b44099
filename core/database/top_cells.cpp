#include "core/database/top_cells.h"

#include <algorithm>
#include <cmath>

#include "core/base/morton.h"
#include "core/base/units.h"
#include "core/database/overlap.h"
#include "core/record/directory.h"

namespace dmpc::core {
namespace {

/// Top cells that list a primitive, on average. The SPD's scenes need 1 to 1.2; four times the usual memory is for the worst.
constexpr std::size_t top_cells_max = 3;
/// Primitives that one thread lists at a time.
constexpr std::size_t chunk_size = 8192;

}  // namespace

class TopCells::Lister {
 public:
  Lister(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad)
      : primitives_(primitives),
        size_(top_cells(frame)),
        low_(frame.low),
        edge_(double{frame.finest_cell} * finest_per_top),
        pad_(pad) {}

  /// Lists the primitives of a chunk until there are more than `bound`.
  std::vector<Touch> touches_of(std::size_t chunk, std::size_t bound) const {
    std::vector<Touch> touches;
    touches.reserve(chunk_size * 5 / 4);
    const std::size_t end = std::min(primitives_.size(), (chunk + 1) * chunk_size);
    for (std::size_t id = chunk * chunk_size; id < end && touches.size() <= bound; ++id) {
      add(static_cast<std::uint32_t>(id), touches);
    }
    return touches;
  }

 private:
  using Place = std::array<std::int32_t, 3>;  ///< of a top cell

  std::uint32_t index_of(const Place& place) const {
    return static_cast<std::uint32_t>(
        directory_index(size_, {place[0] * finest_per_top, place[1] * finest_per_top, place[2] * finest_per_top}));
  }

  void add(std::uint32_t id, std::vector<Touch>& touches) const {
    const Box box = bounds_of(primitives_[id]).padded({pad_, pad_, pad_});
    Place first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto clamped = [&](double at) {
        return static_cast<std::int32_t>(std::clamp((at - low_[axis]) / edge_, 0.0, size_[axis] - 1.0));
      };
      first[axis] = clamped(box.low[axis]);
      last[axis] = clamped(box.high[axis]);
    }
    if (first == last) {
      touches.push_back({index_of(first), id});
    } else {
      add_touched(id, first, last, touches);
    }
  }

  void add_touched(std::uint32_t id, const Place& first, const Place& last, std::vector<Touch>& touches) const {
    const Overlap overlap(primitives_[id]);
    const Vec3d half{edge_ / 2 + pad_, edge_ / 2 + pad_, edge_ / 2 + pad_};
    for (std::int32_t z = first[2]; z <= last[2]; ++z) {
      for (std::int32_t y = first[1]; y <= last[1]; ++y) {
        for (std::int32_t x = first[0]; x <= last[0]; ++x) {
          if (overlap.touches(low_ + Vec3d{x + 0.5, y + 0.5, z + 0.5} * edge_, half)) {
            touches.push_back({index_of({x, y, z}), id});
          }
        }
      }
    }
  }

  std::span<const PrimitiveValues> primitives_;
  Place size_;
  Vec3d low_;  ///< where the grid begins
  double edge_;
  double pad_;
};

std::optional<TopCells> TopCells::list(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                       const Parallel& parallel) {
  const std::size_t bound = top_cells_max * (primitives.size() + 8);
  const Lister lister(primitives, frame, pad);
  std::vector<std::vector<Touch>> touches(ceil_divide(primitives.size(), chunk_size));
  parallel.for_each(touches.size(), [&](std::size_t chunk) { touches[chunk] = lister.touches_of(chunk, bound); });
  std::size_t count = 0;
  for (const auto& some : touches) {
    count += some.size();
  }
  return count > bound ? std::nullopt : std::optional(TopCells(frame, touches));
}

/// Sorts by counting.
TopCells::TopCells(const GridFrame& frame, const std::vector<std::vector<Touch>>& touches) {
  const auto size = top_cells(frame);
  std::vector<std::uint32_t> counts(directory_entry_count(size));
  for (const auto& some : touches) {
    for (const Touch& touch : some) {
      ++counts[touch.cell];
    }
  }
  Corner corner{};
  const auto at = [&](std::size_t axis) { return static_cast<std::uint64_t>(corner[axis] / finest_per_top); };
  for (corner[2] = 0; corner[2] < size[2] * finest_per_top; corner[2] += finest_per_top) {
    for (corner[1] = 0; corner[1] < size[1] * finest_per_top; corner[1] += finest_per_top) {
      for (corner[0] = 0; corner[0] < size[0] * finest_per_top; corner[0] += finest_per_top) {
        if (const std::uint32_t count = counts[directory_index(size, corner)]; count > 0) {
          cells_.push_back({morton_code(at(0), at(1), at(2)), corner, 0, count});
        }
      }
    }
  }
  std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.code < b.code; });
  std::vector<std::size_t> next(counts.size());
  std::size_t end = 0;
  for (Cell& cell : cells_) {
    next[directory_index(size, cell.corner)] = cell.first = end;
    end += cell.count;
  }
  ids_.resize(end);
  for (const auto& some : touches) {
    for (const Touch& touch : some) {
      ids_[next[touch.cell]++] = touch.id;
    }
  }
}

}  // namespace dmpc::core
