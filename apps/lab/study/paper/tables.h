// The tables of the study `paper`: the article's printed values beside our results.
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

/// Returns the efficiency of `node_count` nodes in percent, against `base_count`.
constexpr double efficiency(double base_seconds, std::uint32_t base_count, double seconds, std::uint32_t node_count) {
  return 100 * base_seconds * base_count / (seconds * node_count);
}

/// Returns the printed efficiency in a scene's row of Table 3, against the row's first time. Requires a column with a time.
inline double printed_efficiency(const PaperScene& scene, std::size_t column) {
  const std::size_t base = scene.base();
  return efficiency(scene.seconds[base], paper_node_counts[base], scene.seconds[column], paper_node_counts[column]);
}
/// Returns the efficiency of a row of runs, against the one at `base`; nothing if either has no result.
std::optional<double> found_efficiency(const Catalogue::ByNodeCount& runs, const PaperResults& results, std::size_t base,
                                       std::size_t column);

/// A cell of Table 3, printed and found; either is nothing if it is not printed or not known.
struct CellOfTable3 {
  std::size_t scene = 0;  ///< index in paper_scenes
  const char* title = "";
  std::uint32_t nodes = 0;
  double printed_seconds = 0, seconds = 0, printed_efficiency = 0, efficiency = 0;
  std::optional<double> one_worker_seconds;  ///< on the scene's smallest machine
  bool is_calibrated = false;                ///< the machine's prices were fitted to it
  bool is_base = false;
  TimeParts parts;

  /// Returns whether the cell is neither calibrated nor 100 % by definition.
  bool is_predicted() const { return !is_calibrated && !is_base; }
  /// Returns the efficiency in percent, against one worker.
  std::optional<double> efficiency_by_worker() const {
    return one_worker_seconds ? std::optional(apps::efficiency(*one_worker_seconds, 1, seconds, nodes)) : std::nullopt;
  }
};
/// Returns the number of printed cells.
std::size_t printed_cell_count();

/// Differences of predictions from printed values, in points.
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

/// Returns all printed cells whose runs have ended, scene by scene.
std::vector<CellOfTable3> cells_of_table_3(const Catalogue& catalogue, const PaperResults& results);

/// Adds a note on how many of the `expected` rows are missing, if any: their runs were interrupted, or an error ended the study.
void note_missing_rows(Table& table, std::size_t expected);

/// Each table has the rows whose runs have ended, and says how many are missing.
Table table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects);
Table table_3(const Catalogue& catalogue, const PaperResults& results);
/// The parts of the nodes' time in Table 3.
Table losses(const Catalogue& catalogue, const PaperResults& results);
/// Figures 5 and 7: travelling rays beside travelling pages.
Table algorithms(const Catalogue& catalogue, const PaperResults& results);
/// Effect of the variants of travelling rays on 64 nodes.
Table ray_ways(const Catalogue& catalogue, const PaperResults& results);
/// Returns "3x3", or "static" for 0.
std::string item_text(std::uint32_t side);
/// Effect of the size of a work item.
Table work_items(const Catalogue& catalogue, const PaperResults& results);
/// Effect of the page size with page look-ups in software and in hardware.
Table page_sizes(const Catalogue& catalogue, const PaperResults& results);
/// Figures 8 to 10: effect of the cache size.
Table caches(const Catalogue& catalogue, const PaperResults& results);

/// Efficiencies of the scenes that miss pages: with caches of the article's share of the database, as in Table 3; the same with
/// records without an order in space; with the share that the article's Figures 8 to 10 suggest; and with memories of its 4 MB.
/// Each stands beside the printed value.
Table memories(const Catalogue& catalogue, const PaperResults& results);
/// A row for each claim of the article's text whose runs have ended: the claim, "held" or "not held", and the result. Nothing is
/// judged from pictures of another resolution than the article's.
Table claims(const Catalogue& catalogue, const PaperResults& results);

/// A cell of Table 3 whose run on voxels has ended.
struct VoxelCell {
  PaperPlace place;
  double printed_seconds = 0, seconds = 0;
  PricedCell ray;           ///< node-milliseconds of a ray, by prices; printed ones over the printed number of rays
  double milliseconds = 0;  ///< node-milliseconds of a ray in our run
  double printed_efficiency = 0;
  std::optional<double> efficiency;  ///< nothing if the scene's smallest machine has no time
  std::optional<double> one_worker_seconds;

  const PaperScene& scene() const { return paper_scenes[place.scene]; }
  std::uint32_t nodes() const { return paper_node_counts[place.column]; }
  bool is_base() const { return place.column == scene().base(); }
  bool is_fitted() const;
  /// Returns found over printed. Both are per ray, since our rays are slightly fewer than the article's (Table 2), and prices are
  /// those of a ray.
  double ratio() const { return milliseconds / ray.printed; }
};
/// Returns the cells scene by scene.
std::vector<VoxelCell> voxel_cells(const Catalogue& catalogue, const PaperResults& results);

/// Kilobytes and pages a pixel beside the printed values.
Table voxel_table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects);
/// Seconds and efficiencies beside the printed values.
Table voxel_table_3(const Catalogue& catalogue, const PaperResults& results);
/// The machine's prices beside those that its four cells require.
Table voxel_prices(const Catalogue& catalogue, const PaperResults& results);
/// Predictions for all cells from prices fitted to any two scenes, smallest and largest machine: a row for each pair.
Table voxel_pairs(const Catalogue& catalogue, const PaperResults& results);
/// Figures 8 to 10: effect of the cache size, in the article's pages, on 32 nodes.
Table voxel_caches(const Catalogue& catalogue, const PaperResults& results);
/// Balance of the load of Rings3's regions.
Table voxel_loads(const Catalogue& catalogue, const PaperResults& results);
/// Claims of the article's text that depend on the structure, as claims() has them for dmpc's grid.
Table voxel_claims(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
