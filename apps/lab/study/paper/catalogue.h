// The runs of the study `paper`, and the purpose of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/lab/study/paper/data.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

/// Number of nodes of the article's cache experiments.
inline constexpr std::uint32_t cache_node_count = 32;
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
/// Variants of travelling rays there on 64 nodes, in addition to the default.
enum class RayWay : std::uint8_t {
  standard,       ///< cuts across the longer side from a subsampled picture, backpressure
  alternating,    ///< cuts in alternating directions
  equal_size,     ///< regions of equal size
  unchecked,      ///< without backpressure
  unchecked_long  ///< unchecked, with a queue that fills the node's memory
};
inline constexpr std::array<const char*, 5> ray_way_names = {"longer-side cuts", "alternating cuts", "equal sizes",
                                                             "no backpressure", "no backpressure, long queue"};
/// With everything else, this many packets fill nearly all of the article's 4 MB on each of 64 nodes.
inline constexpr std::uint32_t long_queue_packets = 960;
/// Page sizes tried on Rings4 and 64 nodes; no record crosses a page, so the first is the smallest that holds every record.
inline constexpr std::array<std::uint32_t, 4> page_sizes_bytes = {512, 1024, 2048, 4096};
/// Index of the article's page size.
inline constexpr std::size_t article_page = 1;
/// The column of Table 3 with which the iPSC/860 is compared: 32 nodes.
inline constexpr std::size_t faster_column = 5;
/// Scenes of Table 3 whose efficiencies depend on the size of the memories, since their nodes miss pages that they had before.
/// Teapot and Mountain fit into every memory; Tetra10 does not, but its only printed cell has no efficiency.
inline constexpr std::array<std::size_t, 2> missing_rows = {rings_row, tetra_row};

/// A scene of the cache experiments, with cache sizes from one page to the article's largest.
struct CacheScene {
  std::size_t paper_row = 0;                            ///< index in paper_scenes
  std::array<std::uint32_t, cache_size_count> pages{};  ///< of the article's database

  constexpr const PaperScene& row() const { return paper_scenes[paper_row]; }
  /// Returns the share of the database; pages are of 1 KB.
  double share(std::size_t size) const { return pages[size] / static_cast<double>(row().database_kilobytes); }
  /// Returns a node's shared memory with the largest cache and the node's own pages, in KB.
  constexpr double shared_kilobytes() const {
    return pages.back() + static_cast<double>(row().database_kilobytes) / cache_node_count;
  }
};
/// Rings4, where the network saturates at 204 pages, and Tetra9.
inline constexpr std::array<CacheScene, 2> cache_scenes = {
    {{rings_row, {1, 4, 16, 51, 102, 204, 408, 811, 1621, 3242}}, {tetra_row, {1, 4, 16, 51, 102, 204, 408, 724, 1448, 2895}}}};
static_assert(cache_scenes[0].paper_row == missing_rows[0] && cache_scenes[1].paper_row == missing_rows[1],
              "the scenes whose memories are varied are those of the cache experiments");
/// The scene whose seconds on one node and on two the machine's prices are fitted to: Mountain.
inline constexpr std::size_t calibration_row = 1;
inline constexpr const PaperScene& calibration_scene = paper_scenes[calibration_row];
/// Number of cells of its row in Table 3, from the left, that are fitted.
inline constexpr std::size_t calibration_cell_count = 2;

/// Indices of runs.
struct Catalogue {
  using ByNodeCount = RunsByNodeCount;

  std::uint32_t resolution = 0;  ///< pixels a side, except in the cache experiments
  std::vector<PaperRun> runs;
  std::size_t run_count_without_variations = 0;  ///< number of the first runs, on which all tables except the sensitivity are
                                                 ///< based
  std::array<std::size_t, paper_scenes.size()> counted{};  ///< Table 2
  std::array<ByNodeCount, paper_scenes.size()> timed{};    ///< Table 3
  /// By scene: one worker on the smallest printed machine, whose other nodes lend their memories; a single node if that is the
  /// machine.
  std::array<std::size_t, paper_scenes.size()> one_worker{};
  std::array<ByNodeCount, 2> rings_by_rays{}, rings_by_pages{};       ///< of `rings`
  std::array<ByNodeCount, missing_rows.size()> scattered{};           ///< of `missing_rows`, records without an order in space
  std::array<ByNodeCount, missing_rows.size()> whole_memory{};        ///< of `missing_rows`, memories of the article's 4 MB
  std::array<ByNodeCount, missing_rows.size()> figures_memory{};      ///< of `missing_rows`, memories of the cache experiments
  std::array<std::size_t, 2> cache_base{};                            ///< of `cache_scenes`, on one node
  std::array<std::array<std::size_t, cache_size_count>, 2> cached{};  ///< of `cache_scenes`, by size
  std::array<std::size_t, item_sides.size()> items{};                 ///< Rings4 on 64 nodes, by size
  /// Runs whose nodes request items from the host; nothing for size 0.
  std::array<std::size_t, item_sides.size()> items_assigned{};
  std::array<std::array<std::size_t, ray_way_names.size()>, 2> rings_by_way{};  ///< of `rings` on 64 nodes, by RayWay
  /// Rings4 on 64 nodes, by size: shared memory in software, and in hardware.
  std::array<std::size_t, page_sizes_bytes.size()> paged{}, paged_by_hardware{};
  std::size_t lit_by_rays = 0, lit_by_pages = 0;  ///< Rings4 on 64 nodes, with a light in its middle
  std::size_t copies = 0;                         ///< the small scene on 64 nodes, replicated
  RunsByScene extents{};                          ///< as those of Table 2, on a tree of extents
  std::size_t faster_machine = 0;                 ///< Rings4 on 32 nodes of an iPSC/860
  std::size_t dearer_cache = 0;  ///< the calibration's scene on two nodes, with a doubled price of a cached look-up

  VoxelRuns voxels;  ///< on the article's own structure

  /// Returns the run of `rings[scene]` on 64 nodes.
  std::size_t by_way(std::size_t scene, RayWay way) const { return rings_by_way[scene][static_cast<std::size_t>(way)]; }

  std::size_t add(PaperRun run) {
    runs.push_back(std::move(run));
    return runs.size() - 1;
  }
};

/// Returns the catalogue for pictures of `resolution` pixels a side.
Catalogue catalogue_of(std::uint32_t resolution);

}  // namespace dmpc::apps
