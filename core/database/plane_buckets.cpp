#include "core/database/plane_buckets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
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

/// Buckets along one of the space's dimensions.
struct Range {
  Range(double value, double error, double edge) : first(bucket_of(value - error, edge)), last(bucket_of(value + error, edge)) {}

  /// Planes along an axis, which many are, lie in the middle of one.
  static std::int32_t bucket_of(double value, double edge) { return static_cast<std::int32_t>(std::floor(value / edge + 0.5)); }

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
  BucketFiller(std::span<const Face> faces, const BucketSize& size) : faces_(faces), size_(size), around_(faces) {
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
    const Range slopes(slope, error, size_.edge), other_slopes(other_slope, error, size_.edge),
        heights(height, height_error, size_.edge);
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
    struct Slot {
      std::uint32_t object = vacant;
      std::uint32_t count = 0;  ///< of what is in the slot; then where the next of it goes
    };
    std::vector<Slot> slots(std::bit_ceil(2 * filings_.size() + 1));
    const auto slot_of = [&](const Filing& filing) -> Slot& { return slots[filing.key >> 2U & (slots.size() - 1)]; };
    for (const Filing& filing : filings_) {
      Slot& slot = slot_of(filing);
      const std::uint32_t object = faces_[filing.face].object;
      slot.object = slot.object == vacant || slot.object == object ? object : several;
      ++slot.count;
    }
    std::uint32_t end = 0;
    for (Slot& slot : slots) {
      if (slot.object == several) {
        end += std::exchange(slot.count, end);
      }
    }
    std::vector<Filing> result(end);
    for (const Filing& filing : filings_) {
      if (Slot& slot = slot_of(filing); slot.object == several) {
        result[slot.count++] = filing;
      }
    }
    std::size_t first = 0;
    for (const Slot& slot : slots) {
      if (slot.object == several) {
        sort_if_mixed(std::span(result).subspan(first, slot.count - first));
        first = slot.count;
      }
    }
    return result;
  }

  /// A slot has several keys by chance alone.
  static void sort_if_mixed(std::span<Filing> filings) {
    if (std::any_of(filings.begin(), filings.end(), [&](const Filing& filing) { return filing.key != filings[0].key; })) {
      std::sort(filings.begin(), filings.end());
    }
  }

  std::span<const Face> faces_;
  BucketSize size_;
  Surroundings around_;
  std::vector<Filing> filings_;
};

}  // namespace

PlaneBuckets fill_plane_buckets(std::span<const Face> faces, const BucketSize& size) {
  PlaneBuckets result;
  const std::vector<Filing> filings = BucketFiller(faces, size).fill();
  for (std::size_t first = 0, last = 0; first < filings.size(); first = last) {
    bool has_several = false;
    for (last = first; last < filings.size() && filings[last].key == filings[first].key; ++last) {
      has_several = has_several || faces[filings[last].face].object != faces[filings[first].face].object;
    }
    if (has_several) {
      const std::size_t begin = result.faces.size();
      for (std::size_t filing = first; filing < last; ++filing) {
        result.faces.push_back(filings[filing].face);
      }
      result.buckets.push_back({filings[first].key & 3U, begin, result.faces.size()});
    }
  }
  return result;
}

}  // namespace dmpc::core
