#include "core/build/cover_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dmpc::core {
namespace {

/// Pairs that are looked at, for each triangle and however few there are: a fan of 700 triangles about one corner is within it.
constexpr std::size_t pairs_per_triangle = 256;
constexpr std::size_t pairs_least = 0x40000;
/// Squares that a triangle is in, on average.
constexpr std::size_t squares_per_triangle = 8;
constexpr std::size_t raster_side_max = 4096;
/// Planes of one bucket, where pairs are too many to be looked at.
constexpr std::size_t planes_max = 64;

}  // namespace

MergedSets::MergedSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

std::uint32_t MergedSets::least_with(std::uint32_t number) {
  while (parents_[number] != number) {
    number = parents_[number] = parents_[parents_[number]];
  }
  return number;
}

void MergedSets::merge(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t first = least_with(a), second = least_with(b);
  parents_[std::max(first, second)] = std::min(first, second);
}

/// Squares over all faces, seen along an axis.
struct CoverFinder::Raster {
  Raster(std::span<const Face> faces, std::size_t axis, std::size_t squares) : axes{(axis + 1) % 3, (axis + 2) % 3}, side(squares) {
    double extent = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      double high = -std::numeric_limits<double>::infinity();
      for (const Face& face : faces) {
        const auto [least, greatest] = bounds(face, i);
        low[i] = std::min(low[i], least);
        high = std::max(high, greatest);
      }
      extent = std::max(extent, high - low[i]);
    }
    scale = static_cast<double>(side) / std::max(extent, 1e-30);
  }

  std::pair<double, double> bounds(const Face& face, std::size_t i) const {
    return std::minmax({face.corner[0][axes[i]], face.corner[1][axes[i]], face.corner[2][axes[i]]});
  }
  /// The first and last square of a face along one of the axes.
  std::pair<std::size_t, std::size_t> squares(const Face& face, std::size_t i) const {
    const auto [least, greatest] = bounds(face, i);
    const auto square = [&](double at) { return std::min(static_cast<std::size_t>((at - low[i]) * scale), side - 1); };
    return {square(least), square(greatest)};
  }

  std::array<std::size_t, 2> axes;
  std::size_t side;
  std::array<double, 2> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double scale = 1;
};

void CoverFinder::merge(std::span<const std::uint32_t> ids, std::size_t axis) {
  faces_.clear();
  for (const std::uint32_t id : ids) {
    faces_.emplace_back(primitives_[id]);
  }
  if (!merge_pairs(ids, axis)) {
    merge_planes(ids);
  }
}

/// Lists the faces of each square, of squares as small as lists of bounded length allow.
void CoverFinder::list_squares(std::size_t axis) {
  auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(faces_.size())));
  side = std::clamp<std::size_t>(side, 1, raster_side_max);
  while (!list_squares(Raster(faces_, axis, side))) {
    side /= 2;
  }
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.square < b.square || (a.square == b.square && a.place < b.place); });
}

/// False if the lists are too long; one square's never are.
bool CoverFinder::list_squares(const Raster& raster) {
  const std::size_t most = squares_per_triangle * faces_.size();
  entries_.clear();
  for (std::uint32_t place = 0; place < faces_.size(); ++place) {
    const auto [left, right] = raster.squares(faces_[place], 0);
    const auto [bottom, top] = raster.squares(faces_[place], 1);
    if (entries_.size() + (right - left + 1) * (top - bottom + 1) > most) {
      return false;
    }
    for (std::size_t y = bottom; y <= top; ++y) {
      for (std::size_t x = left; x <= right; ++x) {
        entries_.push_back({static_cast<std::uint32_t>(y * raster.side + x), place});
      }
    }
  }
  return true;
}

/// False if there are too many pairs.
bool CoverFinder::merge_pairs(std::span<const std::uint32_t> ids, std::size_t axis) {
  list_squares(axis);
  pairs_left_ = pairs_per_triangle * faces_.size() + pairs_least;
  for (std::size_t first = 0, last = 0; first < entries_.size(); first = last) {
    while (last < entries_.size() && entries_[last].square == entries_[first].square) {
      ++last;
    }
    if (!merge_pairs_in_square(ids, axis, std::span(entries_).subspan(first, last - first))) {
      return false;
    }
  }
  return true;
}

bool CoverFinder::merge_pairs_in_square(std::span<const std::uint32_t> ids, std::size_t axis, std::span<const Entry> square) {
  for (std::size_t i = 0; i < square.size(); ++i) {
    const std::size_t pairs = square.size() - i - 1;
    if (pairs > pairs_left_) {
      return false;
    }
    pairs_left_ -= pairs;
    const std::uint32_t a = square[i].place;
    for (const Entry& other : square.subspan(i + 1)) {
      const std::uint32_t b = other.place;
      const bool is_open = sources_[ids[a]].object != sources_[ids[b]].object && sets_.least_with(ids[a]) != sets_.least_with(ids[b]);
      if (is_open && are_coplanar(faces_[a], faces_[b]) && cover(faces_[a], faces_[b], axis)) {
        sets_.merge(ids[a], ids[b]);
      }
    }
  }
  return true;
}

/// Takes the largest, all that lie in its plane, the largest of the others, and so on.
void CoverFinder::merge_planes(std::span<const std::uint32_t> ids) {
  std::vector<std::uint32_t> rest(faces_.size());
  std::iota(rest.begin(), rest.end(), 0U);
  for (std::size_t planes = 0; planes < planes_max && rest.size() > 1; ++planes) {
    const std::uint32_t largest = *std::max_element(
        rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) { return faces_[a].altitude < faces_[b].altitude; });
    const auto others = std::partition(rest.begin(), rest.end(), [&](std::uint32_t place) {
      return place != largest && !are_coplanar(faces_[place], faces_[largest]);
    });
    std::for_each(others, rest.end(), [&](std::uint32_t place) { sets_.merge(ids[place], ids[largest]); });
    rest.erase(others, rest.end());
  }
}

}  // namespace dmpc::core
