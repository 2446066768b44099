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

/// Those that the prices of voxel_machine() are fitted to: the smallest and the largest machine of Mountain and of Rings4.
inline constexpr std::array<PaperPlace, 4> fitted_places = {{{1, 0}, {1, 6}, {2, 1}, {2, 6}}};

/// Numbers of runs, by scene.
struct VoxelRuns {
  std::array<std::size_t, paper_scenes.size()> counted{};     ///< Table 2
  std::array<RunsByNodeCount, paper_scenes.size()> timed{};   ///< Table 3
  std::array<std::size_t, paper_scenes.size()> one_worker{};  ///< on the smallest machine that is printed
};

/// Adds them.
void add_voxel_runs(Catalogue& catalogue);

}  // namespace dmpc::apps
