#include "apps/lab/study/paper/report.h"

#include <array>
#include <cstddef>
#include <utility>

#include "apps/frontend/run/time_parts.h"
#include "apps/lab/study/paper/catalogue.h"

namespace dmpc::apps {
namespace {

const PlotAxis nodes_axis{.label = "nodes", .scale = PlotScale::powers_of_2, .least = 0.9, .most = 72};
const PlotAxis cache_axis{
    .label = "cache of a node (% of the database)", .scale = PlotScale::powers_of_10, .least = 0.002, .most = 100};

PaperPlot plot_of_table_2() {
  Plot plot{.name = "table_2",
            .title = "Table 2: pages for a pixel, printed and found",
            .places = {"scene"},
            .x = {},
            .y = {.label = "pages for a pixel", .least = 0},
            .series = {}};
  plot.series = {{"printed", "pages a pixel printed", {}, PlotMark::bars, 0}, {"found", "pages a pixel", {}, PlotMark::bars, 1}};
  return {"table_2", std::move(plot)};
}

/// Printed values are points, ours are a line of the same colour. `has_bases`: a scene with one printed cell is drawn, too.
PaperPlot plot_of_table_3(const std::string& name, const std::string& title, const PlotAxis& y, const std::string& printed,
                          const std::string& found, bool has_bases) {
  Plot plot{.name = name, .title = title, .places = {"nodes"}, .x = nodes_axis, .y = y, .series = {}};
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const PaperScene& paper = paper_scenes[scene];
    if (has_bases || paper.base() + 1 < paper_node_counts.size()) {
      const std::string of_scene = paper.title;
      plot.series.push_back({of_scene + ", printed", printed, {{"scene", of_scene}}, PlotMark::points, scene});
      plot.series.push_back({of_scene + ", found", found, {{"scene", of_scene}}, PlotMark::line, scene});
    }
  }
  return {"table_3", std::move(plot)};
}

PaperPlot plot_of_algorithms() {
  Plot plot{.name = "algorithms",
            .title = "Figures 5 and 7: efficiency of both algorithms",
            .places = {"nodes"},
            .x = nodes_axis,
            .y = percent_axis("efficiency"),
            .series = {}};
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const std::string name = rings[scene];
    plot.series.push_back({name + ", pages travel", "pages travel efficiency", {{"scene", name}}, PlotMark::line, 2 * scene});
    plot.series.push_back({name + ", rays travel", "rays travel efficiency", {{"scene", name}}, PlotMark::line, 2 * scene + 1});
  }
  return {"algorithms", std::move(plot)};
}

PaperPlot plot_of_caches(const std::string& name, const std::string& title, const PlotAxis& y, const std::string& column) {
  Plot plot{.name = name, .title = title, .places = {"of the database"}, .x = cache_axis, .y = y, .series = {}};
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    const std::string of_scene = cache_scenes[scene].row().title;
    plot.series.push_back({of_scene, column, {{"scene", of_scene}}, PlotMark::line, scene});
  }
  return {"caches", std::move(plot)};
}

PaperPlot plot_of_traffic() {
  PaperPlot traffic = plot_of_caches("traffic", "Figure 10: pages that a node receives and sends, 32 nodes",
                                     percent_axis("of 0.9 MB/s"), "traffic both ways");
  traffic.plot.series.push_back({"Rings4, printed", "printed", {{"scene", "Rings4"}}, PlotMark::points, 0});
  return traffic;
}

PaperPlot plot_of_losses() {
  Plot plot{.name = "losses",
            .title = "Where the nodes' time goes, computing apart",
            .places = {"scene", "nodes"},
            .x = {},
            .y = {.label = "of the nodes' time (%)", .least = 0},
            .series = {},
            .is_stacked = true};
  constexpr std::array<const char*, time_part_count> words = {"computing",
                                                              "page wait",
                                                              "starvation",
                                                              "token wait",
                                                              "credit wait",
                                                              "film wait",
                                                              "other waits",
                                                              "service while busy by others' requests",
                                                              "lent to others' requests",
                                                              "messages",
                                                              "idle at the end"};
  for (std::size_t part = 1; part < time_part_count; ++part) {
    plot.series.push_back({words[part], time_part_names[part], {}, PlotMark::bars, part - 1});
  }
  return {"losses", std::move(plot)};
}

PaperPlot plot_of_sensitivity() {
  Plot plot{.name = "sensitivity",
            .title = "What a fifth less or more of a figure does to the efficiency on 64 nodes",
            .places = {"figure"},
            .x = {},
            .y = {.label = "change of the efficiency (points)"},
            .series = {}};
  struct Colored {
    std::string scene;
    std::size_t less, more;
  };
  for (const auto& [scene, less, more] : {Colored{"Mountain", 0, 5}, Colored{"Rings4", 1, 4}, Colored{"Tetra9", 6, 7}}) {
    plot.series.push_back({scene + ", -20 %", scene + " 64", {{"change", "-20 %"}}, PlotMark::bars, less});
    plot.series.push_back({scene + ", +20 %", scene + " 64", {{"change", "+20 %"}}, PlotMark::bars, more});
  }
  return {"sensitivity", std::move(plot)};
}

}  // namespace

std::vector<PaperPlot> paper_plots() {
  return {
      plot_of_table_2(),
      plot_of_table_3("table_3_seconds", "Table 3: seconds on the iPSC/2, printed and found",
                      {.label = "time", .scale = PlotScale::powers_of_10}, "printed", "found", true),
      plot_of_table_3("table_3", "Table 3: efficiency on the iPSC/2, printed and found", {.label = "efficiency (%)", .most = 102},
                      "efficiency printed", "efficiency", false),
      plot_of_algorithms(),
      plot_of_caches("caches", "Figure 8: efficiency by the size of the cache, 32 nodes", percent_axis("efficiency"),
                     "efficiency"),
      plot_of_caches("misses", "Figure 9: look-ups that miss, 32 nodes", {.label = "miss ratio (%)", .least = 0}, "miss ratio"),
      plot_of_traffic(),
      plot_of_losses(),
      plot_of_sensitivity()};
}

}  // namespace dmpc::apps
