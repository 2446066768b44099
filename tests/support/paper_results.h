// Results of the study `paper` without its runs.
#pragma once

#include <cstddef>

#include "apps/paper_catalogue.h"
#include "apps/paper_data.h"
#include "apps/paper_runs.h"

namespace dmpc::tests {

inline apps::PaperResult result_of_seconds(std::uint64_t seconds) { return {.total_ns = seconds * 1'000'000'000}; }

/// As if every cell of Table 3 had come out as printed; of all other runs nothing.
inline apps::PaperResults as_printed(const apps::Catalogue& catalogue) {
  apps::PaperResults results(catalogue.runs.size());
  for (std::size_t scene = 0; scene < apps::paper_scenes.size(); ++scene) {
    const apps::PaperScene& paper = apps::paper_scenes[scene];
    for (std::size_t column = paper.base(); column < apps::paper_node_counts.size(); ++column) {
      results[catalogue.timed[scene][column]] = result_of_seconds(paper.seconds[column]);
    }
  }
  return results;
}

}  // namespace dmpc::tests
