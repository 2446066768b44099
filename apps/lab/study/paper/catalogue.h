// The runs of the study `paper`, and the purpose of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/lab/study/paper/data.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

/// Number of nodes of the article's cache experiments.
inline constexpr std::uint32_t cache_node_count = 32;
/// Its column in Table 3.
inline constexpr std::size_t cache_column = 5;
/// Sizes of the cache experiments for each scene.
inline constexpr std::size_t cache_size_count = 10;
/// Rows of Tables 2 and 3.
inline constexpr std::size_t rings_row = 2, tetra_row = 3;
/// The row of Tables 2 and 3 whose scene is small compared with a node's memory.
inline constexpr std::size_t small_row = 0;
/// Sides of work items tried on Rings4 and 64 nodes; with the first, 0, every node keeps its submap.
inline constexpr std::array<std::uint32_t, 7> item_sides = {0, 1, 2, 3, 4, 6, 8};
/// Index of the article's compromise.
inline constexpr std::size_t article_item = 3;
/// Scenes on which travelling rays are compared with travelling pages.
inline constexpr std::array<const char*, 2> rings = {"rings-3-t1", "rings-4-t1"};
/// Ways of travelling rays there on 64 nodes.
enum class RayWay : std::uint8_t {
  as_in_1994,   ///< cuts in alternating directions from a subsampled picture, no backpressure
  longer_side,  ///< cuts across the longer side
  equal_size,   ///< regions of equal size
  long_queue    ///< as in 1994, with a queue that fills the node's memory
};
inline constexpr std::array<const char*, 4> ray_way_names = {"as in 1994", "longer-side cuts", "equal sizes", "long queue"};
/// With everything else, this many packets fill nearly all of the article's 4 MB on each of 64 nodes.
inline constexpr std::uint32_t long_queue_packets = 960;
/// Numbers of nodes for which regions of equal size are cut.
inline constexpr std::array<std::uint32_t, 3> loaded_node_counts = {16, 32, 64};
/// The column of the first of them.
inline constexpr std::size_t loaded_column = 4;

/// Pages of a node's shared memory: its own and its cache.
inline constexpr auto shared_pages = static_cast<std::uint32_t>(shared_kilobytes);

/// A scene of the article's Figures 8 to 10.
struct CacheScene {
  std::size_t paper_row = 0;                            ///< index in paper_scenes
  std::array<std::uint32_t, cache_size_count> pages{};  ///< of 1 KB

  constexpr const PaperScene& row() const { return paper_scenes[paper_row]; }
  /// Returns the share of the article's database.
  double share(std::size_t size) const { return pages[size] / static_cast<double>(row().database_kilobytes); }
};
/// Rings4, where the network saturates at 204 pages, and Tetra9: from one page to the article's largest.
inline constexpr std::array<CacheScene, 2> cache_scenes = {
    {{rings_row, {1, 4, 16, 51, 102, 204, 408, 811, 1621, 3242}}, {tetra_row, {1, 4, 16, 51, 102, 204, 408, 724, 1448, 2895}}}};

/// The runs to which the prices of ipsc2-1994 are fitted: the smallest and the largest machine of Mountain and of Rings4.
inline constexpr std::array<PaperPlace, 4> fitted_places = {{{1, 0}, {1, 6}, {2, 1}, {2, 6}}};
/// Those to which the prices of ipsc2 are fitted: Mountain on one node and on two.
inline constexpr std::array<PaperPlace, 2> calibrated_places = {{{1, 0}, {1, 1}}};
inline constexpr const PaperScene& calibration_scene = paper_scenes[calibrated_places[0].scene];

/// Indices of runs, one for each of paper_node_counts.
using RunsByNodeCount = std::array<std::size_t, paper_node_counts.size()>;
/// Indices of runs, one for each of paper_scenes.
using RunsByScene = std::array<std::size_t, paper_scenes.size()>;

/// The runs of Table 3 on one structure.
struct TimedRuns {
  std::array<RunsByNodeCount, paper_scenes.size()> timed{};
  /// One worker on the smallest printed machine, whose other nodes lend their memories; a single node if that is the machine.
  RunsByScene one_worker{};
  std::span<const PaperPlace> fitted;  ///< the cells to which the machine's prices are fitted
};

/// Indices of runs. All but `grid` are on the article's own structure and the machine with its prices, with one pixel in flight
/// and without backpressure.
struct Catalogue {
  std::uint32_t resolution = 0;  ///< pixels a side, except in the cache experiments
  std::vector<PaperRun> runs;
  std::size_t run_count_without_variations = 0;  ///< number of the first runs, on which all tables except the sensitivity are
                                                 ///< based
  RunsByScene counted{};                         ///< Table 2: one node
  RunsByScene extents{};                         ///< the same on a tree of extents
  TimedRuns article{.fitted = fitted_places};    ///< Table 3
  std::array<RunsByNodeCount, rings.size()> rings_by_rays{}, rings_by_pages{};           ///< of `rings`
  std::array<std::array<std::size_t, ray_way_names.size()>, rings.size()> by_ray_way{};  ///< of `rings` on 64 nodes, by RayWay
  std::array<std::size_t, loaded_node_counts.size()> equal_sizes{};                      ///< of rings[0]
  std::array<std::size_t, cache_scenes.size()> cache_base{};                             ///< of `cache_scenes`, on one node
  std::array<std::array<std::size_t, cache_size_count>, cache_scenes.size()> cached{};   ///< of `cache_scenes`, by size
  std::array<std::size_t, item_sides.size()> items{};                                    ///< Rings4 on 64 nodes, by size
  std::size_t assigned_items = 0, assigned_pixels = 0;  ///< the same: nodes request the article's items or pixels from the host
  std::size_t lit_by_rays = 0, lit_by_pages = 0;        ///< Rings4 on 64 nodes, with a light in its middle
  std::size_t copies = 0;                               ///< the small scene on 64 nodes, replicated
  std::size_t faster_machine = 0;                       ///< Rings4 on 32 nodes of an iPSC/860
  TimedRuns grid{.fitted = calibrated_places};          ///< Table 3 on dmpc's grid and the machine ipsc2
  std::size_t dearer_cache = 0;  ///< the last of the grid's fitted runs with a doubled price of a cached look-up

  /// Returns the run of `rings[scene]` on 64 nodes.
  std::size_t by_way(std::size_t scene, RayWay way) const { return by_ray_way[scene][static_cast<std::size_t>(way)]; }

  std::size_t add(PaperRun run) {
    runs.push_back(std::move(run));
    return runs.size() - 1;
  }
};

/// Returns the catalogue for pictures of `resolution` pixels a side.
Catalogue catalogue_of(std::uint32_t resolution);

}  // namespace dmpc::apps
