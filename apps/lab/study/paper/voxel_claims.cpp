// The claims of the article's text that depend on the structure, compared with our runs on its own structure.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/claim_rows.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

void claim_least_efficiency(Claims& rows, const std::vector<VoxelCell>& cells) {
  double least = 100;
  for (const VoxelCell& cell : cells) {
    const double by_worker =
        cell.one_worker_seconds ? efficiency(*cell.one_worker_seconds, 1, cell.seconds, cell.nodes()) : 100.0;
    least = std::min({least, cell.efficiency.value_or(100), by_worker});
  }
  if (cells.size() == printed_cell_count()) {
    rows.add("With up to 64 nodes the efficiency is almost always above 78 %", least > 78,
             "the least is " + fixed(least, 1) + " %");
  }
}

/// "92.4, 89.8, 87.6"; nothing if a run is missing.
std::optional<std::string> loads_text(const PaperResults& results, const auto& runs) {
  std::string text;
  for (const std::size_t run : runs) {
    if (!results[run]) {
      return std::nullopt;
    }
    text += (text.empty() ? "" : ", ") + fixed(100 * results[run]->average_load, 1);
  }
  return text;
}

/// Judged at one of the numbers of nodes, as the article does not say which.
void claim_loads(Claims& rows, const VoxelRuns& voxels, const PaperResults& results) {
  const auto subsampled = loads_text(results, voxels.subsampled), equal = loads_text(results, voxels.equal_size);
  if (!subsampled || !equal) {
    return;
  }
  bool is_held = false;
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    const double load = 100 * results[voxels.subsampled[i]]->average_load,
                 of_equal = 100 * results[voxels.equal_size[i]]->average_load;
    is_held = is_held || (load > 77.5 && load < 87.5 && of_equal < 20);
  }
  rows.add("Subsampled regions load nodes to about 82.5 % (Rings3), regions of equal size to less than 20 %", is_held,
           *subsampled + " % and " + *equal + " % on 16, 32 and 64 nodes; the article does not say on how many");
}

/// One scene's caches, by size.
struct CachedRun {
  std::uint32_t pages = 0;
  double share = 0;  ///< of the article's database
  double efficiency = 0, page_rate = 0;
};
std::vector<CachedRun> cached_runs(const VoxelRuns& voxels, const PaperResults& results, std::size_t number) {
  std::vector<CachedRun> runs;
  const auto& [scene, pages] = voxel_caches_tried[number];
  const auto& base = results[voxels.counted[scene]];
  for (std::size_t size = 0; size < pages.size(); ++size) {
    if (const auto& result = results[voxels.cached[number][size]]; base && result) {
      runs.push_back({pages[size], pages[size] / static_cast<double>(paper_scenes[scene].database_kilobytes),
                      efficiency(base->seconds(), 1, result->seconds(), cache_node_count), result->page_rate(cache_node_count)});
    }
  }
  return runs;
}

/// Returns the smallest tested cache with more than half of an efficiency; nothing if there is none.
std::optional<CachedRun> smallest_for_half(const std::vector<CachedRun>& runs) {
  const auto found = std::find_if(runs.begin(), runs.end(), [](const CachedRun& run) { return run.efficiency > 50; });
  return found == runs.end() ? std::nullopt : std::optional(*found);
}

std::string half_text(const std::optional<CachedRun>& run) {
  return run ? std::to_string(run->pages) + " pages, " + fixed(100 * run->share, 2) + " % of the database" : "none";
}

void claim_voxel_caches(Claims& rows, const VoxelRuns& voxels, const PaperResults& results) {
  const std::vector<CachedRun> of_rings = cached_runs(voxels, results, 0), of_tetra = cached_runs(voxels, results, 1);
  if (of_rings.size() < voxel_caches_tried[0].pages.size() || of_tetra.size() < voxel_caches_tried[1].pages.size()) {
    return;
  }
  const auto for_rings = smallest_for_half(of_rings), for_tetra = smallest_for_half(of_tetra);
  rows.add("Rings4 needs larger caches than Tetra9 to stay above 50 %, as a share of the database",
           for_tetra && (!for_rings || for_rings->share > for_tetra->share),
           "the smallest of those tried: Rings4 " + half_text(for_rings) + "; Tetra9 " + half_text(for_tetra));
  const auto peak = std::max_element(of_rings.begin(), of_rings.end(),
                                     [](const CachedRun& a, const CachedRun& b) { return a.page_rate < b.page_rate; });
  rows.add("The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches",
           peak != of_rings.begin() && peak->pages < of_rings.back().pages,
           "of the caches tried, from " + std::to_string(of_rings.front().pages) + " pages on, the most travels with " +
               std::to_string(peak->pages));
  const auto at_peak = std::find_if(of_rings.begin(), of_rings.end(), [](const CachedRun& run) { return run.pages == 204; });
  rows.add("At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow",
           at_peak->page_rate > 0.6 * 0.9e6 && at_peak->page_rate < 0.8 * 0.9e6,
           "with 204 pages a node receives " + fixed(at_peak->page_rate / 0.9e4, 0) + " %, with " + std::to_string(peak->pages) +
               " " + fixed(peak->page_rate / 0.9e4, 0) + " %");
}

}  // namespace

Table voxel_claims(const Catalogue& catalogue, const PaperResults& results) {
  Claims rows("What the text claims, on the article's own structure", catalogue.resolution);
  claim_least_efficiency(rows, voxel_cells(catalogue, results));
  claim_loads(rows, catalogue.voxels, results);
  claim_voxel_caches(rows, catalogue.voxels, results);
  claim_extents(rows, results, catalogue.voxels.counted, catalogue.voxels.extents, "; eight boxes cost what one record does");
  return std::move(rows).table();
}

}  // namespace dmpc::apps
