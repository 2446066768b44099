#include "core/database/face_stack.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace dmpc::core {
namespace {

/// Of one stack at most.
constexpr std::size_t looks_max = std::size_t{1} << 26U, pairs_max = std::size_t{1} << 22U;

/// Lower triangles have no plane that doubles could tell; they keep that of their floats.
constexpr double altitude_least = 0x1p-40;

using Places = std::vector<std::uint32_t>;  ///< of faces

bool is_smaller(const Face& a, const Face& b) { return a.altitude < b.altitude; }

/// The largest face, all that lie in its plane, the largest of the others, and so on.
std::vector<Places> by_plane(std::span<const Face> faces, StackBudget& budget) {
  std::vector<Places> planes;
  Places rest;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (faces[i].altitude > altitude_least) {
      rest.push_back(i);
    }
  }
  for (std::size_t left = std::min(looks_max, budget.planes); !rest.empty() && rest.size() <= left;) {
    left -= rest.size();
    budget.planes -= rest.size();
    const std::uint32_t largest = *std::max_element(
        rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) { return is_smaller(faces[a], faces[b]); });
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

/// Between which heights a face lies above a plane.
std::pair<double, double> heights_above(const FacePlane& plane, const Face& face) {
  const auto height = [&](std::size_t corner) { return plane.height_of(face.corner[corner]); };
  return std::minmax({height(0), height(1), height(2)});
}

/// How a face lies above another one that it covers.
struct Rise {
  double least, most;  ///< negative: below
  double moved;        ///< what rounding does to either

  bool is_above() const { return least >= -moved; }
  bool is_below() const { return most <= moved; }
};

/// By the corners of the smaller one, or, where those lie on both sides, by the other's.
Rise rise_of(const Face& above, const Face& below, const Vec3d& up) {
  const auto [least, most] = heights_above(facing(below.plane, up), above);
  const auto [low, high] = heights_above(facing(above.plane, up), below);
  const double moved = above.moved + below.moved;
  const Rise by_upper{least, most, moved}, by_lower{-high, -low, moved};
  const bool prefers_upper = is_smaller(above, below);
  const Rise &first = prefers_upper ? by_upper : by_lower, &second = prefers_upper ? by_lower : by_upper;
  return first.is_above() || first.is_below() || !(second.is_above() || second.is_below()) ? first : second;
}

CloseFaces close_to(const Face& small, double least, double most) {
  return {Vec3f(small.middle()), static_cast<float>(small.longest()), static_cast<float>(least), static_cast<float>(most)};
}

/// Finds which planes are above which.
class Layers {
 public:
  Layers(std::span<const Face> faces, const std::vector<Places>& planes, const Face& base)
      : faces_(faces), planes_(planes), up_(base.plane.normal), axis_(base.main_axis()), layer_(planes.size()) {}

  void find(StackBudget& budget) {
    const std::size_t most = std::min(pairs_max, budget.pairs);
    left_ = most;
    for (std::uint32_t upper = 1; upper < planes_.size(); ++upper) {
      bool are_all_seen = true;
      for (std::uint32_t lower = 0; lower < upper && are_all_seen; ++lower) {
        are_all_seen = compare(upper, lower);
      }
      if (!are_all_seen) {
        unordered_.push_back(upper);
      }
    }
    budget.pairs -= most - left_;
    for (std::int32_t round = 1; round < plane_layers_max; ++round) {
      for (const Step& step : steps_) {
        layer_[step.upper] = std::max(layer_[step.upper], std::min(layer_[step.lower] + 1, plane_layers_max - 1));
      }
    }
  }
  std::uint8_t kept_as(std::size_t plane) const { return static_cast<std::uint8_t>(BlockHeader::exact_plane + layer_[plane]); }
  const Vec3d& up() const { return up_; }

  /// Of each face the nearest to it in its layer, and all of planes that were not looked at.
  std::vector<CloseFaces> blurred() const {
    std::vector<const Pair*> in_one_layer;
    for (const Pair& pair : pairs_) {
      if (layer_[pair.step.upper] == layer_[pair.step.lower]) {
        in_one_layer.push_back(&pair);
      }
    }
    std::sort(in_one_layer.begin(), in_one_layer.end(),
              [](const Pair* a, const Pair* b) { return std::tie(a->small, a->faces.most) < std::tie(b->small, b->faces.most); });
    std::vector<CloseFaces> result;
    for (std::size_t i = 0; i < in_one_layer.size(); ++i) {
      if (i == 0 || in_one_layer[i]->small != in_one_layer[i - 1]->small) {
        result.push_back(in_one_layer[i]->faces);
      }
    }
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
  struct Pair {
    Step step;
    std::uint32_t small;  ///< the smaller face
    CloseFaces faces;
  };

  /// False if there are too many pairs.
  bool compare(std::uint32_t upper, std::uint32_t lower) {
    if (planes_[upper].size() * planes_[lower].size() > left_) {
      return false;
    }
    left_ -= planes_[upper].size() * planes_[lower].size();
    for (const std::uint32_t a : planes_[upper]) {
      for (const std::uint32_t b : planes_[lower]) {
        if (faces_[a].object != faces_[b].object && cover(faces_[a], faces_[b], axis_)) {
          note({lower, upper}, a, b);
        }
      }
    }
    return true;
  }

  void note(const Step& step, std::uint32_t a, std::uint32_t b) {
    const Face &upper = faces_[a], &lower = faces_[b];
    const Rise rise = rise_of(upper, lower, up_);
    if (rise.is_above()) {
      steps_.push_back(step);
    } else if (rise.is_below()) {
      steps_.push_back({step.upper, step.lower});
    }
    const std::uint32_t small = is_smaller(upper, lower) ? a : b;
    const double low = std::fabs(rise.least), high = std::fabs(rise.most);
    const bool is_cut = !rise.is_above() && !rise.is_below();
    pairs_.push_back({step, small, close_to(faces_[small], is_cut ? 0.0 : std::min(low, high), std::max(low, high))});
  }

  std::span<const Face> faces_;
  const std::vector<Places>& planes_;
  Vec3d up_;
  std::size_t axis_;
  std::vector<std::int32_t> layer_;
  std::vector<Step> steps_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> unordered_;  ///< planes
  std::size_t left_ = 0;                  ///< of the budget
};

/// Level faces of one plane that the file has at different heights, though by less than a ray could tell.
void add_merged(std::span<const Face> faces, const Places& plane, const Face& base, std::vector<CloseFaces>& blurred) {
  const std::size_t axis = base.main_axis();
  for (const std::uint32_t place : plane) {
    const Face& face = faces[place];
    const double apart = std::fabs(face.corner[0][axis] - base.corner[0][axis]);
    if (apart > 0.0 && base.is_level() && face.is_level() && face.main_axis() == axis) {
      blurred.push_back(close_to(face, apart, apart));
    }
  }
}

}  // namespace

FaceStack stack_faces(std::span<const Face> faces, StackBudget& budget) {
  FaceStack stack;
  const std::vector<Places> planes = by_plane(faces, budget);
  const auto largest_of = [&](const Places& places) -> const Face& {
    return faces[*std::max_element(places.begin(), places.end(),
                                   [&](std::uint32_t a, std::uint32_t b) { return is_smaller(faces[a], faces[b]); })];
  };
  if (planes.empty()) {
    return stack;
  }
  Layers layers(faces, planes, largest_of(planes[0]));
  layers.find(budget);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    FaceStack::Layer layer{{facing(largest_of(planes[i]).plane, layers.up()), layers.kept_as(i)}, {}};
    for (const std::uint32_t place : planes[i]) {
      layer.ids.push_back(faces[place].id);
    }
    std::sort(layer.ids.begin(), layer.ids.end());
    stack.layers.push_back(std::move(layer));
  }
  stack.blurred = layers.blurred();
  for (const Places& plane : planes) {
    add_merged(faces, plane, largest_of(plane), stack.blurred);
  }
  return stack;
}

}  // namespace dmpc::core
