// Which of the study's runs are on the article's own structure, a plain grid of voxels (core::article_voxels), with its bytes: 4
// MB a node, of which 3.2 MB serve the shared memory, in pages of 1 KB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "apps/lab/study/paper/data.h"

namespace dmpc::apps {

struct Catalogue;

/// Numbers of runs, one for each of paper_node_counts.
using RunsByNodeCount = std::array<std::size_t, paper_node_counts.size()>;

/// Pages of a node's shared memory: its own and its cache.
inline constexpr auto shared_pages = static_cast<std::uint32_t>(shared_kilobytes);

/// Numbers of runs, one for each of paper_scenes.
using RunsByScene = std::array<std::size_t, paper_scenes.size()>;

/// Those that the prices of voxel_machine() are fitted to: the smallest and the largest machine of Mountain and of Rings4.
inline constexpr std::array<PaperPlace, 4> fitted_places = {{{1, 0}, {1, 6}, {2, 1}, {2, 6}}};

/// A scene of the article's Figures 8 to 10, on 32 nodes.
struct VoxelCaches {
  std::size_t scene = 0;                 ///< of paper_scenes
  std::array<std::uint32_t, 6> pages{};  ///< of 1 KB
};
/// Of the sizes of cache_scenes those that a picture takes no minutes with: with smaller ones most look-ups of another page miss.
inline constexpr std::array<VoxelCaches, 2> voxel_caches_tried = {
    {{2, {102, 204, 408, 811, 1621, 3242}}, {3, {51, 102, 204, 408, 1448, 2895}}}};

/// Nodes that regions of Rings3 are cut for.
inline constexpr std::array<std::uint32_t, 3> loaded_node_counts = {16, 32, 64};

/// Numbers of runs, by scene.
struct VoxelRuns {
  RunsByScene counted{};                                                       ///< Table 2
  RunsByScene extents{};                                                       ///< the same on a tree of extents
  std::array<RunsByNodeCount, paper_scenes.size()> timed{};                    ///< Table 3
  RunsByScene one_worker{};                                                    ///< on the smallest machine that is printed
  std::array<std::array<std::size_t, 6>, voxel_caches_tried.size()> cached{};  ///< by size; on one node: those that are counted
  /// Rays that travel, Rings3, by loaded_node_counts: regions by a subsampled picture, cut in alternating directions, and of
  /// equal size; and one node.
  std::array<std::size_t, loaded_node_counts.size()> subsampled{}, equal_size{};
  std::size_t one_region = 0;
};

/// Adds them.
void add_voxel_runs(Catalogue& catalogue);

}  // namespace dmpc::apps
