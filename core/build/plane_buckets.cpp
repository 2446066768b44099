#include "core/build/plane_buckets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/sampling.h"
#include "core/base/units.h"
#include "core/build/face.h"

namespace dmpc::core {
namespace {

/// A bucket's edge, in slopes and, local to the grid, in heights.
constexpr double bucket_edge = 0x1p-9;
/// Heights are measured here, in the middle of the largest grid.
constexpr double reference = 0.5;
/// Triangles that one thread looks at at a time.
constexpr std::size_t chunk_size = 8192;

/// A bucket that a triangle is in. Two buckets have one key by chance alone, and then lose nothing by it.
struct Place {
  std::uint64_t key;  ///< the lowest bits: the axis
  std::uint32_t id;

  bool operator<(const Place& other) const { return std::tie(key, id) < std::tie(other.key, other.id); }
};

/// Buckets along one of the space's dimensions.
struct Range {
  Range(double value, double error)
      : first(static_cast<std::int32_t>(std::floor((value - error) / bucket_edge))),
        last(static_cast<std::int32_t>(std::floor((value + error) / bucket_edge))) {}

  std::int32_t first, last;
};

std::uint64_t key_of(std::size_t axis, std::int32_t slope, std::int32_t other_slope, std::int32_t height) {
  const std::uint64_t high = static_cast<std::uint32_t>(slope), low = static_cast<std::uint32_t>(other_slope);
  const std::uint64_t mixed = mix(mix(high << 32U | low) + static_cast<std::uint32_t>(height));
  return (mixed & ~std::uint64_t{3}) | axis;
}

/// Appends the buckets of triangle `id` for planes that face `axis`.
void add_along(const Face& face, std::uint32_t id, std::size_t axis, double error, std::vector<Place>& places) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  const Vec3d& normal = face.plane.normal;
  const double slope = -normal[next] / normal[axis], other_slope = -normal[last] / normal[axis];
  const Vec3d& corner = face.corner[0];
  const double away = reference - corner[next], other_away = reference - corner[last];
  const double height = corner[axis] + slope * away + other_slope * other_away;
  const double height_error = 8 * face.moved + error * (std::fabs(away) + std::fabs(other_away));
  const Range slopes(slope, error), other_slopes(other_slope, error), heights(height, height_error);
  for (std::int32_t i = slopes.first; i <= slopes.last; ++i) {
    for (std::int32_t j = other_slopes.first; j <= other_slopes.last; ++j) {
      for (std::int32_t k = heights.first; k <= heights.last; ++k) {
        places.push_back({key_of(axis, i, j, k), id});
      }
    }
  }
}

void add(const PrimitiveValues& triangle, std::uint32_t id, std::vector<Place>& places) {
  const Face face(triangle);
  const std::size_t main = face.main_axis();
  const bool is_level = face.corner[0][main] == face.corner[1][main] && face.corner[0][main] == face.corner[2][main];
  // Corners that move across the plane turn the normal; slopes change by up to three times as much.
  const double error = is_level ? 0.0 : 8 * face.moved / face.altitude;
  if (!(error < bucket_edge)) {
    return;
  }
  // A plane between two axes may face either, for another triangle.
  const double most = std::fabs(face.plane.normal[main]) * (1 - 4 * error) - 1e-12;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::fabs(face.plane.normal[axis]) >= most) {
      add_along(face, id, axis, error, places);
    }
  }
}

using Places = std::vector<std::vector<Place>>;

/// What is alone in its bucket, or with others of its object, is most of a scene. A table of fewer slots than there are buckets
/// finds the rest, and a little more.
class Sieve {
 public:
  explicit Sieve(std::size_t place_count) : slots_(std::bit_ceil(4 * place_count + 1), vacant) {}

  void add(const Place& place, std::uint32_t object) {
    std::uint32_t& slot = slots_[slot_of(place)];
    slot = slot == vacant || slot == object ? object : several;
  }
  bool has_several(const Place& place) const { return slots_[slot_of(place)] == several; }

 private:
  static constexpr std::uint32_t vacant = 0xffffffffU, several = 0xfffffffeU;

  std::size_t slot_of(const Place& place) const { return place.key >> 2U & (slots_.size() - 1); }

  std::vector<std::uint32_t> slots_;  ///< the object that was there, if it was but one
};

Places all_places(const Conversion& conversion, const Parallel& parallel) {
  const std::size_t count = conversion.primitives.size();
  Places places(ceil_divide(count, chunk_size));
  parallel.for_each(places.size(), [&](std::size_t chunk) {
    places[chunk].reserve(2 * chunk_size);
    for (std::size_t id = chunk * chunk_size; id < std::min(count, (chunk + 1) * chunk_size); ++id) {
      if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
        add(conversion.primitives[id], static_cast<std::uint32_t>(id), places[chunk]);
      }
    }
  });
  return places;
}

std::vector<Place> shared_places(const Places& places, const std::vector<PrimitiveSource>& sources) {
  std::size_t count = 0;
  for (const auto& some : places) {
    count += some.size();
  }
  Sieve sieve(count);
  for (const auto& some : places) {
    for (const Place& place : some) {
      sieve.add(place, sources[place.id].object);
    }
  }
  std::vector<Place> shared;
  for (const auto& some : places) {
    std::copy_if(some.begin(), some.end(), std::back_inserter(shared), [&](const Place& place) { return sieve.has_several(place); });
  }
  return shared;
}

}  // namespace

PlaneBuckets fill_plane_buckets(const Conversion& conversion, const Parallel& parallel) {
  std::vector<Place> shared = shared_places(all_places(conversion, parallel), conversion.sources);
  std::sort(shared.begin(), shared.end());
  PlaneBuckets result;
  for (std::size_t first = 0, last = 0; first < shared.size(); first = last) {
    const auto object = [&](std::size_t place) { return conversion.sources[shared[place].id].object; };
    bool has_several = false;
    for (last = first; last < shared.size() && shared[last].key == shared[first].key; ++last) {
      has_several = has_several || object(last) != object(first);
    }
    if (has_several) {
      const std::size_t begin = result.ids.size();
      for (std::size_t place = first; place < last; ++place) {
        result.ids.push_back(shared[place].id);
      }
      result.buckets.push_back({shared[first].key & 3U, begin, result.ids.size()});
    }
  }
  return result;
}

}  // namespace dmpc::core
