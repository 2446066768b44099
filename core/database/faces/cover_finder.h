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

/// Disjoint sets of numbers (union-find), each represented by its least member.
class MergedSets {
 public:
  explicit MergedSets(std::size_t count);

  std::uint32_t least_with(std::uint32_t number);
  void merge(std::uint32_t a, std::uint32_t b);

 private:
  std::vector<std::uint32_t> parents_;  ///< none greater than its child
};

/// Finds faces of different objects that lie in one plane, or in two that are near, and cover each other. Tests only faces that
/// share a square of a raster, at most a number in proportion to the faces; beyond that all faces in the plane of the largest, or
/// near to it, are assumed to cover it.
class CoverFinder {
 public:
  /// The faces, of ascending ids, outlive the finder.
  explicit CoverFinder(std::span<const Face> faces) : faces_(faces) {}

  /// Tests some of the faces, ascending, which are visible along `axis`.
  void look_at(std::span<const std::uint32_t> some, std::size_t axis);
  /// Tests all low faces and those that they touch (core/database/faces/meeting_faces.h).
  void look_at_meeting();
  /// Pairs of ids: their connected components are the sets that cover each other in one plane, by the records' values.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& coplanar() const { return coplanar_.pairs; }
  /// Pairs of ids that cover each other in one plane or near to it.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& close() const { return close_.pairs; }
  /// Pairs of ids; together with close() they connect what covers each other within the reach of layers.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& reached() const { return reached_.pairs; }
  /// Ids of faces for which there was no time: others may cover them in their plane, or near to it.
  const std::vector<std::uint32_t>& unseen() const { return unseen_; }

 private:
  /// A face as seen along the axis.
  struct Seen {
    std::array<double, 2> low, high;
    std::uint32_t face, object;
  };
  /// An index into `seen_` that a square holds, and the object of that face.
  struct Entry {
    std::uint32_t square, place, object;
  };
  class Raster;
  /// Pairs found.
  struct Found {
    bool leads(std::uint32_t a, std::uint32_t b) { return !pairs.empty() && sets.least_with(a) == sets.least_with(b); }
    void merge(std::uint32_t a, std::uint32_t b, std::size_t face_count) {
      if (pairs.empty()) {
        sets = MergedSets(face_count);
      }
      sets.merge(a, b);
    }

    MergedSets sets{0};  ///< for all faces, once there are pairs
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
  /// Whether the pairs between faces of one plane already connect them.
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
