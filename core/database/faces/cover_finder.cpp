#include "core/database/faces/cover_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/database/faces/meeting_faces.h"

namespace dmpc::core {
namespace {

/// The number of pairs tested for each face, and the minimum for few faces; a fan of 700 triangles about one corner is within it.
constexpr std::size_t pairs_per_face = 256;
constexpr std::size_t pairs_least = 0x40000;
/// Up to this number of faces a single square is used.
constexpr std::size_t one_square_max = 16;
/// The maximum average number of squares that a face is in.
constexpr std::size_t squares_per_face = 8;
constexpr std::size_t raster_side_max = 4096;
/// From this number of faces in a square on, duplicates are searched for.
constexpr std::size_t crowd_least = 64;
/// The object id of a face that stands for equal faces of several objects.
constexpr std::uint32_t several_objects = 0xffffffff;
/// The maximum number of planes in a bucket with too many pairs to test.
constexpr std::size_t planes_max = 64;

/// Any order in which equal corners are adjacent.
bool is_before(const std::array<Vec3d, 3>& a, const std::array<Vec3d, 3>& b) {
  const auto values = [](const std::array<Vec3d, 3>& corner) {
    return std::array{corner[0].x, corner[0].y, corner[0].z, corner[1].x, corner[1].y,
                      corner[1].z, corner[2].x, corner[2].y, corner[2].z};
  };
  return values(a) < values(b);
}

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

/// A grid of squares over the extent of all faces.
class CoverFinder::Raster {
 public:
  Raster(std::span<const Seen> seen, std::size_t squares) : side_(squares) {
    double extent = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      double high = -std::numeric_limits<double>::infinity();
      for (const Seen& face : seen) {
        low_[axis] = std::min(low_[axis], face.low[axis]);
        high = std::max(high, face.high[axis]);
      }
      extent = std::max(extent, high - low_[axis]);
    }
    scale_ = static_cast<double>(side_) / std::max(extent, 1e-30);
  }

  std::size_t square(double at, std::size_t axis) const {
    return std::min(static_cast<std::size_t>((at - low_[axis]) * scale_), side_ - 1);
  }
  std::size_t side() const { return side_; }

 private:
  std::size_t side_;
  std::array<double, 2> low_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double scale_ = 1;
};

void CoverFinder::look_at(std::span<const std::uint32_t> some, std::size_t axis) {
  see(some, axis);
  if (!look_at_pairs(axis)) {
    look_at_planes(some);
  }
}

void CoverFinder::look_at_meeting() {
  const bool are_all_seen = find_meeting_faces(faces_, [&](std::uint32_t a, std::uint32_t b) {
    if (are_leaning(faces_[a], faces_[b])) {
      judge(a, b, (faces_[a].altitude >= faces_[b].altitude ? faces_[a] : faces_[b]).main_axis());
    }
  });
  for (std::size_t face = 0; face < faces_.size() && !are_all_seen; ++face) {
    if (faces_[face].altitude < low_altitude) {
      unseen_.push_back(faces_[face].id);
    }
  }
}

void CoverFinder::see(std::span<const std::uint32_t> some, std::size_t axis) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  seen_.clear();
  for (const std::uint32_t face : some) {
    const auto& corner = faces_[face].corner;
    const auto low = [&](std::size_t along) { return std::min({corner[0][along], corner[1][along], corner[2][along]}); };
    const auto high = [&](std::size_t along) { return std::max({corner[0][along], corner[1][along], corner[2][along]}); };
    seen_.push_back({{low(next), low(last)}, {high(next), high(last)}, face, faces_[face].object});
  }
}

/// Lists the faces of each square. The squares are as small as the maximum length of the lists allows.
void CoverFinder::list_squares() {
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(seen_.size())));
  std::size_t side = seen_.size() <= one_square_max ? 1 : std::min(root, raster_side_max);
  while (!list_squares(Raster(seen_, side))) {
    side /= 2;
  }
  sort_by_square(side * side);
}

/// A counting sort, which keeps the order of entries within a square.
void CoverFinder::sort_by_square(std::size_t square_count) {
  if (square_count == 1) {
    return;
  }
  next_.assign(square_count + 1, 0);
  for (const Entry& entry : entries_) {
    ++next_[entry.square + 1];
  }
  std::partial_sum(next_.begin(), next_.end(), next_.begin());
  sorted_.resize(entries_.size());
  for (const Entry& entry : entries_) {
    sorted_[next_[entry.square]++] = entry;
  }
  std::swap(entries_, sorted_);
}

/// False if the lists are too long; they never are with a single square.
bool CoverFinder::list_squares(const Raster& raster) {
  const std::size_t most = squares_per_face * seen_.size();
  entries_.clear();
  for (std::uint32_t place = 0; place < seen_.size(); ++place) {
    const Seen& face = seen_[place];
    const std::size_t left = raster.square(face.low[0], 0), right = raster.square(face.high[0], 0);
    const std::size_t bottom = raster.square(face.low[1], 1), top = raster.square(face.high[1], 1);
    if (entries_.size() + (right - left + 1) * (top - bottom + 1) > most) {
      return false;
    }
    for (std::size_t y = bottom; y <= top; ++y) {
      for (std::size_t x = left; x <= right; ++x) {
        entries_.push_back({static_cast<std::uint32_t>(y * raster.side() + x), place, face.object});
      }
    }
  }
  return true;
}

/// False if there are too many.
bool CoverFinder::look_at_pairs(std::size_t axis) {
  list_squares();
  pairs_left_ = pairs_per_face * seen_.size() + pairs_least;
  for (std::size_t first = 0, last = 0; first < entries_.size(); first = last) {
    while (last < entries_.size() && entries_[last].square == entries_[first].square) {
      ++last;
    }
    const auto square = std::span<const Entry>(entries_).subspan(first, last - first);
    if (!look_at_square(axis, square.size() < crowd_least ? square : without_twins(axis, square))) {
      return false;
    }
  }
  return true;
}

/// Keeps one of several faces with the same corners, which meet the same other faces, and pairs it with its duplicates.
std::span<const CoverFinder::Entry> CoverFinder::without_twins(std::size_t axis, std::span<const Entry> square) {
  const auto corner_of = [&](const Entry& entry) -> const auto& { return faces_[seen_[entry.place].face].corner; };
  distinct_.assign(square.begin(), square.end());
  std::stable_sort(distinct_.begin(), distinct_.end(),
                   [&](const Entry& a, const Entry& b) { return is_before(corner_of(a), corner_of(b)); });
  std::size_t kept = 0, first = 0;  // number kept, and the first of the equal ones
  for (std::size_t i = 0; i < distinct_.size(); ++i) {
    const Entry entry = distinct_[i];
    const bool is_twin = kept > 0 && corner_of(distinct_[first]) == corner_of(entry);
    first = is_twin ? first : kept;
    Entry& like = distinct_[first];
    if (is_twin && like.object != entry.object && judge(seen_[like.place].face, seen_[entry.place].face, axis)) {
      like.object = several_objects;
    } else {
      distinct_[kept++] = entry;
    }
  }
  distinct_.resize(kept);
  std::sort(distinct_.begin(), distinct_.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
  return distinct_;
}

/// Faces of one object are consecutive, except for a face that represents several.
bool CoverFinder::look_at_square(std::size_t axis, std::span<const Entry> square) {
  const auto is_one_object = [](const Entry& a, const Entry& b) { return a.object == b.object && a.object != several_objects; };
  for (std::size_t i = 0, others = 0; i < square.size(); ++i) {
    while (others < square.size() && (others <= i || is_one_object(square[others], square[i]))) {
      ++others;
    }
    const std::size_t pairs = square.size() - others;
    if (pairs > pairs_left_) {
      return false;
    }
    pairs_left_ -= pairs;
    const Seen& a = seen_[square[i].place];
    const auto meets = [&](const Seen& b) {
      return std::min(a.high[0], b.high[0]) - std::max(a.low[0], b.low[0]) > sliver &&
             std::min(a.high[1], b.high[1]) - std::max(a.low[1], b.low[1]) > sliver;
    };
    for (const Entry& other : square.subspan(others)) {
      const Seen& b = seen_[other.place];
      if (meets(b) && !is_one_object(square[i], other)) {
        judge(a.face, b.face, axis);
      }
    }
  }
  return true;
}

bool CoverFinder::judge(std::uint32_t a, std::uint32_t b, std::size_t axis) {
  const bool is_known = close_.leads(a, b);
  if (is_known && coplanar_.leads(a, b)) {
    return true;
  }
  if (!cover(faces_[a], faces_[b], axis)) {
    return false;
  }
  const bool share_plane = are_coplanar(faces_[a], faces_[b]);
  if (share_plane) {
    merge(a, b, true);
  } else if (!is_known && are_near(faces_[a], faces_[b])) {
    merge(a, b, false);
  } else if (!is_known && are_in_reach(faces_[a], faces_[b])) {
    merge_in(reached_, a, b);
  }
  return share_plane;
}

/// Takes the largest face and all in or near its plane, then the largest of the others, and so on.
void CoverFinder::look_at_planes(std::span<const std::uint32_t> some) {
  std::vector<std::uint32_t> rest(some.begin(), some.end());
  for (std::size_t planes = 0; planes < planes_max && rest.size() > 1; ++planes) {
    const std::uint32_t largest = *std::max_element(
        rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) { return faces_[a].altitude < faces_[b].altitude; });
    const auto others = std::partition(rest.begin(), rest.end(), [&](std::uint32_t face) {
      return face != largest && !are_coplanar(faces_[face], faces_[largest]) && !are_near(faces_[face], faces_[largest]);
    });
    std::for_each(others, rest.end(), [&](std::uint32_t face) {
      merge(face, largest, face == largest || are_coplanar(faces_[face], faces_[largest]));
    });
    rest.erase(others, rest.end());
  }
  std::for_each(rest.begin(), rest.end(), [&](std::uint32_t face) { unseen_.push_back(faces_[face].id); });
}

/// Faces that are coplanar in their records are only close in double.
void CoverFinder::merge(std::uint32_t a, std::uint32_t b, bool are_coplanar) {
  merge_in(close_, a, b);
  if (are_coplanar && !faces_[a].is_by_doubles && !faces_[b].is_by_doubles) {
    merge_in(coplanar_, a, b);
  }
}

void CoverFinder::merge_in(Found& found, std::uint32_t a, std::uint32_t b) {
  if (!found.leads(a, b)) {
    found.merge(a, b, faces_.size());
    found.pairs.emplace_back(faces_[a].id, faces_[b].id);
  }
}

}  // namespace dmpc::core
