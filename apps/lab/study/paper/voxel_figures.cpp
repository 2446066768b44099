// The article's results on caches and on the load of regions, on its own structure.
#include <string>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {

Table voxel_caches(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Figures 8 to 10 on the article's own structure: caches on " + std::to_string(cache_node_count) + " nodes",
              {{"scene"},
               {"cache", "pages"},
               {"efficiency", "%", 1},
               {"faults"},
               {"miss ratio", "%", 3},
               {"page traffic a node", "bytes/s", 0},
               {"page wait", "%", 1},
               {"service_busy", "%", 1}});
  std::size_t expected = 0;
  for (std::size_t i = 0; i < voxel_caches_tried.size(); ++i) {
    const auto& [scene, pages] = voxel_caches_tried[i];
    const auto& base = results[catalogue.voxels.counted[scene]];
    expected += pages.size();
    for (std::size_t size = 0; size < pages.size(); ++size) {
      if (const auto& result = results[catalogue.voxels.cached[i][size]]; base && result) {
        table.add_row({paper_scenes[scene].title, std::uint64_t{pages[size]},
                       efficiency(base->seconds(), 1, result->seconds(), cache_node_count), result->faults,
                       100 * result->miss_ratio(), result->page_rate(cache_node_count), result->percent(TimePart::data_wait),
                       result->percent(TimePart::service_busy)});
      }
    }
  }
  note_missing_rows(table, expected);
  table.add_note(
      "The article's page counts, on pictures of the whole resolution. With fewer pages a picture takes minutes, as most "
      "look-ups of another page miss: they are left out.");
  return table;
}

Table voxel_loads(const Catalogue& catalogue, const PaperResults& results) {
  Table table("The load of Rings3's regions on the article's own structure", {{"regions"},
                                                                              {"nodes"},
                                                                              {"average load", "%", 1},
                                                                              {"seconds", "s", 0},
                                                                              {"tests over one node's", "", 3},
                                                                              {"by way of the host", "%", 2}});
  const auto& one = results[catalogue.voxels.one_region];
  const auto add_rows = [&](const char* regions, const auto& runs) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (const auto& result = results[runs[i]]; one && result) {
        table.add_row({regions, std::uint64_t{loaded_node_counts[i]}, 100 * result->average_load, result->seconds(),
                       one->tests == 0 ? 1 : static_cast<double>(result->tests) / static_cast<double>(one->tests),
                       100 * result->overflowed});
      }
    }
  };
  add_rows("subsampled", catalogue.voxels.subsampled);
  add_rows("of equal size", catalogue.voxels.equal_size);
  note_missing_rows(table, 2 * loaded_node_counts.size());
  table.add_note(
      "Mean over maximum of the nodes' work; the article has about 82.5 % and less than 20 %, and does not say on how many "
      "nodes. Cuts in alternating directions, no backpressure. Regions whose border runs through a voxel test what lies on both "
      "sides again, and spare what lies on the other: in the loads both are counted.");
  return table;
}

}  // namespace dmpc::apps
