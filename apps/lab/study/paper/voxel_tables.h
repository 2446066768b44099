// The tables of the study `paper` on the article's own structure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/edge/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/price_fit.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

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
