#include "core/database/plane_buckets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/base/box.h"
#include "core/base/sampling.h"

namespace dmpc::core {
namespace {

/// A bucket that a face is in. Two buckets have one key by chance alone, and then lose nothing by it.
struct Filing {
  std::uint64_t key;  ///< the lowest bits: the axis
  std::uint32_t face;

  bool operator<(const Filing& other) const { return std::tie(key, face) < std::tie(other.key, other.face); }
};

/// The space that the faces take: heights are measured from its middle, in parts of its size.
struct Surroundings {
  explicit Surroundings(std::span<const Face> faces) {
    Box box;
    for (const Face& face : faces) {
      box.include(face.corner[0]);
    }
    middle = box.center();
    const Vec3d extent = box.high - box.low;
    size = std::max({extent.x, extent.y, extent.z, 1e-6});
  }

  Vec3d middle;
  double size;
};

/// Buckets along one of the space's dimensions, so many a unit, which is a power of two: to multiply by it rounds nothing.
struct Range {
  Range(double value, double error, double per_unit)
      : first(bucket_of(value - error, per_unit)), last(bucket_of(value + error, per_unit)) {}

  /// Planes along an axis, which many are, lie in the middle of one. Rounds down, quicker than std::floor() does.
  static std::int32_t bucket_of(double value, double per_unit) {
    const double place = value * per_unit + 0.5;
    const auto towards_zero = static_cast<std::int32_t>(place);
    return towards_zero - (place < static_cast<double>(towards_zero) ? 1 : 0);
  }

  std::int32_t first, last;
};

std::uint64_t key_of(std::size_t axis, std::int32_t slope, std::int32_t other_slope, std::int32_t height) {
  const std::uint64_t high = static_cast<std::uint32_t>(slope), low = static_cast<std::uint32_t>(other_slope);
  const std::uint64_t mixed = mix(mix(high << 32U | low) + static_cast<std::uint32_t>(height));
  return (mixed & ~std::uint64_t{3}) | axis;
}

/// Finds the buckets of faces, and sorts out what is alone in its bucket, or with others of its object: that is most of a scene.
class BucketFiller {
 public:
  BucketFiller(std::span<const Face> faces, const BucketSize& size)
      : faces_(faces), size_(size), per_unit_(1 / size.edge), around_(faces) {
    filings_.reserve(2 * faces.size());
  }

  std::vector<Filing> fill() {
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      add(faces_[i], i);
    }
    return sifted();
  }

 private:
  static constexpr std::uint32_t vacant = 0xffffffffU, several = 0xfffffffeU;
  /// So few keys of a slot are put one behind the other by going through it for each.
  static constexpr std::size_t keys_counted = 4;

  void add(const Face& face, std::uint32_t index) {
    const std::size_t main = face.main_axis();
    const bool is_level = face.is_level();
    // Corners that move across the plane turn the normal; slopes change by up to three times as much.
    const double turned = 8 * face.moved / face.altitude, by_rounding = is_level || face.is_by_doubles ? 0.0 : turned;
    const double error = is_level ? 0.0 : std::max(by_rounding, std::min(near_roundings * turned, size_.leaning));
    if (!(error < size_.edge)) {
      return;
    }
    // A plane between two axes may face either, for another triangle.
    const double most = std::fabs(face.plane.normal[main]) * (1 - 4 * error) - 1e-12;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::fabs(face.plane.normal[axis]) >= most) {
        add_along(face, index, axis, error);
      }
    }
  }

  void add_along(const Face& face, std::uint32_t index, std::size_t axis, double error) {
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Vec3d& normal = face.plane.normal;
    const double one_over = 1 / normal[axis], slope = -normal[next] * one_over, other_slope = -normal[last] * one_over;
    const Vec3d away = around_.middle - face.corner[0];
    const double height = (slope * away[next] + other_slope * away[last] - away[axis]) / around_.size;
    const double near = 8 * (near_roundings * face.moved + layers_reach_of(face.altitude));
    const double height_error =
        std::min((near + error * (std::fabs(away[next]) + std::fabs(away[last]))) / around_.size, size_.edge);
    const Range slopes(slope, error, per_unit_), other_slopes(other_slope, error, per_unit_),
        heights(height, height_error, per_unit_);
    for (std::int32_t i = slopes.first; i <= slopes.last; ++i) {
      for (std::int32_t j = other_slopes.first; j <= other_slopes.last; ++j) {
        for (std::int32_t k = heights.first; k <= heights.last; ++k) {
          filings_.push_back({key_of(axis, i, j, k), index});
        }
      }
    }
  }

  /// What a table of a few slots for each bucket finds beside others, and a little more; what has one key comes together.
  std::vector<Filing> sifted() {
    look_for_company();
    std::erase_if(filings_, [&](const Filing& filing) { return objects_[slot_of(filing)] != several; });
    if (filings_.empty()) {
      return {};
    }
    std::vector<std::uint32_t> next(objects_.size());  // by slot: how many of it there are, then where the next of it goes
    for (const Filing& filing : filings_) {
      ++next[slot_of(filing)];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& of_slot : next) {
      end += std::exchange(of_slot, end);
    }
    std::vector<Filing> result(end);
    for (const Filing& filing : filings_) {
      result[next[slot_of(filing)]++] = filing;
    }
    std::size_t first = 0;
    for (const std::uint32_t last : next) {
      sort_if_mixed(std::span(result).subspan(first, last - first));
      first = last;
    }
    return result;
  }

  std::size_t slot_of(const Filing& filing) const { return filing.key >> 2U & (objects_.size() - 1); }

  /// Finds the object of each slot, or that it has several: in a table of its own, which is the more likely to stay in the
  /// processor's cache.
  void look_for_company() {
    objects_.assign(std::bit_ceil(2 * filings_.size() + 1), vacant);
    for (const Filing& filing : filings_) {
      std::uint32_t& in_slot = objects_[slot_of(filing)];
      const std::uint32_t object = faces_[filing.face].object;
      in_slot = in_slot == vacant || in_slot == object ? object : several;
    }
  }

  /// A slot has several keys where planes lie alike along several axes, and else by chance alone. Within a key they are in order.
  void sort_if_mixed(std::span<Filing> filings) {
    keys_.clear();
    for (const Filing& filing : filings) {
      auto place = place_of(filing.key);
      if (place == keys_.end()) {
        if (keys_.size() == keys_counted) {
          return std::sort(filings.begin(), filings.end());
        }
        place = keys_.insert(place, {filing.key, 0});
      }
      ++place->next;
    }
    if (keys_.size() < 2) {
      return;
    }
    std::sort(keys_.begin(), keys_.end(), [](const KeyPlace& a, const KeyPlace& b) { return a.key < b.key; });
    std::size_t end = 0;
    for (KeyPlace& place : keys_) {
      end += std::exchange(place.next, end);
    }
    mixed_.assign(filings.begin(), filings.end());
    for (const Filing& filing : mixed_) {
      filings[place_of(filing.key)->next++] = filing;
    }
  }

  /// A key of a slot: how many of it there are, then where the next of it goes.
  struct KeyPlace {
    std::uint64_t key;
    std::size_t next;
  };
  std::vector<KeyPlace>::iterator place_of(std::uint64_t key) {
    return std::find_if(keys_.begin(), keys_.end(), [key](const KeyPlace& place) { return place.key == key; });
  }

  std::span<const Face> faces_;
  BucketSize size_;
  double per_unit_;  ///< buckets
  Surroundings around_;
  std::vector<Filing> filings_, mixed_;
  std::vector<KeyPlace> keys_;
  std::vector<std::uint32_t> objects_;  ///< by slot
};

/// Tells which buckets have the faces of one before them: planes at a bucket's border, and those that lean alike along two axes,
/// are in several. What covers what can be seen along any of these.
class SameFaces {
 public:
  explicit SameFaces(const PlaneBuckets& all) : all_(all) {}

  /// Whether some bucket has these; else the one that is added next does.
  bool are_known(std::span<const Filing> faces) {
    std::uint64_t hash = 0;
    for (const Filing& filing : faces) {
      hash = (hash ^ filing.face) * 0x9e3779b97f4a7c15U;
    }
    const auto [found, is_new] = by_hash_.try_emplace(hash, all_.buckets.size());
    if (is_new) {
      return false;
    }
    const auto known = all_.faces_of(all_.buckets[found->second]);
    return std::equal(known.begin(), known.end(), faces.begin(), faces.end(),
                      [](std::uint32_t face, const Filing& filing) { return face == filing.face; });
  }

 private:
  const PlaneBuckets& all_;
  std::unordered_map<std::uint64_t, std::size_t> by_hash_;
};

}  // namespace

PlaneBuckets fill_plane_buckets(std::span<const Face> faces, const BucketSize& size) {
  PlaneBuckets result;
  SameFaces same(result);
  const std::vector<Filing> filings = BucketFiller(faces, size).fill();
  for (std::size_t first = 0, last = 0; first < filings.size(); first = last) {
    bool has_several = false;
    for (last = first; last < filings.size() && filings[last].key == filings[first].key; ++last) {
      has_several = has_several || faces[filings[last].face].object != faces[filings[first].face].object;
    }
    const auto bucket = std::span(filings).subspan(first, last - first);
    if (has_several && !same.are_known(bucket)) {
      const std::size_t begin = result.faces.size();
      for (const Filing& filing : bucket) {
        result.faces.push_back(filing.face);
      }
      result.buckets.push_back({bucket.front().key & 3U, begin, result.faces.size()});
    }
  }
  return result;
}

}  // namespace dmpc::core
