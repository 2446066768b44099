// Results of the study `paper` without its runs, and of a few runs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/data.h"
#include "apps/lab/study/paper/runs.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::tests {

/// The preset of dmpc's grid.
inline nodes::Machine paper_machine() { return apps::find_machine_preset("ipsc2")->machine; }

inline apps::PaperResult result_of_seconds(std::uint64_t seconds) { return {.total_ns = seconds * 1'000'000'000}; }

/// As if every cell of Table 3 had come out as printed, on either structure; of all other runs nothing.
inline apps::PaperResults as_printed(const apps::Catalogue& catalogue) {
  apps::PaperResults results(catalogue.runs.size());
  for (std::size_t scene = 0; scene < apps::paper_scenes.size(); ++scene) {
    const apps::PaperScene& paper = apps::paper_scenes[scene];
    for (std::size_t column = paper.base(); column < apps::paper_node_counts.size(); ++column) {
      for (const apps::TimedRuns& runs : {catalogue.article, catalogue.grid}) {
        results[runs.timed[scene][column]] = result_of_seconds(paper.seconds[column]);
        results[runs.timed[scene][column]]->rays = paper.rays;
      }
    }
  }
  return results;
}

/// As if every run had taken the same time.
inline apps::PaperResults all_alike(const apps::Catalogue& catalogue) {
  return apps::PaperResults(catalogue.runs.size(), result_of_seconds(100));
}

/// What these runs come to.
inline apps::PaperResults carried_out(const std::vector<apps::PaperRun>& runs, const std::vector<apps::PaperSubject>& subjects) {
  apps::Interrupt interrupt;
  apps::PaperResults results(runs.size());
  apps::carry_out(runs, subjects, interrupt, results);
  return results;
}

/// On one node, what it takes others to have so many percent of an efficiency.
inline constexpr std::uint64_t one_node_seconds = 6'400'000;
inline apps::PaperResult result_of_efficiency(double percent, std::uint32_t node_count) {
  return {.total_ns = static_cast<std::uint64_t>(1e9 * one_node_seconds * 100 / percent / node_count)};
}

/// One scene's caches, by size: efficiencies, and pages that a node receives and sends as a share of the network's rate.
struct CacheFigures {
  std::array<double, apps::cache_size_count> efficiency{}, traffic{};
};
inline void set_caches(apps::PaperResults& results, const apps::Catalogue& catalogue, std::size_t scene,
                       const CacheFigures& figures) {
  results[catalogue.cache_base[scene]] = result_of_seconds(one_node_seconds);
  for (std::size_t size = 0; size < apps::cache_size_count; ++size) {
    apps::PaperResult result = result_of_efficiency(figures.efficiency[size], apps::cache_node_count);
    result.page_bytes =
        static_cast<std::uint64_t>(figures.traffic[size] / 2 * apps::network_rate * apps::cache_node_count * result.seconds());
    results[catalogue.cached[scene][size]] = result;
  }
}

}  // namespace dmpc::tests
