// The layout of a database: how records are found, and where they lie in pages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/record/record.h"

namespace dmpc::core {

enum class Structure : std::uint8_t {
  grid,     ///< macro cells, each with a tree of boxes
  extents,  ///< one macro cell, so one tree of boxes over all; its subtrees, as large as a page holds, lie in one page each
  voxels,   ///< small cells, each with a list of the primitives in it, without boxes
};
inline constexpr std::array<std::string_view, 3> structure_names = {"grid", "extents", "voxels"};

enum class RecordOrder : std::uint8_t {
  spatial,    ///< neighbours in space share pages
  scattered,  ///< records of a page come from anywhere: measures the cost of records without spatial order
};

/// Places for records of these sizes in pages after `front_bytes`, densely, in a pseudo-random order that is always the same;
/// none crosses a page's border. Place i is record i's.
std::vector<Address> scattered_places(std::span<const std::uint16_t> sizes, std::size_t front_bytes, std::size_t page_size);

/// Voxels are cubes; a primitive is here an object of the scene: a polygon, sphere or cone, with a record of its own.
struct VoxelRule {
  /// With twice as many a ray of five families costs 0.72 to 0.91 of the time at the article's prices, with 1.14 to 1.43 times
  /// the memory; with half as many 1.12 to 1.6 times the time, with 0.78 to 0.92 of the memory.
  double voxels_per_primitive = 8;
  std::uint64_t voxels_max = std::uint64_t{1} << 24U;  ///< total: the directory takes 4 B each
  /// Total length of all lists: 4 B per entry, and some 20 while they are built.
  std::uint64_t references_max = std::uint64_t{1} << 28U;
  std::size_t record_bytes = 0;  ///< memory of a primitive in pages, including normals, if that is more than it needs
  /// A primitive is listed in all voxels that its box touches, otherwise in those that it touches itself.
  bool lists_boxes = false;
  /// Lists and primitives lie in spatial (Morton) order, otherwise in the order of the directory and of the file.
  bool follows_space = true;
  /// Empty voxels store the distance to the next occupied one, so that a ray leaves many in one step.
  bool measures_empty_space = true;

  static constexpr std::uint64_t voxels_bound = std::uint64_t{1} << 27U;
  bool operator==(const VoxelRule&) const = default;
};

inline constexpr VoxelRule usual_voxels;
/// The voxels of D. Badouel, K. Bouatouch and T. Priol 1994, as far as their printed numbers of kilobytes and pages show.
inline constexpr VoxelRule article_voxels{.voxels_per_primitive = 14,
                                          .voxels_max = std::uint64_t{64} * 64 * 64,
                                          .record_bytes = 129,
                                          .lists_boxes = true,
                                          .follows_space = false,
                                          .measures_empty_space = false};

}  // namespace dmpc::core
