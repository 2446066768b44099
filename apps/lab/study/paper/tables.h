// The tables of the study `paper`: the article's printed values beside our results. Each table has the rows whose runs have
// ended, and says how many are missing.
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
std::optional<double> found_efficiency(const RunsByNodeCount& runs, const PaperResults& results, std::size_t base,
                                       std::size_t column);

/// A cell of Table 3 whose run has ended.
struct TimedCell {
  PaperPlace place;
  bool is_fitted = false;  ///< the machine's prices were fitted to it
  double printed_seconds = 0, seconds = 0;
  PricedCell ray;           ///< node-milliseconds of a ray, by prices; printed ones over the printed number of rays
  double milliseconds = 0;  ///< node-milliseconds of a ray in our run
  double printed_efficiency = 0;
  std::optional<double> efficiency;  ///< nothing if the scene's smallest machine has no time
  std::optional<double> one_worker_seconds;
  TimeParts parts;

  const PaperScene& scene() const { return paper_scenes[place.scene]; }
  std::uint32_t nodes() const { return paper_node_counts[place.column]; }
  bool is_base() const { return place.column == scene().base(); }
  /// Returns whether the efficiency is neither fitted nor 100 % by definition.
  bool is_predicted() const { return !is_fitted && !is_base() && efficiency.has_value(); }
  /// Returns found over printed. Both are per ray, since our rays are slightly fewer than the article's (Table 2), and prices are
  /// those of a ray.
  double ratio() const { return milliseconds / ray.printed; }
  /// Returns the efficiency in percent, against one worker.
  std::optional<double> efficiency_by_worker() const {
    return one_worker_seconds ? std::optional(apps::efficiency(*one_worker_seconds, 1, seconds, nodes())) : std::nullopt;
  }
};
/// Returns the cells scene by scene.
std::vector<TimedCell> cells_of(const TimedRuns& runs, const PaperResults& results);
/// Returns the number of printed cells.
std::size_t printed_cell_count();

/// Differences of predictions from printed values.
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
/// Of cells that are not fitted: the times of a ray as shares of the printed ones, of all scenes and without Teapot, which is
/// another scene; and the efficiencies in points.
struct Errors {
  Differences times, times_without_teapot, efficiencies;
};
Errors errors_of(const std::vector<TimedCell>& cells);
/// Returns "4.1 % in the mean and 9.0 % at worst, 20 cells".
std::string text_of(const Differences& times);

/// Adds a note on how many of the `expected` rows are missing, if any: their runs were interrupted, or an error ended the study.
void note_missing_rows(Table& table, std::size_t expected);

/// Scenes, kilobytes and pages a pixel beside the printed values.
Table table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects);
/// Seconds and efficiencies beside the printed values.
Table table_3(const Catalogue& catalogue, const PaperResults& results);
/// The same on dmpc's grid.
Table grid_table_3(const Catalogue& catalogue, const PaperResults& results);
/// The machine's prices beside those that its four cells require.
Table voxel_prices(const Catalogue& catalogue, const PaperResults& results);
/// Predictions for all cells from prices fitted to any two scenes, smallest and largest machine: a row for each pair.
Table voxel_pairs(const Catalogue& catalogue, const PaperResults& results);
/// The parts of the nodes' time in Table 3.
Table losses(const Catalogue& catalogue, const PaperResults& results);
/// Figures 5 and 7: travelling rays beside travelling pages.
Table algorithms(const Catalogue& catalogue, const PaperResults& results);
/// Effect of the variants of travelling rays on 64 nodes.
Table ray_ways(const Catalogue& catalogue, const PaperResults& results);
/// Balance of the load of Rings3's regions.
Table region_loads(const Catalogue& catalogue, const PaperResults& results);
/// Figures 8 to 10: effect of the cache size.
Table caches(const Catalogue& catalogue, const PaperResults& results);
/// Returns "3x3", or "static" for 0.
std::string item_text(std::uint32_t side);
/// Effect of the size of a work item.
Table work_items(const Catalogue& catalogue, const PaperResults& results);

/// The cache of Rings4 with which the article's communication rate peaks, and what is printed there.
inline constexpr std::uint32_t peak_pages = 204;
inline constexpr double peak_share = 0.7;
/// Most bytes a second that messages of 1 KB allow between two nodes, by the article.
inline constexpr double network_rate = 0.9e6;
/// Returns the pages that a node receives and sends, as a share of that.
inline double network_share(const PaperResult& result, std::uint32_t node_count) {
  return 2 * result.page_rate(node_count) / network_rate;
}

/// A row for each claim of the article's text whose runs have ended: the claim, "held" or "not held", the result, and why if it
/// is not held. Nothing is judged from pictures of another resolution than the article's.
Table claims(const Catalogue& catalogue, const PaperResults& results);

/// Table 3 in the article's layout, each cell printed and found.
Table summary_table(const Catalogue& catalogue, const PaperResults& results);
/// Paragraphs that open the report: how well Table 3 is predicted, two reservations, and which claims are held.
std::vector<std::string> summary_texts(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
