#include "core/database/faces/plane_buckets.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <unordered_map>

#include "core/base/box.h"
#include "core/base/sampling.h"
#include "core/database/faces/plane_lanes.h"

namespace dmpc::core {
namespace {

/// A bucket that contains at least one face.
struct Bucket {
  static constexpr std::uint32_t several = 0xffffffffU;

  std::uint64_t key;     ///< its position; the lowest bits are the axis
  std::uint32_t object;  ///< the object of its faces if they have only one
  std::uint32_t count;   ///< number of its faces
};

/// The membership of a face in a bucket.
struct Filing {
  std::uint32_t bucket, face;
};

Surroundings surroundings_of(std::span<const Face> faces) {
  Box box;
  for (const Face& face : faces) {
    box.include(face.corner[0]);
  }
  const Vec3d extent = box.high - box.low;
  return {box.center(), std::max({extent.x, extent.y, extent.z, 1e-6})};
}

constexpr std::uint32_t dimension_bits = 20;
constexpr std::int32_t place_middle = 1 << (dimension_bits - 1);

std::uint64_t key_of(std::size_t axis, std::int32_t slope, std::int32_t other_slope, std::int32_t height) {
  const auto bits = [](std::int32_t place) { return std::uint64_t{static_cast<std::uint32_t>(place + place_middle)}; };
  return ((bits(slope) << dimension_bits | bits(other_slope)) << dimension_bits | bits(height)) << 2U | axis;
}

/// Finds the buckets of faces with a hash table of the buckets in use.
class BucketFiller {
 public:
  explicit BucketFiller(std::span<const Face> faces) : faces_(faces), slots_(std::bit_ceil(2 * faces.size() + 1), vacant) {
    buckets_.reserve(faces.size());
    filings_.reserve(2 * faces.size());
  }

  void fill(const BucketSize& size) {
    PlaneLanes lanes(size, surroundings_of(faces_));
    for (std::size_t first = 0; first < faces_.size(); first += PlaneLanes::count_max) {
      const std::size_t count = std::min(PlaneLanes::count_max, faces_.size() - first);
      lanes.find(faces_.subspan(first, count));
      for (std::size_t lane = 0; lane < count; ++lane) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (lanes.is_seen(lane, axis)) {
            add(static_cast<std::uint32_t>(first + lane), axis, lanes.place(lane, axis));
          }
        }
      }
    }
  }

  /// Passes on the faces of each bucket with several objects, in an order that depends only on the buckets' positions.
  template <class Take>
  void take_shared(const Take& take) const {
    const std::vector<std::uint32_t> shared = shared_buckets();
    if (shared.empty()) {
      return;
    }
    std::vector<std::uint32_t> next(buckets_.size(), vacant);
    std::uint32_t end = 0;
    for (const std::uint32_t bucket : shared) {
      next[bucket] = end;
      end += buckets_[bucket].count;
    }
    std::vector<std::uint32_t> faces(end);
    for (const Filing& filing : filings_) {
      if (next[filing.bucket] != vacant) {
        faces[next[filing.bucket]++] = filing.face;
      }
    }
    for (const std::uint32_t bucket : shared) {
      const std::size_t count = buckets_[bucket].count;
      take(buckets_[bucket].key & 3U, std::span<const std::uint32_t>(faces).subspan(next[bucket] - count, count));
    }
  }

 private:
  static constexpr std::uint32_t vacant = 0xffffffffU;

  void add(std::uint32_t face, std::size_t axis, const PlanePlace& place) {
    for (std::int32_t i = place.slopes.first; i <= place.slopes.last; ++i) {
      for (std::int32_t j = place.other_slopes.first; j <= place.other_slopes.last; ++j) {
        for (std::int32_t k = place.heights.first; k <= place.heights.last; ++k) {
          add(face, key_of(axis, i, j, k));
        }
      }
    }
  }

  void add(std::uint32_t face, std::uint64_t key) {
    std::uint32_t& slot = slot_of(key);
    const std::uint32_t object = faces_[face].object;
    filings_.push_back({slot, face});
    if (slot != vacant) {
      Bucket& bucket = buckets_[slot];
      bucket.object = bucket.object == object ? object : Bucket::several;
      ++bucket.count;
      return;
    }
    filings_.back().bucket = slot = static_cast<std::uint32_t>(buckets_.size());
    buckets_.push_back({key, object, 1});
    if (2 * buckets_.size() > slots_.size()) {
      grow();
    }
  }

  /// The table's slot that holds the bucket's number, or will hold it.
  std::uint32_t& slot_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (key * 0x9e3779b97f4a7c15U >> 32U) & mask;
    while (slots_[at] != vacant && buckets_[slots_[at]].key != key) {
      at = (at + 1) & mask;
    }
    return slots_[at];
  }

  void grow() {
    slots_.assign(2 * slots_.size(), vacant);
    for (std::uint32_t bucket = 0; bucket < buckets_.size(); ++bucket) {
      slot_of(buckets_[bucket].key) = bucket;
    }
  }

  std::vector<std::uint32_t> shared_buckets() const {
    const std::uint64_t mask = std::bit_ceil(2 * filings_.size() + 1) - 1;
    std::vector<std::tuple<std::uint64_t, std::uint64_t, std::uint32_t>> shared;
    for (std::uint32_t bucket = 0; bucket < buckets_.size(); ++bucket) {
      if (buckets_[bucket].object == Bucket::several) {
        const std::uint64_t mixed = mixed_key(buckets_[bucket].key);
        shared.emplace_back(mixed >> 2U & mask, mixed, bucket);
      }
    }
    std::sort(shared.begin(), shared.end());
    std::vector<std::uint32_t> buckets;
    buckets.reserve(shared.size());
    for (const auto& [slot, key, bucket] : shared) {
      buckets.push_back(bucket);
    }
    return buckets;
  }

  /// The key by which buckets are ordered.
  static std::uint64_t mixed_key(std::uint64_t key) {
    const auto place = [&](std::uint32_t dimension) {
      constexpr std::uint64_t all = (std::uint64_t{1} << dimension_bits) - 1;
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(key >> (2 + dimension * dimension_bits) & all) - place_middle);
    };
    const std::uint64_t mixed = mix(mix(std::uint64_t{place(2)} << 32U | place(1)) + place(0));
    return (mixed & ~std::uint64_t{3}) | (key & 3U);
  }

  std::span<const Face> faces_;
  std::vector<std::uint32_t> slots_;  ///< bucket numbers, as an open-addressing hash table
  std::vector<Bucket> buckets_;
  std::vector<Filing> filings_;
};

/// Detects buckets with the same faces as an earlier one: planes at a bucket's border, and planes that lean equally along two
/// axes, are in several buckets. Coverage is the same along each of these axes.
class SameFaces {
 public:
  explicit SameFaces(const PlaneBuckets& all) : all_(all) {}

  /// Whether an earlier bucket has these faces; if not, the one added next does.
  bool are_known(std::span<const std::uint32_t> faces) {
    std::uint64_t hash = 0;
    for (const std::uint32_t face : faces) {
      hash = (hash ^ face) * 0x9e3779b97f4a7c15U;
    }
    const auto [found, is_new] = by_hash_.try_emplace(hash, all_.buckets.size());
    if (is_new) {
      return false;
    }
    const auto known = all_.faces_of(all_.buckets[found->second]);
    return std::equal(known.begin(), known.end(), faces.begin(), faces.end());
  }

 private:
  const PlaneBuckets& all_;
  std::unordered_map<std::uint64_t, std::size_t> by_hash_;
};

}  // namespace

PlaneBuckets fill_plane_buckets(std::span<const Face> faces, const BucketSize& size) {
  BucketFiller filler(faces);
  filler.fill(size);
  PlaneBuckets result;
  SameFaces same(result);
  filler.take_shared([&](std::size_t axis, std::span<const std::uint32_t> shared) {
    if (!same.are_known(shared)) {
      const std::size_t begin = result.faces.size();
      result.faces.insert(result.faces.end(), shared.begin(), shared.end());
      result.buckets.push_back({axis, begin, result.faces.size()});
    }
  });
  return result;
}

}  // namespace dmpc::core
