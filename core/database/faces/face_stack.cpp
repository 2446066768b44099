#include "core/database/faces/face_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/record/coordinate.h"

namespace dmpc::core {
namespace {

/// Limits for one stack.
constexpr std::size_t looks_max = std::size_t{1} << 26U, pairs_max = std::size_t{1} << 22U;

/// Triangles with less altitude have no plane that doubles could determine; they keep that of their floats.
constexpr double altitude_least = 0x1p-40;

using Places = std::vector<std::uint32_t>;  ///< indices of faces

bool is_smaller(const Face& a, const Face& b) { return a.altitude < b.altitude; }

/// Faces that have a plane.
Places flat_ones(std::span<const Face> faces) {
  Places places;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (faces[i].altitude > altitude_least) {
      places.push_back(i);
    }
  }
  return places;
}

/// The first of the largest faces.
std::uint32_t place_of_largest(std::span<const Face> faces, const Places& places) {
  return *std::max_element(places.begin(), places.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return is_smaller(faces[a], faces[b]); });
}

const Face& largest_of(std::span<const Face> faces, const Places& places) { return faces[place_of_largest(faces, places)]; }

/// Takes the largest face and all that lie in its plane, then the largest of the others, and so on.
std::vector<Places> by_plane(std::span<const Face> faces, StackBudget& budget) {
  std::vector<Places> planes;
  Places rest = flat_ones(faces);
  for (std::size_t left = std::min(looks_max, budget.planes); !rest.empty() && rest.size() <= left;) {
    left -= rest.size();
    budget.planes -= rest.size();
    const std::uint32_t largest = place_of_largest(faces, rest);
    const auto others = std::stable_partition(rest.begin(), rest.end(), [&](std::uint32_t face) {
      return face == largest || are_coplanar(faces[face], faces[largest]);
    });
    planes.emplace_back(rest.begin(), others);
    rest.erase(rest.begin(), others);
  }
  for (const std::uint32_t face : rest) {
    planes.push_back({face});
  }
  return planes;
}

FacePlane facing(const FacePlane& plane, const Vec3d& up) {
  return dot(plane.normal, up) < 0.0 ? FacePlane{-plane.normal, -plane.offset} : plane;
}

/// The least and the greatest height of a face above a plane.
std::pair<double, double> heights_above(const FacePlane& plane, const Face& face) {
  const auto height = [&](std::size_t corner) { return plane.height_of(face.corner[corner]); };
  return std::minmax({height(0), height(1), height(2)});
}

/// The height of a face above another one that it covers.
struct Rise {
  double least, most;  ///< negative: below
  double moved;        ///< displacement of either by rounding

  bool is_above() const { return least >= -moved; }
  bool is_below() const { return most <= moved; }
};

/// Measured at the corners of the smaller face or, if those lie on both sides, at the other's.
Rise rise_of(const Face& above, const Face& below, const Vec3d& up) {
  const auto [least, most] = heights_above(facing(below.plane, up), above);
  const auto [low, high] = heights_above(facing(above.plane, up), below);
  const double moved = above.moved + below.moved;
  const Rise by_upper{least, most, moved}, by_lower{-high, -low, moved};
  const bool prefers_upper = is_smaller(above, below);
  const Rise &first = prefers_upper ? by_upper : by_lower, &second = prefers_upper ? by_lower : by_upper;
  return first.is_above() || first.is_below() || !(second.is_above() || second.is_below()) ? first : second;
}

/// Whether the faces may be adjacent layers; faces at a larger angle intersect in a line.
bool lie_on_each_other(const Face& a, const Face& b) {
  const Rise rise = rise_of(a, b, b.plane.normal);
  return std::fabs(dot(a.plane.normal, b.plane.normal)) > 0.5 && rise.least <= layers_reach && rise.most >= -layers_reach;
}

CloseFaces close_to(const Face& small, double least, double most, std::uint32_t layers = 0) {
  return {Vec3f(small.middle()), static_cast<float>(small.longest()), static_cast<float>(least), static_cast<float>(most),
          layers};
}

/// Rays that start on a face in an exact plane may miss faces up to this distance (core/picture/hits/triangle_hit.h).
double passed_by_starts(const Face& face) {
  double largest = 0;
  for (const Vec3d& corner : face.corner) {
    largest = std::max(largest, dot_of_magnitudes(face.plane.normal, corner));
  }
  return (exact_clearance + start_rounding) * largest + coordinate_step;
}

/// Finds which planes are above which. Each plane is turned like its neighbours, so a set may go round a barrel.
class Layers {
 public:
  Layers(std::span<const Face> faces, const std::vector<Places>& planes) : faces_(faces), planes_(planes), layer_(planes.size()) {
    for (const Places& plane : planes) {
      up_.push_back(largest_of(faces, plane).plane.normal);
    }
  }

  void find(StackBudget& budget) {
    find_pairs(budget);
    turn_to_one_side();
    std::vector<Step> steps;
    for (Pair& pair : pairs_) {
      judge(pair, steps);
    }
    for (std::int32_t round = 1; round < plane_layers_max; ++round) {
      for (const Step& step : steps) {
        layer_[step.upper] = std::max(layer_[step.upper], std::min(layer_[step.lower] + 1, plane_layers_max - 1));
      }
    }
  }
  PrimitivePlane plane(std::size_t plane) const {
    return {facing(largest_of(faces_, planes_[plane]).plane, up_[plane]),
            static_cast<std::uint8_t>(LeafHeader::exact_plane + layer_[plane])};
  }

  /// For each face, the first one that it is swapped with, and the share on which rays that start there miss it; all faces of
  /// planes that were not tested.
  std::vector<CloseFaces> blurred() const {
    std::vector<Blurred> swapped, passed;
    for (const Pair& pair : pairs_) {
      const auto layers = static_cast<std::uint32_t>(std::abs(layer_[pair.lower] - layer_[pair.upper]));
      const std::uint32_t small = small_face(pair);
      if (layers == 0 || !pair.is_ordered) {
        const double reach = double{pair.most} / (layers + 1.0);
        swapped.push_back({small, reach, close_to(faces_[small], double{pair.least}, double{pair.most}, layers)});
      } else if (const double share = passed_share(faces_[small], pair); share > 0) {
        passed.push_back({small, -share, close_to(faces_[small], 0.0, 0.0)});
        passed.back().faces.size *= static_cast<float>(share);
      }
    }
    std::vector<CloseFaces> result;
    add_first_of_each(std::move(swapped), result);
    add_first_of_each(std::move(passed), result);
    for (const std::uint32_t plane : unordered_) {
      for (const std::uint32_t face : planes_[plane]) {
        result.push_back(close_to(faces_[face], 0.0, 0.0));
      }
    }
    return result;
  }

 private:
  struct Step {
    std::uint32_t lower, upper;  ///< planes
  };
  /// Two faces that cover each other, and their planes.
  struct Pair {
    std::uint32_t lower, upper;            ///< planes, in any order
    std::uint32_t lower_face, upper_face;  ///< one face of each
    float least = 0, most = 0;             ///< how far apart
    bool is_ordered = false;               ///< whether one is in front of the other everywhere
  };
  struct Blurred {
    std::uint32_t face;
    double order;  ///< order within the face's pairs
    CloseFaces faces;
  };
  static void add_first_of_each(std::vector<Blurred> blurred, std::vector<CloseFaces>& result) {
    std::sort(blurred.begin(), blurred.end(),
              [](const Blurred& a, const Blurred& b) { return std::pair(a.face, a.order) < std::pair(b.face, b.order); });
    for (std::size_t i = 0; i < blurred.size(); ++i) {
      if (i == 0 || blurred[i].face != blurred[i - 1].face) {
        result.push_back(blurred[i].faces);
      }
    }
  }

  /// The smaller of the two faces.
  std::uint32_t small_face(const Pair& pair) const {
    return is_smaller(faces_[pair.upper_face], faces_[pair.lower_face]) ? pair.upper_face : pair.lower_face;
  }

  /// The share of a face on which rays that start on it, or on the other face, miss the other one.
  static double passed_share(const Face& small, const Pair& pair) {
    const double least{pair.least}, most{pair.most}, passed = passed_by_starts(small);
    return passed >= most ? 1.0 : passed > least ? (passed - least) / (most - least) : 0.0;
  }

  void find_pairs(StackBudget& budget) {
    const std::size_t most = std::min(pairs_max, budget.pairs);
    std::size_t left = most;
    for (std::uint32_t upper = 1; upper < planes_.size(); ++upper) {
      bool are_all_seen = true;
      for (std::uint32_t lower = 0; lower < upper && are_all_seen; ++lower) {
        are_all_seen = compare(upper, lower, left);
      }
      if (!are_all_seen) {
        unordered_.push_back(upper);
      }
    }
    budget.pairs -= most - left;
  }

  /// False if there are too many pairs.
  bool compare(std::uint32_t upper, std::uint32_t lower, std::size_t& left) {
    const std::size_t pairs = planes_[upper].size() * planes_[lower].size();
    if (pairs > left) {
      return false;
    }
    left -= pairs;
    for (const std::uint32_t a : planes_[upper]) {
      for (const std::uint32_t b : planes_[lower]) {
        const Face &one = faces_[a], &other = faces_[b];
        const std::size_t axis = (is_smaller(one, other) ? other : one).main_axis();
        if (one.object != other.object && cover(one, other, axis) && lie_on_each_other(one, other)) {
          pairs_.push_back({.lower = lower, .upper = upper, .lower_face = b, .upper_face = a});
        }
      }
    }
    return true;
  }

  /// Turns planes from the first one on to those that cover it, and so on; planes that are not connected to it face as it does.
  void turn_to_one_side() {
    std::vector<Places> beside(planes_.size());
    for (const Pair& pair : pairs_) {
      beside[pair.lower].push_back(pair.upper);
      beside[pair.upper].push_back(pair.lower);
    }
    std::vector<bool> is_turned(planes_.size());
    for (std::uint32_t first = 0; first < planes_.size(); ++first) {
      Places turned;
      const auto turn = [&](std::uint32_t plane, const Vec3d& way) {
        if (!is_turned[plane]) {
          is_turned[plane] = true;
          up_[plane] = dot(up_[plane], way) < 0.0 ? -up_[plane] : up_[plane];
          turned.push_back(plane);
        }
      };
      turn(first, up_[0]);
      for (std::size_t next = 0; next < turned.size(); ++next) {
        const std::uint32_t from = turned[next];
        std::for_each(beside[from].begin(), beside[from].end(), [&](std::uint32_t plane) { turn(plane, up_[from]); });
      }
    }
  }

  /// In a set that goes round a twisted strip, two planes face each other however they are turned.
  void judge(Pair& pair, std::vector<Step>& steps) const {
    const Face &upper = faces_[pair.upper_face], &lower = faces_[pair.lower_face];
    const Rise rise = rise_of(upper, lower, up_[pair.lower]);
    const bool is_one_way = dot(up_[pair.lower], up_[pair.upper]) > 0.0;
    pair.is_ordered = is_one_way && (rise.is_above() || rise.is_below());
    if (pair.is_ordered) {
      steps.push_back(rise.is_above() ? Step{pair.lower, pair.upper} : Step{pair.upper, pair.lower});
    }
    const double low = std::fabs(rise.least), high = std::fabs(rise.most);
    pair.least = rise.is_above() || rise.is_below() ? static_cast<float>(std::min(low, high)) : 0.0F;
    pair.most = static_cast<float>(std::max(low, high));
  }

  std::span<const Face> faces_;
  const std::vector<Places>& planes_;
  std::vector<Vec3d> up_;  ///< by plane: the side that it faces
  std::vector<std::int32_t> layer_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> unordered_;  ///< planes
};

/// Level faces at different heights in the file lie in two planes. Others do if their distance is more than the rounding by the
/// program that wrote the file and by dmpc: this share of what a program may round that transforms objects repeatedly. Of 15,700
/// pairs that were rotated twice and translated, none came to more than a tenth.
constexpr double merged_share = 0.125;

bool are_two_planes(const Face& face, const Face& base) {
  const std::size_t axis = base.main_axis();
  return base.is_level() && face.is_level() && face.main_axis() == axis
             ? face.corner[0][axis] != base.corner[0][axis]
             : face.is_by_doubles && base.is_by_doubles && roundings_apart(face, base) > merged_share;
}

/// Adds faces that lie in two planes in the file, though nearer to each other than a ray can resolve.
void add_merged(std::span<const Face> faces, const Places& plane, const Face& base, std::vector<CloseFaces>& blurred) {
  for (const std::uint32_t place : plane) {
    if (are_two_planes(faces[place], base)) {
      const auto [least, most] = heights_above(base.plane, faces[place]);
      const double apart = std::max(std::fabs(least), std::fabs(most));
      blurred.push_back(close_to(faces[place], apart, apart));
    }
  }
}

}  // namespace

std::optional<std::vector<CloseFaces>> merged_in_one_plane(std::span<const Face> faces) {
  const Places places = flat_ones(faces);
  std::vector<CloseFaces> merged;
  if (!places.empty()) {
    const Face& largest = largest_of(faces, places);
    const auto is_in_it = [&](std::uint32_t place) { return &faces[place] == &largest || are_coplanar(faces[place], largest); };
    if (!std::all_of(places.begin(), places.end(), is_in_it)) {
      return std::nullopt;
    }
    add_merged(faces, places, largest, merged);
  }
  return merged;
}

FaceStack stack_faces(std::span<const Face> faces, StackBudget& budget) {
  FaceStack stack;
  const std::vector<Places> planes = by_plane(faces, budget);
  if (planes.empty()) {
    return stack;
  }
  Layers layers(faces, planes);
  layers.find(budget);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    FaceStack::Layer layer{layers.plane(i), {}};
    for (const std::uint32_t place : planes[i]) {
      layer.ids.push_back(faces[place].id);
    }
    std::sort(layer.ids.begin(), layer.ids.end());
    stack.layers.push_back(std::move(layer));
  }
  stack.blurred = layers.blurred();
  for (const Places& plane : planes) {
    add_merged(faces, plane, largest_of(faces, plane), stack.blurred);
  }
  return stack;
}

}  // namespace dmpc::core
