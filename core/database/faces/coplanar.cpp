#include "core/database/faces/coplanar.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "core/database/faces/cover_finder.h"
#include "core/database/faces/exact_corners.h"
#include "core/database/faces/face.h"
#include "core/database/faces/face_stack.h"
#include "core/database/faces/plane_buckets.h"
#include "core/database/faces/twins.h"
#include "core/scene/base_meshes.h"
#include "core/scene/frame.h"

namespace dmpc::core {
namespace {

using Ids = std::vector<std::uint32_t>;

/// The number of times that sets of faces in separate planes are split further; the rest keep their own distances.
constexpr int rounds_max = 16;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Pairs of triangles that cover each other, or that connect such triangles.
struct CoveringPairs {
  Pairs coplanar;  ///< in one plane according to their records
  Pairs close;     ///< those, and faces that are near
  Pairs reached;   ///< and faces that layers of those may reach
  Ids unseen;      ///< faces whose covers were not searched for

  /// Faces that lie in one plane according to their records, or in two adjacent ones.
  void look_at_planes(std::span<const Face> faces, const BucketSize& size) {
    const PlaneBuckets buckets = fill_plane_buckets(faces, size);
    if (buckets.buckets.empty()) {
      return;
    }
    CoverFinder finder(faces);
    for (const PlaneBucket& bucket : buckets.buckets) {
      finder.look_at(buckets.faces_of(bucket), bucket.axis);
    }
    coplanar.insert(coplanar.end(), finder.coplanar().begin(), finder.coplanar().end());
    add_close(finder);
  }
  /// Faces that lean on other faces: only low faces are tested for that, and most of a scene has none.
  void look_at_meeting(std::span<const Face> faces) {
    if (std::none_of(faces.begin(), faces.end(), [](const Face& face) { return face.altitude < low_altitude; })) {
      return;
    }
    CoverFinder finder(faces);
    finder.look_at_meeting();
    add_close(finder);
  }
  void add_close(const CoverFinder& finder) {
    close.insert(close.end(), finder.close().begin(), finder.close().end());
    reached.insert(reached.end(), finder.reached().begin(), finder.reached().end());
    unseen.insert(unseen.end(), finder.unseen().begin(), finder.unseen().end());
  }
};

/// The exact corners of triangles, in double.
struct Exactly {
  const Conversion& conversion;
  const Scene& scene;
  const GridFrame& frame;
};

/// Whether the face is part of a curved surface, which it deviates from by far more than rounding moves it.
bool is_smooth(const Conversion& conversion, const Face& face) {
  const auto found = std::lower_bound(conversion.smooth.begin(), conversion.smooth.end(), face.id,
                                      [](const Conversion::Smooth& one, std::uint32_t id) { return one.primitive < id; });
  return found != conversion.smooth.end() && found->primitive == face.id;
}

/// The faces of those of the primitives that are triangles.
std::vector<Face> faces_of(const Conversion& conversion, std::span<const std::uint32_t> ids) {
  std::vector<Face> faces;
  faces.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
      faces.emplace_back(conversion.primitives[id], id, conversion.sources[id].object);
    }
  }
  return faces;
}

/// The pairs of a macro cell, except copies of a mesh, which is judged separately.
CoveringPairs covering_pairs(const Exactly& exactly, std::span<const std::uint32_t> ids) {
  const Conversion& conversion = exactly.conversion;
  Ids apart;
  if (exactly.scene.kept != nullptr) {
    std::copy_if(ids.begin(), ids.end(), std::back_inserter(apart),
                 [&](std::uint32_t id) { return place_of(exactly.scene, conversion.sources[id].object) == nullptr; });
    ids = apart;
  }
  std::vector<Face> faces = faces_of(conversion, ids);
  CoveringPairs pairs;
  pairs.look_at_planes(faces, fine_buckets);
  if (std::none_of(faces.begin(), faces.end(), [](const Face& face) { return face.altitude < low_altitude; })) {
    return pairs;
  }
  if (put_exact_corners(exactly.scene, exactly.frame, conversion, faces)) {
    pairs.look_at_planes(faces, coarse_buckets);
  }
  std::erase_if(faces, [&](const Face& face) { return is_smooth(conversion, face); });
  pairs.look_at_meeting(faces);
  return pairs;
}

/// Sets of two or more ids.
class FaceSets {
 public:
  explicit FaceSets(std::size_t primitive_count) : sets_(primitive_count) {}

  void add(std::uint32_t a, std::uint32_t b) {
    sets_.merge(a, b);
    ids_.insert(ids_.end(), {a, b});
  }
  void add_all(const Pairs& pairs) {
    for (const auto& [a, b] : pairs) {
      add(a, b);
    }
  }
  std::uint32_t least_with(std::uint32_t id) { return sets_.least_with(id); }
  /// The ids of all sets, ascending.
  const Ids& ids() {
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    return ids_;
  }
  std::vector<Ids> sets() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_set;
    for (const std::uint32_t id : ids()) {
      by_set.emplace_back(sets_.least_with(id), id);
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

 private:
  MergedSets sets_;
  Ids ids_;
};

/// Triangles that cover each other.
struct CoveringSets {
  FaceSets coplanar, close;
  Pairs reached;  ///< faces that they lead to
  Ids unseen;     ///< ascending, without duplicates
};

CoveringSets covering_sets(const Exactly& exactly, const MacroCells& cells, const Parallel& parallel) {
  std::vector<CoveringPairs> pairs(cells.size());
  parallel.for_each(cells.size(), [&](std::size_t cell) { pairs[cell] = covering_pairs(exactly, cells.ids(cell)); });
  const bool is_none = std::all_of(pairs.begin(), pairs.end(), [](const CoveringPairs& some) { return some.close.empty(); });
  const std::size_t count = is_none ? 0 : exactly.conversion.primitives.size();
  CoveringSets sets{FaceSets(count), FaceSets(count), {}, {}};
  for (const CoveringPairs& some : pairs) {
    sets.coplanar.add_all(some.coplanar);
    sets.close.add_all(some.close);
    sets.reached.insert(sets.reached.end(), some.reached.begin(), some.reached.end());
    sets.unseen.insert(sets.unseen.end(), some.unseen.begin(), some.unseen.end());
  }
  std::sort(sets.unseen.begin(), sets.unseen.end());
  sets.unseen.erase(std::unique(sets.unseen.begin(), sets.unseen.end()), sets.unseen.end());
  return sets;
}

/// Sets of triangles with their exact corners; each polygon is triangulated once.
class ExactSets {
 public:
  ExactSets(const Exactly& exactly, std::vector<Ids> sets) : sets_(std::move(sets)) {
    for (const Ids& set : sets_) {
      ids_.insert(ids_.end(), set.begin(), set.end());
    }
    std::sort(ids_.begin(), ids_.end());
    faces_ = exact_faces(exactly.scene, exactly.frame, exactly.conversion, ids_);
  }

  const std::vector<Ids>& sets() const { return sets_; }
  std::vector<Face> faces_of(const Ids& set) const {
    std::vector<Face> faces;
    faces.reserve(set.size());
    for (const std::uint32_t id : set) {
      faces.push_back(faces_[static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin())]);
    }
    return faces;
  }

 private:
  std::vector<Ids> sets_;
  Ids ids_;
  std::vector<Face> faces_;
};

/// One triangle of each polygon, for ascending ids; the triangles of a polygon have consecutive ids.
Ids one_of_each_polygon(const Conversion& conversion, const Ids& set) {
  Ids ids;
  std::unique_copy(set.begin(), set.end(), std::back_inserter(ids), [&](std::uint32_t a, std::uint32_t b) {
    return conversion.sources[a].object == conversion.sources[b].object;
  });
  return ids;
}

/// Adds the other triangles of a triangle's polygon.
void add_polygon(const Conversion& conversion, std::uint32_t id, FaceSets& sets) {
  const auto is_of_it = [&](std::uint32_t other) { return conversion.sources[other].object == conversion.sources[id].object; };
  for (std::uint32_t other = id; other > 0 && is_of_it(other - 1); --other) {
    sets.add(other - 1, other);
  }
  for (std::uint32_t other = id + 1; other < conversion.sources.size() && is_of_it(other); ++other) {
    sets.add(other - 1, other);
  }
}

void add_polygons(const Conversion& conversion, const Ids& ids, FaceSets& sets) {
  for (const std::uint32_t id : one_of_each_polygon(conversion, ids)) {
    add_polygon(conversion, id, sets);
  }
}

/// The least-squares plane of all corners, in the direction of `axis`.
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

/// The face with the greatest height: rounding turns its plane least.
const Face& largest_of(const std::vector<Face>& faces) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    largest = faces[i].altitude > faces[largest].altitude ? i : largest;
  }
  return faces[largest];
}

/// Finds the planes of sets, and which faces lie in which plane.
class Planes {
 public:
  explicit Planes(Conversion& conversion) : conversion_(conversion) {}

  /// The number of sets whose corners share a coordinate, which identifies their plane, and of sets that share another plane.
  std::uint32_t level_count() const { return level_count_; }
  std::uint32_t count() const { return count_; }

  /// Gives a set its plane: that of its largest triangle if all lie in it, which keeps axis-aligned planes exact, else the plane
  /// nearest to all. Triangles that lie in neither get planes of their own.
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

  /// Returns the faces that do not lie in the plane.
  Ids lie_in(const Ids& ids, const std::vector<Face>& faces, const FacePlane& plane) {
    Ids members, others;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      (lies_in(faces[i], plane) ? members : others).push_back(ids[i]);
    }
    if (members.size() > 1) {
      conversion_.planes.push_back({plane});
      ++count_;
    }
    for (const std::uint32_t id : members) {
      conversion_.primitives[id].lie_in(members.size() > 1 ? static_cast<std::uint32_t>(conversion_.planes.size()) : 0);
    }
    return others;
  }

  Conversion& conversion_;
  std::uint32_t level_count_ = 0, count_ = 0;
};

/// The order by which triangles that cover each other are visible.
void sort_by_precedence(Ids& set, const Conversion& conversion, std::span<const Material> materials) {
  const auto rank = [&](std::uint32_t id) { return materials[conversion.shading[id].material()].rank_in_plane(); };
  std::stable_sort(set.begin(), set.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
}

/// Adds the emitters that are fully visible in a small set of one plane, which is sorted by precedence.
void add_whole_lamps(const Ids& set, std::span<const Material> materials, Conversion& conversion) {
  constexpr std::size_t lamps_max = 1024;
  const auto lamps_end = std::find_if(
      set.begin(), set.end(), [&](std::uint32_t id) { return materials[conversion.shading[id].material()].rank_in_plane() > 0; });
  const auto count = static_cast<std::size_t>(lamps_end - set.begin());
  std::vector<Face> lamps;
  for (std::size_t i = 0; i < count && count <= lamps_max; ++i) {
    const Face& lamp = lamps.emplace_back(conversion.primitives[set[i]], set[i], conversion.sources[set[i]].object);
    const bool is_covered = std::any_of(lamps.begin(), lamps.end() - 1, [&](const Face& before) {
      return before.object != lamp.object && cover(before, lamp, before.main_axis());
    });
    if (!is_covered) {
      conversion.whole_lamps.push_back({set[i]});
    }
  }
}

/// Removes from a set, sorted by precedence, the faces with the same corners as an earlier one.
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

/// Assigns planes and order to the faces of a conversion that cover each other.
class Settler {
 public:
  Settler(Conversion& conversion, std::span<const Material> materials)
      : conversion_(conversion), materials_(materials), planes_(conversion), from_(conversion.primitives.size()) {
    std::iota(from_.begin(), from_.end(), 0U);
  }

  /// Assigns a plane to a set that lies in one plane both in double and in float.
  void share(Ids set) {
    settle(set);
    add_whole_lamps(set, materials_, conversion_);
    planes_.share(set);
  }
  void stack(FaceStack stack) {
    for (FaceStack::Layer& layer : stack.layers) {
      settle(layer.ids);
      stacked_shared_ += is_shared(layer.ids) ? 1 : 0;
      conversion_.planes.push_back(layer.plane);
      for (const std::uint32_t id : layer.ids) {
        conversion_.primitives[id].lie_in(static_cast<std::uint32_t>(conversion_.planes.size()));
      }
    }
  }
  void finish() {
    std::sort(duplicates_.begin(), duplicates_.end());
    std::erase_if(from_, [&](std::uint32_t id) { return std::binary_search(duplicates_.begin(), duplicates_.end(), id); });
    conversion_.shared_planes += planes_.level_count() + planes_.count() + stacked_shared_;
    conversion_.duplicates += static_cast<std::uint32_t>(duplicates_.size());
    rearrange(conversion_, from_);
  }

 private:
  /// Whether several objects have faces in the layer.
  bool is_shared(const Ids& layer) const {
    const auto object_of = [&](std::uint32_t id) { return conversion_.sources[id].object; };
    return std::any_of(layer.begin(), layer.end(), [&](std::uint32_t id) { return object_of(id) != object_of(layer[0]); });
  }
  /// Sorts the faces of one plane by precedence, and removes duplicates.
  void settle(Ids& set) {
    const Ids places = set;
    sort_by_precedence(set, conversion_, materials_);
    for (std::size_t i = 0; i < set.size(); ++i) {
      from_[places[i]] = set[i];
    }
    take_duplicates(conversion_, set, duplicates_);
  }

  Conversion& conversion_;
  std::span<const Material> materials_;
  Planes planes_;
  Ids from_, duplicates_;
  std::uint32_t stacked_shared_ = 0;
};

/// Whether the corners of all polygons of a set certainly have a coordinate in common in double; needs no triangulation.
bool is_level(const Exactly& exactly, const Ids& whole) {
  const Ids set = one_of_each_polygon(exactly.conversion, whole);
  const auto corners_of = [&](std::uint32_t id) {
    const Object& object = exactly.scene.objects[exactly.conversion.sources[id].object];
    return std::span(exactly.scene.vertices).subspan(object.first, object.vertex_count);
  };
  const auto local = [&](const Vec3d& corner) { return to_local(exactly.frame, corner); };
  const Vec3d first = local(corners_of(set[0])[0]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::all_of(set.begin(), set.end(), [&](std::uint32_t id) {
          const auto corners = corners_of(id);
          return std::all_of(corners.begin(), corners.end(), [&](const Vec3d& at) { return local(at)[axis] == first[axis]; });
        })) {
      return true;
    }
  }
  return false;
}

/// The first triangle of each set that doubles separate; the inseparable ones go to `merged`.
Ids sets_apart(const Exactly& exactly, FaceSets& close, std::vector<CloseFaces>& merged) {
  std::vector<Ids> doubtful = close.sets();
  std::erase_if(doubtful, [&](const Ids& set) { return is_level(exactly, set); });
  const ExactSets exact(exactly, std::move(doubtful));
  Ids apart;
  for (const Ids& set : exact.sets()) {
    if (const auto in_one_plane = merged_in_one_plane(exact.faces_of(set))) {
      merged.insert(merged.end(), in_one_plane->begin(), in_one_plane->end());
    } else {
      apart.push_back(set[0]);
    }
  }
  return apart;
}

/// Joins to the sets of `apart`, whose polygons are present, the faces that their layers reach, transitively.
void add_reached(const Conversion& conversion, const Ids& apart, const Pairs& reached, FaceSets& close) {
  FaceSets wide = close;
  wide.add_all(reached);
  add_polygons(conversion, Ids(wide.ids()), wide);
  std::vector<bool> leads_to_some(conversion.primitives.size());
  for (const std::uint32_t id : apart) {
    leads_to_some[wide.least_with(id)] = true;
  }
  for (const auto& [a, b] : reached) {
    if (leads_to_some[wide.least_with(a)]) {
      close.add(a, b);
    }
  }
}

/// The sets that contain one of `some`.
std::vector<Ids> sets_of(FaceSets& faces, const Ids& some) {
  std::vector<bool> is_wanted(some.empty() ? 0 : *std::max_element(some.begin(), some.end()) + 1);
  for (const std::uint32_t id : some) {
    is_wanted[faces.least_with(id)] = true;
  }
  std::vector<Ids> sets = faces.sets();
  std::erase_if(sets, [&](const Ids& set) { return set[0] >= is_wanted.size() || !is_wanted[set[0]]; });
  return sets;
}

/// The sets that doubles separate, with the faces that their layers reach and the other triangles of their polygons; the
/// inseparable ones go to `merged`.
std::vector<Ids> sets_to_stack(const Exactly& exactly, CoveringSets& found, std::vector<CloseFaces>& merged) {
  const Ids apart = sets_apart(exactly, found.close, merged);
  if (apart.empty()) {
    return {};
  }
  const auto add_whole_polygons = [&] {
    for (const Ids& set : sets_of(found.close, apart)) {
      add_polygons(exactly.conversion, set, found.close);
    }
  };
  add_whole_polygons();
  if (!found.reached.empty()) {
    add_reached(exactly.conversion, apart, found.reached, found.close);
    add_whole_polygons();
  }
  return sets_of(found.close, apart);
}

/// Faces that were not tested may be swapped with others everywhere.
void say_unseen(const Ids& unseen, Conversion& conversion) {
  for (const std::uint32_t id : unseen) {
    const Face face(conversion.primitives[id], id, conversion.sources[id].object);
    conversion.close_faces.push_back({.place = Vec3f(face.middle()), .size = static_cast<float>(face.longest())});
  }
}

/// Returns whether there are any.
bool settle(Conversion& conversion, std::span<const Material> materials, std::vector<Ids> sets, std::vector<FaceStack> stacks) {
  if (sets.empty() && stacks.empty()) {
    return false;
  }
  Settler settler(conversion, materials);
  for (Ids& set : sets) {
    settler.share(std::move(set));
  }
  for (FaceStack& stack : stacks) {
    settler.stack(std::move(stack));
  }
  settler.finish();
  return true;
}

}  // namespace

bool settle_coplanar(Conversion& conversion, const MacroCells& cells, const Scene& scene, const GridFrame& frame,
                     const Parallel& parallel) {
  const Exactly exactly{conversion, scene, frame};
  CoveringSets found = covering_sets(exactly, cells, parallel);
  say_unseen(found.unseen, conversion);
  std::vector<FaceStack> stacks;
  std::vector<bool> is_stacked(conversion.primitives.size());
  StackBudget budget;
  const ExactSets exact(exactly, sets_to_stack(exactly, found, conversion.close_faces));
  for (const Ids& set : exact.sets()) {
    stacks.push_back(stack_faces(exact.faces_of(set), budget));
    const std::vector<CloseFaces>& blurred = stacks.back().blurred;
    conversion.close_faces.insert(conversion.close_faces.end(), blurred.begin(), blurred.end());
    std::for_each(set.begin(), set.end(), [&](std::uint32_t id) { is_stacked[id] = true; });
  }
  std::vector<Ids> sets = found.coplanar.sets();
  std::erase_if(sets, [&](const Ids& set) { return is_stacked[set[0]]; });
  return settle(conversion, scene.materials, std::move(sets), std::move(stacks));
}

}  // namespace dmpc::core
