// Which triangles of a bucket cover each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/build/database.h"
#include "core/build/face.h"

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

/// Merges triangles of different objects that lie in one plane and cover each other. Looks at those alone that share a square of a raster, as many as
/// a number in proportion to the triangles allows; beyond that it merges all that lie in the plane of the largest.
class CoverFinder {
 public:
  /// All outlive the finder.
  CoverFinder(std::span<const PrimitiveValues> primitives, std::span<const PrimitiveSource> sources, MergedSets& sets)
      : primitives_(primitives), sources_(sources), sets_(sets) {}

  /// `ids`: of triangles that can be looked at along `axis`.
  void merge(std::span<const std::uint32_t> ids, std::size_t axis);

 private:
  struct Raster;
  /// A place in `faces_` that a square holds.
  struct Entry {
    std::uint32_t square, place;
  };

  bool merge_pairs(std::span<const std::uint32_t> ids, std::size_t axis);
  bool merge_pairs_in_square(std::span<const std::uint32_t> ids, std::size_t axis, std::span<const Entry> square);
  void list_squares(std::size_t axis);
  bool list_squares(const Raster& raster);
  void merge_planes(std::span<const std::uint32_t> ids);

  std::span<const PrimitiveValues> primitives_;
  std::span<const PrimitiveSource> sources_;
  MergedSets& sets_;
  std::vector<Face> faces_;
  std::vector<Entry> entries_;
  std::size_t pairs_left_ = 0;
};

}  // namespace dmpc::core
