#include "core/database/faces/meeting_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/box.h"

namespace dmpc::core {
namespace {

/// Box tests for each face.
constexpr std::size_t looks_per_face = 4096;

/// The minimum cosine between planes that lean towards each other. Steeper planes intersect in a line that rounding moves by at
/// most four times as much as a corner, which primitives account for (core/picture/film/rounding_loss.h).
constexpr double leaning_cosine = 0.97;

bool is_low(const Face& face) { return face.altitude < low_altitude; }

/// The boxes of faces, sorted by their begin along an axis, as arrays, so that many are tested against one at once.
class Boxes {
 public:
  Boxes(std::span<const Face> all, std::vector<std::uint32_t> some, std::size_t axis)
      : axis_(axis), other_((axis + 1) % 3), last_((axis + 2) % 3) {
    std::vector<Box> boxes(all.size());
    for (const std::uint32_t face : some) {
      boxes[face] = box_of(all[face]);
    }
    std::sort(some.begin(), some.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(boxes[a].low[axis], a) < std::pair(boxes[b].low[axis], b);
    });
    for (const std::uint32_t face : some) {
      for (std::size_t i = 0; i < 3; ++i) {
        low_[i].push_back(static_cast<float>(boxes[face].low[i]));
        high_[i].push_back(static_cast<float>(boxes[face].high[i]));
      }
    }
    faces_ = std::move(some);
  }

  std::size_t size() const { return faces_.size(); }
  std::uint32_t face(std::size_t place) const { return faces_[place]; }
  /// The first box that begins at or after box `place` of `others`.
  std::size_t first_from(const Boxes& others, std::size_t place) const {
    const std::vector<float>& begins = low_[axis_];
    return static_cast<std::size_t>(std::lower_bound(begins.begin(), begins.end(), others.low_[axis_][place]) - begins.begin());
  }
  /// The first box that begins after box `place` of `others` has ended.
  std::size_t end_of(const Boxes& others, std::size_t place) const {
    const std::vector<float>& begins = low_[axis_];
    return static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), others.high_[axis_][place]) - begins.begin());
  }

  /// Passes to `met` those of [first, end), which meet box `place` of `others` along the axis, that meet it along both others.
  template <class Met>
  void for_each_that_meets(const Boxes& others, std::size_t place, std::size_t first, std::size_t end, const Met& met) const {
    constexpr std::size_t at_once = 64;
    std::array<std::uint32_t, at_once> meets{};
    for (; first < end; first += at_once) {
      const std::size_t count = std::min(at_once, end - first);
      std::uint32_t any = 0;
      const float low = others.low_[other_][place], high = others.high_[other_][place];
      const float low_last = others.low_[last_][place], high_last = others.high_[last_][place];
      const float *const lows = &low_[other_][first], *const highs = &high_[other_][first];
      const float *const last_lows = &low_[last_][first], *const last_highs = &high_[last_][first];
      for (std::size_t i = 0; i < count; ++i) {
        meets[i] = std::uint32_t{lows[i] <= high} & std::uint32_t{highs[i] >= low} & std::uint32_t{last_lows[i] <= high_last} &
                   std::uint32_t{last_highs[i] >= low_last};
        any |= meets[i];
      }
      for (std::size_t i = 0; i < count && any != 0; ++i) {
        if (meets[i] != 0) {
          met(faces_[first + i]);
        }
      }
    }
  }

 private:
  /// The face's box, padded by more than the distance of near faces and the rounding of floats.
  static Box box_of(const Face& face) {
    Box box;
    for (const Vec3d& corner : face.corner) {
      box.include(corner);
    }
    const double margin = near_roundings * face.moved + layers_reach_of(face.longest()) + 0x1p-23;
    return box.padded({margin, margin, margin});
  }

  std::size_t axis_, other_, last_;
  std::array<std::vector<float>, 3> low_, high_;
  std::vector<std::uint32_t> faces_;
};

std::size_t longest_axis_of(std::span<const Face> faces) {
  Box all;
  for (const Face& face : faces) {
    all.include(face.corner[0]);
  }
  const Vec3d half = all.half();
  return half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
}

/// If two faces meet, the one that begins first tests the other one.
class Meetings {
 public:
  using Judge = std::function<void(std::uint32_t, std::uint32_t)>;

  Meetings(std::span<const Face> faces, std::vector<std::uint32_t> low, std::vector<std::uint32_t> others, const Judge& judge)
      : Meetings(faces, std::move(low), std::move(others), longest_axis_of(faces), judge) {}

  bool find() {
    for (std::size_t place = 0; place < low_.size(); ++place) {
      if (!look(low_, place, low_, place + 1) || !look(low_, place, others_, others_.first_from(low_, place))) {
        return false;
      }
    }
    for (std::size_t place = 0; place < others_.size(); ++place) {
      if (!look(others_, place, low_, low_.first_from(others_, place))) {
        return false;
      }
    }
    return true;
  }

 private:
  Meetings(std::span<const Face> faces, std::vector<std::uint32_t> low, std::vector<std::uint32_t> others, std::size_t axis,
           const Judge& judge)
      : faces_(faces),
        judge_(judge),
        low_(faces, std::move(low), axis),
        others_(faces, std::move(others), axis),
        left_(looks_per_face * faces.size()) {}

  /// Tests a face of `from` against those of `at` that begin before it ends. False if there are too many.
  bool look(const Boxes& from, std::size_t place, const Boxes& at, std::size_t first) {
    const std::size_t end = std::max(at.end_of(from, place), first);
    if (end - first > left_) {
      return false;
    }
    left_ -= end - first;
    const Face& one = faces_[from.face(place)];
    at.for_each_that_meets(from, place, first, end, [&](std::uint32_t index) {
      const Face& other = faces_[index];
      if (one.object != other.object && std::fabs(dot(one.plane.normal, other.plane.normal)) > leaning_cosine) {
        judge_(from.face(place), index);
      }
    });
    return true;
  }

  std::span<const Face> faces_;
  const Judge& judge_;
  Boxes low_, others_;
  std::size_t left_;
};

}  // namespace

bool find_meeting_faces(std::span<const Face> faces, const std::function<void(std::uint32_t, std::uint32_t)>& judge) {
  std::vector<std::uint32_t> low, others;
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    (is_low(faces[face]) ? low : others).push_back(face);
  }
  return low.empty() || Meetings(faces, std::move(low), std::move(others), judge).find();
}

}  // namespace dmpc::core
