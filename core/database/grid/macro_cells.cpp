#include "core/database/grid/macro_cells.h"

#include <algorithm>
#include <utility>

#include "core/base/morton.h"
#include "core/base/units.h"
#include "core/database/tree/overlap.h"
#include "core/record/directory.h"

namespace dmpc::core {
namespace {

/// The maximum mean number of macro cells that list a primitive: four times the usual memory. The SPD's scenes need 1 to 1.2.
constexpr std::size_t macro_cells_max = 3;
/// The number of primitives that one thread lists at a time.
constexpr std::size_t cells_chunk_size = 8192;
/// Ranges of up to this number of cells are not halved.
constexpr std::int64_t cells_one_by_one = 16;

}  // namespace

void coarsen(GridFrame& frame) {
  for (std::int32_t& cells : frame.resolution) {
    cells = ceil_divide(cells, 2);
  }
  frame.finest_cell *= 2;
}

namespace {

using CellPlace = std::array<std::int32_t, 3>;  ///< a macro cell's

/// The first and the last macro cell that a box touches.
struct CellRange {
  CellPlace first, last;
};

/// The cell that contains `at` along an axis; cells begin at `begin`, have this edge, and are numbered up to `most`.
[[gnu::always_inline]] inline std::int32_t cell_at(double at, double begin, double edge, double most) {
  const double place = (at - begin) / edge, within = place < 0.0 ? 0.0 : place;
  return static_cast<std::int32_t>(most < within ? most : within);
}

}  // namespace

class MacroCells::Lister {
 public:
  Lister(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad, bool lists_boxes = false)
      : primitives_(primitives),
        size_(macro_cells(frame)),
        low_(frame.low),
        edge_(double{frame.finest_cell} * finest_per_macro),
        pad_(pad),
        lists_boxes_(lists_boxes) {}

  std::size_t chunk_count() const { return ceil_divide(primitives_.size(), cells_chunk_size); }

  /// Lists the primitives of a chunk from the last position on; stops before one that would bring more than `bound` touches.
  void list(std::size_t chunk, std::size_t bound, Listed& listed) const {
    const std::size_t end = std::min(primitives_.size(), (chunk + 1) * cells_chunk_size);
    listed.next = std::max(listed.next, chunk * cells_chunk_size);
    listed.is_cut_off = false;
    while (listed.next < end && !listed.is_cut_off) {
      list(primitives_[listed.next], bound, listed);
    }
  }

  bool is_within_one(const Box& box) const {
    const CellRange range = range_of(box);
    return range.first == range.last;
  }

 private:
  /// The cells touched by the box, padded.
  CellRange range_of(const Box& box) const {
    CellRange range{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.first[axis] = cell_at(box.low[axis] - pad_, low_[axis], edge_, size_[axis] - 1.0);
      range.last[axis] = cell_at(box.high[axis] + pad_, low_[axis], edge_, size_[axis] - 1.0);
    }
    return range;
  }

  /// Lists the next primitive, unless there would be too many touches.
  void list(const PrimitiveValues& primitive, std::size_t bound, Listed& listed) const {
    const std::size_t before = listed.touches.size();
    if (primitive.kind != PrimitiveKind::instance) {
      add(static_cast<std::uint32_t>(listed.next), range_of(bounds_of(primitive)), bound, listed.touches);
    }
    listed.is_cut_off = listed.touches.size() > bound;
    if (listed.is_cut_off) {
      listed.touches.resize(before);
    } else {
      ++listed.next;
    }
  }

  std::uint32_t index_of(const CellPlace& place) const {
    return static_cast<std::uint32_t>(
        directory_index(size_, {place[0] * finest_per_macro, place[1] * finest_per_macro, place[2] * finest_per_macro}));
  }

  /// Returns as soon as there are more than `bound` touches.
  void add(std::uint32_t id, const CellRange& range, std::size_t bound, std::vector<Touch>& touches) const {
    const auto& [first, last] = range;
    if (first == last) {
      touches.push_back({index_of(first), id});
    } else if (lists_boxes_) {
      add_all(id, first, last, bound, touches);
    } else {
      add_touched(id, Overlap(primitives_[id]), first, last, bound, touches);
    }
  }

  void add_all(std::uint32_t id, const CellPlace& first, const CellPlace& last, std::size_t bound,
               std::vector<Touch>& touches) const {
    for (std::int32_t z = first[2]; z <= last[2]; ++z) {
      for (std::int32_t y = first[1]; y <= last[1]; ++y) {
        for (std::int32_t x = first[0]; x <= last[0] && touches.size() <= bound; ++x) {
          touches.push_back({index_of({x, y, z}), id});
        }
      }
    }
  }

  /// If there are many cells between `first` and `last`, halves that it does not touch are left out at once: a long primitive
  /// lies in few of them.
  void add_touched(std::uint32_t id, const Overlap& overlap, const CellPlace& first, const CellPlace& last, std::size_t bound,
                   std::vector<Touch>& touches) const {
    std::size_t longest = 0;
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      longest = last[axis] - first[axis] > last[longest] - first[longest] ? axis : longest;
      count *= last[axis] - first[axis] + 1;
    }
    if (count <= cells_one_by_one) {
      return add_touched_of_few(id, overlap, first, last, bound, touches);
    }
    CellPlace end = last, begin = first;
    end[longest] = first[longest] + (last[longest] - first[longest]) / 2;
    begin[longest] = end[longest] + 1;
    for (const auto& [low, high] : {std::pair(first, end), std::pair(begin, last)}) {
      if (touches.size() <= bound && may_touch(overlap, low, high)) {
        add_touched(id, overlap, low, high, bound, touches);
      }
    }
  }

  void add_touched_of_few(std::uint32_t id, const Overlap& overlap, const CellPlace& first, const CellPlace& last,
                          std::size_t bound, std::vector<Touch>& touches) const {
    const Vec3d half{edge_ / 2 + pad_, edge_ / 2 + pad_, edge_ / 2 + pad_};
    for (std::int32_t z = first[2]; z <= last[2]; ++z) {
      for (std::int32_t y = first[1]; y <= last[1]; ++y) {
        for (std::int32_t x = first[0]; x <= last[0] && touches.size() <= bound; ++x) {
          if (overlap.touches(low_ + Vec3d{x + 0.5, y + 0.5, z + 0.5} * edge_, half)) {
            touches.push_back({index_of({x, y, z}), id});
          }
        }
      }
    }
  }

  /// Whether the primitive may touch one of the cells; conservative, so the test uses slightly larger cells.
  bool may_touch(const Overlap& overlap, const CellPlace& first, const CellPlace& last) const {
    Vec3d middle, half;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      middle[axis] = low_[axis] + (first[axis] + last[axis] + 1) * 0.5 * edge_;
      half[axis] = ((last[axis] - first[axis] + 1) * 0.5 + 0x1p-20) * edge_ + pad_;
    }
    return overlap.touches(middle, half);
  }

  std::span<const PrimitiveValues> primitives_;
  CellPlace size_;
  Vec3d low_;  ///< the grid's lower corner
  double edge_;
  double pad_;
  bool lists_boxes_;
};

/// No chunk continues beyond four times its share of the bound before all have reached that, so that hopeless lists end early:
/// after four times the bound, whatever the number of chunks.
std::optional<MacroCells> MacroCells::list(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                           const Parallel& parallel, std::int64_t excess) {
  const auto boxes = std::count_if(primitives.begin(), primitives.end(),
                                   [](const PrimitiveValues& one) { return one.kind == PrimitiveKind::instance; });
  const auto listed = static_cast<std::int64_t>(primitives.size()) - boxes;
  const std::int64_t bound = std::int64_t{macro_cells_max} * (listed + 8) - excess;
  if (bound < listed) {
    return std::nullopt;  // each primitive is in at least one cell
  }
  return list_within(Lister(primitives, frame, pad), static_cast<std::size_t>(bound), 4 * macro_cells_max * cells_chunk_size,
                     frame, Order::morton, parallel);
}

std::uint64_t MacroCells::touches_of(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                     std::uint64_t most) {
  const Lister lister(primitives, frame, pad);
  std::uint64_t touches = 0;
  for (std::size_t chunk = 0; chunk < lister.chunk_count(); ++chunk) {
    Listed listed;
    lister.list(chunk, most - touches, listed);
    if (listed.is_cut_off) {
      return most + 1;
    }
    touches += listed.touches.size();
  }
  return touches;
}

std::int64_t MacroCells::excess_of(std::uint64_t touches, std::uint64_t count) {
  return static_cast<std::int64_t>(touches) - std::int64_t{macro_cells_max} * static_cast<std::int64_t>(count);
}

/// Otherwise list() has no space for `listed` primitives that are in one cell each.
std::uint64_t MacroCells::touches_max(std::uint64_t count, std::uint64_t listed) {
  return macro_cells_max * (count + listed + 8) - listed;
}

bool MacroCells::is_within_one(const Box& box, const GridFrame& frame, double pad) {
  return Lister({}, frame, pad).is_within_one(box);
}

/// No chunk continues beyond its share of the bound before all have reached theirs.
std::optional<MacroCells> MacroCells::list_voxels(std::span<const PrimitiveValues> primitives, const GridFrame& frame, double pad,
                                                  const VoxelRule& rule, const Parallel& parallel) {
  const Lister lister(primitives, frame, pad, rule.lists_boxes);
  const std::size_t share = rule.references_max / std::max(lister.chunk_count(), std::size_t{1}) + 1;
  return list_within(lister, rule.references_max, share, frame, rule.follows_space ? Order::morton : Order::z_fastest, parallel);
}

std::optional<MacroCells> MacroCells::list_within(const Lister& lister, std::size_t bound, std::size_t chunk_bound,
                                                  const GridFrame& frame, Order order, const Parallel& parallel) {
  std::vector<Listed> chunks(lister.chunk_count());
  parallel.for_each(chunks.size(), [&](std::size_t chunk) {
    chunks[chunk].touches.reserve(cells_chunk_size * 5 / 4);
    lister.list(chunk, std::min(bound, chunk_bound), chunks[chunk]);
  });
  std::size_t count = 0;
  for (const Listed& chunk : chunks) {
    count += chunk.touches.size();
  }
  for (std::size_t chunk = 0; chunk < chunks.size() && count <= bound; ++chunk) {
    if (chunks[chunk].is_cut_off) {
      const std::size_t before = chunks[chunk].touches.size();
      lister.list(chunk, before + bound - count, chunks[chunk]);
      if (chunks[chunk].is_cut_off) {
        return std::nullopt;
      }
      count += chunks[chunk].touches.size() - before;
    }
  }
  return count > bound ? std::nullopt : std::optional(MacroCells(frame, chunks, order));
}

/// A counting sort.
MacroCells::MacroCells(const GridFrame& frame, const std::vector<Listed>& chunks, Order order) {
  const auto size = macro_cells(frame);
  std::vector<std::uint32_t> counts(directory_entry_count(size));
  for (const Listed& chunk : chunks) {
    for (const Touch& touch : chunk.touches) {
      ++counts[touch.cell];
    }
  }
  for_each_macro_cell({}, grid_size(frame), false, [&](const Corner& corner) {
    const auto at = [&](std::size_t axis) { return static_cast<std::uint64_t>(corner[axis] / finest_per_macro); };
    if (const std::uint32_t count = counts[directory_index(size, corner)]; count > 0) {
      cells_.push_back({order == Order::morton ? morton_code(at(0), at(1), at(2)) : voxel_index(size, corner), corner, 0, count});
    }
  });
  std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.code < b.code; });
  std::vector<std::size_t> next(counts.size());
  std::size_t end = 0;
  for (Cell& cell : cells_) {
    next[directory_index(size, cell.corner)] = cell.first = end;
    end += cell.count;
  }
  ids_.resize(end);
  for (const Listed& chunk : chunks) {
    for (const Touch& touch : chunk.touches) {
      ids_[next[touch.cell]++] = touch.id;
    }
  }
}

}  // namespace dmpc::core
