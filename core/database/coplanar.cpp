#include "core/database/coplanar.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/database/cover_finder.h"
#include "core/database/face.h"
#include "core/database/plane_buckets.h"
#include "core/database/twins.h"

namespace dmpc::core {
namespace {

using Ids = std::vector<std::uint32_t>;

/// Sets of faces whose planes are apart are taken apart so often; what is left then keeps its own distances.
constexpr int rounds_max = 16;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Pairs of a top cell's triangles that cover each other, or lead from one to the other of such.
Pairs covering_pairs(const Conversion& conversion, std::span<const std::uint32_t> ids) {
  std::vector<Face> faces;
  faces.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
      faces.emplace_back(conversion.primitives[id], id, conversion.sources[id].object);
    }
  }
  const PlaneBuckets buckets = fill_plane_buckets(faces);
  if (buckets.buckets.empty()) {
    return {};
  }
  CoverFinder finder(faces);
  for (const PlaneBucket& bucket : buckets.buckets) {
    finder.look_at(buckets.faces_of(bucket), bucket.axis);
  }
  return finder.found();
}

/// Triangles that cover each other, in sets of two or more.
std::vector<Ids> covering_sets(const Conversion& conversion, const TopCells& cells, const Parallel& parallel) {
  std::vector<Pairs> pairs(cells.size());
  parallel.for_each(cells.size(), [&](std::size_t cell) { pairs[cell] = covering_pairs(conversion, cells.ids(cell)); });
  if (std::all_of(pairs.begin(), pairs.end(), [](const Pairs& some) { return some.empty(); })) {
    return {};
  }
  MergedSets sets(conversion.primitives.size());
  Ids ids;
  for (const Pairs& some : pairs) {
    for (const auto& [a, b] : some) {
      sets.merge(a, b);
      ids.insert(ids.end(), {a, b});
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_set;
  for (const std::uint32_t id : ids) {
    by_set.emplace_back(sets.least_with(id), id);
  }
  std::sort(by_set.begin(), by_set.end());
  std::vector<Ids> result;
  for (std::size_t first = 0, last = 0; first < by_set.size(); first = last) {
    result.emplace_back();
    for (last = first; last < by_set.size() && by_set[last].first == by_set[first].first; ++last) {
      result.back().push_back(by_set[last].second);
    }
  }
  return result;
}

/// The plane nearest to all corners, in the direction of `axis`, by least squares.
FacePlane fitted_plane(const std::vector<Face>& faces, std::size_t axis) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  Vec3d middle;
  for (const Face& face : faces) {
    middle = middle + face.middle() * (1.0 / static_cast<double>(faces.size()));
  }
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  for (const Face& face : faces) {
    for (const Vec3d& corner : face.corner) {
      const Vec3d off = corner - middle;
      xx += off[next] * off[next];
      xy += off[next] * off[last];
      yy += off[last] * off[last];
      xz += off[next] * off[axis];
      yz += off[last] * off[axis];
    }
  }
  const double determinant = xx * yy - xy * xy;
  Vec3d normal;
  normal[axis] = 1;
  normal[next] = -(xz * yy - yz * xy) / determinant;
  normal[last] = -(yz * xx - xz * xy) / determinant;
  normal = normalize(normal);
  return {normal, dot(normal, middle)};
}

/// The highest: the one whose plane rounding turns least.
const Face& largest_of(const std::vector<Face>& faces) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    largest = faces[i].altitude > faces[largest].altitude ? i : largest;
  }
  return faces[largest];
}

/// Finds the planes of sets, and who lies in which.
class Planes {
 public:
  explicit Planes(Conversion& conversion) : conversion_(conversion) {}

  /// How many sets have a coordinate in common, by which their plane is known.
  std::uint32_t level_count() const { return level_count_; }

  /// Gives a set its plane: that of its largest triangle if all lie in it, which keeps planes along the axes exact, else the one
  /// nearest to all. Those that lie in neither get planes of their own.
  void share(const Ids& set) {
    if (set.size() > 1 && is_level(set)) {
      ++level_count_;
      for (const std::uint32_t id : set) {
        conversion_.primitives[id].lie_in(PrimitiveValues::level_plane);
      }
      return;
    }
    Ids rest = set;
    for (int round = 0; round < rounds_max && rest.size() > 1; ++round) {
      std::vector<Face> faces;
      for (const std::uint32_t id : rest) {
        faces.emplace_back(conversion_.primitives[id], id, conversion_.sources[id].object);
      }
      const Face& largest = largest_of(faces);
      const FacePlane fitted = fitted_plane(faces, largest.main_axis());
      const auto all_lie_in = [&](const FacePlane& plane) {
        return std::all_of(faces.begin(), faces.end(), [&](const Face& face) { return lies_in(face, plane); });
      };
      rest = lie_in(rest, faces, !all_lie_in(largest.plane) && all_lie_in(fitted) ? fitted : largest.plane);
    }
  }

 private:
  bool is_level(const Ids& set) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float level = conversion_.primitives[set[0]].value[axis];
      if (std::all_of(set.begin(), set.end(), [&](std::uint32_t id) {
            const auto& value = conversion_.primitives[id].value;
            return value[axis] == level && value[3 + axis] == level && value[6 + axis] == level;
          })) {
        return true;
      }
    }
    return false;
  }

  /// Returns those that do not lie in the plane.
  Ids lie_in(const Ids& ids, const std::vector<Face>& faces, const FacePlane& plane) {
    Ids members, others;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      (lies_in(faces[i], plane) ? members : others).push_back(ids[i]);
    }
    if (members.size() > 1) {
      conversion_.planes.push_back(plane);
    }
    for (const std::uint32_t id : members) {
      conversion_.primitives[id].lie_in(members.size() > 1 ? static_cast<std::uint32_t>(conversion_.planes.size()) : 0);
    }
    return others;
  }

  Conversion& conversion_;
  std::uint32_t level_count_ = 0;
};

/// By who shows where triangles cover each other: what transmits comes after what does not.
void sort_by_precedence(Ids& set, const Conversion& conversion, std::span<const Material> materials) {
  std::stable_partition(set.begin(), set.end(),
                        [&](std::uint32_t id) { return !(materials[conversion.shading[id].material()].transmittance > 0); });
}

/// Takes out of a set, which comes by precedence, what has the corners of one before it.
void take_duplicates(const Conversion& conversion, Ids& set, Ids& duplicates) {
  std::vector<std::pair<SortedCorners, std::size_t>> sorted;
  for (std::size_t place = 0; place < set.size(); ++place) {
    sorted.emplace_back(sorted_corners(conversion.primitives[set[place]]), place);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> is_double(set.size());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    is_double[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  }
  Ids kept;
  for (std::size_t place = 0; place < set.size(); ++place) {
    (is_double[place] ? duplicates : kept).push_back(set[place]);
  }
  set = std::move(kept);
}

}  // namespace

bool settle_coplanar(Conversion& conversion, const TopCells& cells, std::span<const Material> materials,
                     const Parallel& parallel) {
  std::vector<Ids> sets = covering_sets(conversion, cells, parallel);
  if (sets.empty()) {
    return false;
  }
  Planes planes(conversion);
  Ids from(conversion.primitives.size()), duplicates;
  std::iota(from.begin(), from.end(), 0U);
  for (Ids& set : sets) {
    Ids places = set;
    sort_by_precedence(set, conversion, materials);
    for (std::size_t i = 0; i < set.size(); ++i) {
      from[places[i]] = set[i];
    }
    take_duplicates(conversion, set, duplicates);
    planes.share(set);
  }
  std::sort(duplicates.begin(), duplicates.end());
  std::erase_if(from, [&](std::uint32_t id) { return std::binary_search(duplicates.begin(), duplicates.end(), id); });
  conversion.shared_planes = planes.level_count() + static_cast<std::uint32_t>(conversion.planes.size());
  conversion.duplicates += static_cast<std::uint32_t>(duplicates.size());
  rearrange(conversion, from);
  return true;
}

}  // namespace dmpc::core
