#include "core/scene/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/ranges.h"
#include "core/base/units.h"
#include "core/scene/frame.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {
namespace {

/// The number of objects that are examined, evenly spread over all, including copies of meshes.
constexpr std::size_t objects_max = 65536;
/// Objects count as no smaller than this share of the scene: below it doubles distinguish nothing.
constexpr double least_share = 0x1p-40;

/// The share of the detail that must lie close together.
constexpr double close_part = 0.75;
/// Slices of a scene, each twice as wide as the maximum distance of detail from its centre, plus two.
constexpr std::size_t slice_count = static_cast<std::size_t>(0.5 / close_share) + 2;

struct Weighted {
  double value, weight;
};

/// The least value such that this share of the weight lies at or below it.
double quantile(std::vector<Weighted>& all, double share) {
  std::sort(all.begin(), all.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  const double wanted = sum_over<double>(all, [&](const Weighted& one) { return one.weight * share; });
  auto at = all.begin();
  for (double sum = at->weight; sum < wanted && at + 1 != all.end(); sum += at->weight) {
    ++at;
  }
  return at->value;
}

Box box_of(const PlacedObject& placed) {
  const Scene& scene = placed.pools();
  const Object& object = placed.object();
  Box box;
  if (object.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[object.first];
    box.include(sphere.center, std::fabs(sphere.radius));
  } else if (object.kind == ObjectKind::cone) {
    const Cone& cone = scene.cones[object.first];
    box.include(cone.base, std::fabs(cone.base_radius));
    box.include(cone.apex, std::fabs(cone.apex_radius));
  } else {
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
      box.include(placed.vertex(i));
    }
  }
  return box;
}

struct Detail {
  Vec3d center;
  double weight;
};

/// The details of all objects except those that the bounds exclude as degenerate or too far away.
std::vector<Detail> details_of(const Scene& scene, const Box& bounds, double extent) {
  std::vector<Detail> details;
  const PlacedObjects objects(scene);
  objects.for_each(
      [&](const PlacedObject& object) {
        const Box box = box_of(object);
        const double size = largest_component(box.high - box.low);
        if (size > 0 && size <= 2 * extent && bounds.holds(box.center())) {
          const double share = std::max(size / extent, least_share);
          details.push_back({box.center(), 1 / (share * share)});
        }
      },
      std::max<std::uint64_t>(1, ceil_divide(objects.size(), std::uint64_t{objects_max})));
  return details;
}

/// Whether no cube of half side `reach` can hold the close part of all details: along some axis no two adjacent slices do, each
/// as wide as the cube. That rules out most scenes, whose detail is spread, without sorting.
bool are_spread(const std::vector<Detail>& details, const Box& bounds, double reach) {
  constexpr double rounding = 0x1p-20;  // far more than the rounding of slices and sums
  const double slices = 1 / (2 * reach * (1 + rounding));
  for (std::size_t axis = 0; axis < 3 && std::isnormal(slices); ++axis) {
    std::array<double, slice_count> weight{};
    double all = 0;
    for (const Detail& one : details) {
      weight[static_cast<std::size_t>((one.center[axis] - bounds.low[axis]) * slices)] += one.weight;
      all += one.weight;
    }
    double most = 0;
    for (std::size_t slice = 0; slice + 1 < weight.size(); ++slice) {
      most = std::max(most, weight[slice] + weight[slice + 1]);
    }
    if (most < (close_part - rounding) * all) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<Vec3d> place_of_detail(const Scene& scene, const Box& bounds) {
  const double extent = bounds.empty() ? 0 : largest_component(bounds.high - bounds.low);
  const std::vector<Detail> details = extent > 0 ? details_of(scene, bounds, extent) : std::vector<Detail>();
  if (details.empty() || are_spread(details, bounds, close_share * extent)) {
    return std::nullopt;
  }
  std::vector<Weighted> values(details.size());
  const auto quantile_of = [&](double share, const auto& value) {
    std::transform(details.begin(), details.end(), values.begin(), [&](const Detail& one) {
      return Weighted{value(one.center), one.weight};
    });
    return quantile(values, share);
  };
  Vec3d place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place[axis] = quantile_of(0.5, [&](const Vec3d& center) { return center[axis]; });
  }
  const double reach = quantile_of(close_part, [&](const Vec3d& center) { return largest_component(center - place); });
  return reach <= close_share * extent ? std::optional(place) : std::nullopt;
}

}  // namespace dmpc::core
