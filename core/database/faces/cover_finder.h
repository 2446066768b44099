// Which triangles of a bucket cover each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/database/faces/face.h"

namespace dmpc::core {

/// Sets of numbers that grow together. Their least stands for each.
class MergedSets {
 public:
  explicit MergedSets(std::size_t count);

  std::uint32_t least_with(std::uint32_t number);
  void merge(std::uint32_t a, std::uint32_t b);

 private:
  std::vector<std::uint32_t> parents_;  ///< none above its child
};

/// Finds faces of different objects that lie in one plane, or in two that are near, and cover each other. Looks at those alone
/// that share a square of a raster, as many as a number in proportion to the faces allows; beyond that it takes all that lie in
/// the plane of the largest, or near to it, for covering it.
class CoverFinder {
 public:
  /// The faces, of ascending ids, outlive the finder.
  explicit CoverFinder(std::span<const Face> faces) : faces_(faces) {}

  /// Looks at some of the faces, ascending, which can be looked at along `axis`.
  void look_at(std::span<const std::uint32_t> some, std::size_t axis);
  /// Looks at all low faces and at what those touch (core/database/faces/meeting_faces.h).
  void look_at_meeting();
  /// Pairs of ids: what they lead from one to the other is all that covers each other in one plane, by what records say.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& coplanar() const { return coplanar_.pairs; }
  /// The same of all that covers each other in one plane or near to it.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& close() const { return close_.pairs; }
  /// What these and close() lead from one to the other is all that covers each other where layers may reach, too.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& reached() const { return reached_.pairs; }
  /// Ids of faces for which there was no time: others may cover them in their plane, or near to it.
  const std::vector<std::uint32_t>& unseen() const { return unseen_; }

 private:
  /// A face as seen along the axis.
  struct Seen {
    std::array<double, 2> low, high;
    std::uint32_t face, object;
  };
  /// A place in `seen_` that a square holds, and whose face that is.
  struct Entry {
    std::uint32_t square, place, object;
  };
  class Raster;
  /// What is found.
  struct Found {
    bool leads(std::uint32_t a, std::uint32_t b) { return !pairs.empty() && sets.least_with(a) == sets.least_with(b); }
    void merge(std::uint32_t a, std::uint32_t b, std::size_t face_count) {
      if (pairs.empty()) {
        sets = MergedSets(face_count);
      }
      sets.merge(a, b);
    }

    MergedSets sets{0};  ///< of all faces, once there are pairs
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  };

  void see(std::span<const std::uint32_t> some, std::size_t axis);
  void list_squares();
  bool list_squares(const Raster& raster);
  void sort_by_square(std::size_t square_count);
  bool look_at_pairs(std::size_t axis);
  bool look_at_square(std::size_t axis, std::span<const Entry> square);
  std::span<const Entry> without_twins(std::size_t axis, std::span<const Entry> square);
  void look_at_planes(std::span<const std::uint32_t> some);
  /// Whether they lead to each other by all that faces of one plane do.
  bool judge(std::uint32_t a, std::uint32_t b, std::size_t axis);
  void merge(std::uint32_t a, std::uint32_t b, bool are_coplanar);
  void merge_in(Found& found, std::uint32_t a, std::uint32_t b);

  std::span<const Face> faces_;
  Found coplanar_, close_, reached_;
  std::vector<std::uint32_t> unseen_;
  std::vector<Seen> seen_;
  std::vector<Entry> entries_, sorted_, distinct_;
  std::vector<std::uint32_t> next_;  ///< by square: where its next entry goes
  std::size_t pairs_left_ = 0;
};

}  // namespace dmpc::core
