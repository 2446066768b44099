// The tables of the study `paper`: what the article prints beside what our runs came to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/price_fit.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

/// In percent: how well `node_count` nodes are used, against `base_count`.
constexpr double efficiency(double base_seconds, std::uint32_t base_count, double seconds, std::uint32_t node_count) {
  return 100 * base_seconds * base_count / (seconds * node_count);
}

/// The efficiency that is printed in a scene's row of Table 3, against the row's first time. Requires a column with a time.
inline double printed_efficiency(const PaperScene& scene, std::size_t column) {
  const std::size_t base = scene.base();
  return efficiency(scene.seconds[base], paper_node_counts[base], scene.seconds[column], paper_node_counts[column]);
}
/// The efficiency of a row of runs, against the one at `base`; nothing if either has no result.
std::optional<double> found_efficiency(const Catalogue::ByNodeCount& runs, const PaperResults& results, std::size_t base,
                                       std::size_t column);

/// What Table 3 says of one scene on so many nodes, printed and found; nothing if it is not printed or not known.
struct CellOfTable3 {
  std::size_t scene = 0;  ///< of paper_scenes
  const char* title = "";
  std::uint32_t nodes = 0;
  double printed_seconds = 0, seconds = 0, printed_efficiency = 0, efficiency = 0;
  std::optional<double> one_worker_seconds;  ///< on the scene's smallest machine
  bool is_calibrated = false;                ///< the machine's prices were fitted to it
  bool is_base = false;
  TimeParts parts;

  /// Neither calibrated nor 100 % by definition.
  bool is_predicted() const { return !is_calibrated && !is_base; }
  /// In percent, against one worker.
  std::optional<double> efficiency_by_worker() const {
    return one_worker_seconds ? std::optional(apps::efficiency(*one_worker_seconds, 1, seconds, nodes)) : std::nullopt;
  }
};
/// How many are printed.
std::size_t printed_cell_count();

/// How far predictions lie from what is printed, in points.
struct Differences {
  double sum = 0, worst = 0;
  std::uint32_t count = 0;

  void add(double difference) {
    const double size = difference < 0 ? -difference : difference;
    sum += size;
    worst = std::max(worst, size);
    ++count;
  }
  double mean() const { return count == 0 ? 0 : sum / count; }
};

/// All that are printed and whose runs have ended, scene by scene.
std::vector<CellOfTable3> cells_of_table_3(const Catalogue& catalogue, const PaperResults& results);

/// Says in a note how many of its `expected` rows are missing, if any: their runs were interrupted, or an error ended the study.
void note_missing_rows(Table& table, std::size_t expected);

/// Each has the rows whose runs have ended, and says how many are missing.
Table table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects);
Table table_3(const Catalogue& catalogue, const PaperResults& results);
/// Where the time of the nodes of Table 3 goes.
Table losses(const Catalogue& catalogue, const PaperResults& results);
/// Figures 5 and 7: rays that travel beside pages that travel.
Table algorithms(const Catalogue& catalogue, const PaperResults& results);
/// What the ways for rays to travel are worth on 64 nodes.
Table ray_ways(const Catalogue& catalogue, const PaperResults& results);
/// "3x3", or "static" of 0.
std::string item_text(std::uint32_t side);
/// What the size of a work item is worth.
Table work_items(const Catalogue& catalogue, const PaperResults& results);
/// What the size of a page is worth where software looks pages up, and where hardware does.
Table page_sizes(const Catalogue& catalogue, const PaperResults& results);
/// Figures 8 to 10: what the size of the cache is worth.
Table caches(const Catalogue& catalogue, const PaperResults& results);

/// Efficiencies of the scenes that miss pages: with caches of the article's share of the database, as in Table 3, the same with
/// records without an order in space, with the share that the article's Figures 8 to 10 speak for, and with memories of its 4 MB;
/// each beside what is printed.
Table memories(const Catalogue& catalogue, const PaperResults& results);
/// A row a claim of the article's text whose runs have ended: the claim, "held" or "not held", and what was found. Of pictures
/// that are not of the article's resolution none is judged.
Table claims(const Catalogue& catalogue, const PaperResults& results);

/// A cell of Table 3 whose run on voxels has ended.
struct VoxelCell {
  PaperPlace place;
  double printed_seconds = 0, seconds = 0;
  PricedCell ray;           ///< node-milliseconds of a ray, by prices; printed over the rays that are printed
  double milliseconds = 0;  ///< node-milliseconds of a ray, found
  double printed_efficiency = 0;
  std::optional<double> efficiency;  ///< nothing if the scene's smallest machine has no time
  std::optional<double> one_worker_seconds;

  const PaperScene& scene() const { return paper_scenes[place.scene]; }
  std::uint32_t nodes() const { return paper_node_counts[place.column]; }
  bool is_base() const { return place.column == scene().base(); }
  bool is_fitted() const;
  /// Found over printed. Per ray since ours are not quite as many as the article's (Table 2), and prices are those of a ray.
  double ratio() const { return milliseconds / ray.printed; }
};
/// Scene by scene.
std::vector<VoxelCell> voxel_cells(const Catalogue& catalogue, const PaperResults& results);

/// Kilobytes and pages a pixel beside what is printed.
Table voxel_table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects);
/// Seconds and efficiencies beside what is printed.
Table voxel_table_3(const Catalogue& catalogue, const PaperResults& results);
/// The machine's prices beside those that its four cells ask for.
Table voxel_prices(const Catalogue& catalogue, const PaperResults& results);
/// What prices fitted to any two scenes, smallest and largest machine, say of all: a row a pair.
Table voxel_pairs(const Catalogue& catalogue, const PaperResults& results);
/// Figures 8 to 10: what the size of the cache, in the article's pages, is worth on 32 nodes.
Table voxel_caches(const Catalogue& catalogue, const PaperResults& results);
/// How evenly regions of Rings3 are loaded.
Table voxel_loads(const Catalogue& catalogue, const PaperResults& results);
/// Claims of the article's text that a structure decides, as claims() has them of dmpc's grid.
Table voxel_claims(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
