#include "apps/lab/study/balance.h"

#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/run/ray_hops.h"
#include "core/families/scenes.h"
#include "dataflow/regions/balance.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/run.h"

namespace dmpc::apps {
namespace {

using dataflow::Balance;
using dataflow::CutOrder;

/// A way to cut space.
struct Cutting {
  const char* name;
  Balance balance;
  CutOrder order = CutOrder::longer_axis;
  std::uint32_t regions_a_node = 1;
};
constexpr std::array<Cutting, BalanceStudy::ways> cuttings = {
    {{"subsampled", Balance::subsampled},
     {"subsampled, alternating", Balance::subsampled, CutOrder::alternating},
     {"equal size", Balance::equal_size},
     {"scattered, 16 a node", Balance::scattered, CutOrder::longer_axis, 16}}};

dataflow::RunOptions options_for(const BalanceStudy& study, std::uint32_t node_count, const Cutting& cutting) {
  dataflow::RunOptions options{.computer = {.node_count = node_count},
                               .rays = {.balance = study.regions, .topology = study.topology}};
  options.rays.balance.balance = cutting.balance;
  options.rays.balance.bsp.order = cutting.order;
  options.rays.balance.regions_a_node = cutting.regions_a_node;
  return options;
}

/// Nothing where no load is known.
Cell average_load_cell(std::span<const double> loads) {
  return loads.empty() ? Cell() : Cell(100 * dataflow::average_load(loads));
}

std::vector<Cell> summary_row(const dataflow::Report& report, const BalanceStudy& study, const Cutting& cutting) {
  const RayHops hops = ray_hops_of(report, study.topology);
  const bool has_hops = report.messages_per_ray() > 0;
  std::vector<Cell> row = {std::uint64_t{report.plan.node_count()},
                           cutting.name,
                           average_load_cell(report.predicted),
                           average_load_cell(report.work()),
                           report.duplication,
                           report.messages_per_ray(),
                           has_hops ? Cell(hops.mean) : Cell(),
                           has_hops ? Cell(hops.mean_of_random) : Cell()};
  row.resize(study.columns().size());
  return row;
}

/// The share of `node` in all work; nothing where no load is known.
Cell share_cell(std::span<const double> loads, std::uint32_t node) {
  return loads.empty() ? Cell() : Cell(percent_of(loads[node], std::accumulate(loads.begin(), loads.end(), 0.0)));
}

void add_node_rows(const dataflow::Report& report, const BalanceStudy& study, const Cutting& cutting, Table& table) {
  const std::vector<double> work = report.work();
  for (std::uint32_t node = 0; node < work.size(); ++node) {
    std::vector<Cell> row(study.columns().size());
    row[0] = std::uint64_t{report.plan.node_count()};
    row[1] = cutting.name;
    row[row.size() - 3] = std::uint64_t{node};
    row[row.size() - 2] = share_cell(report.predicted, node);
    row[row.size() - 1] = share_cell(work, node);
    table.add_row(std::move(row));
  }
}

/// The article's Rings3, in as many triangles.
bool is_rings_3(const std::string& scene) {
  const auto scene_name = core::find_scene_name(scene);
  return scene_name && scene_name->text() == "rings-3-t1";
}

}  // namespace

std::vector<Column> BalanceStudy::columns() const {
  std::vector<Column> columns = {{"nodes"},
                                 {"regions"},
                                 {"average load predicted", "%", 1},
                                 {"average load achieved", "%", 1},
                                 {"duplication", "", 3},
                                 {"moves a ray", "", 3},
                                 {"hops", "", 2},
                                 {"hops at random", "", 2}};
  if (per_node) {
    columns.insert(columns.end(), {{"node"}, {"share predicted", "%", 2}, {"share achieved", "%", 2}});
  }
  return columns;
}

std::vector<Plot> BalanceStudy::plots() const {
  std::vector<PlotSeries> series;
  for (const Cutting& cutting : cuttings) {
    const std::string kind = cutting.name;
    const std::size_t color = series.size() / 2;
    series.push_back({kind + ", predicted", "average load predicted", {{"regions", kind}}, PlotMark::points, color});
    series.push_back({kind + ", achieved", "average load achieved", {{"regions", kind}}, PlotMark::line, color});
  }
  return {
      curves("balance_load", "Average load of the nodes", "nodes", node_axis(), percent_axis("average load"), std::move(series))};
}

void BalanceStudy::measure(StudyRuns& runs, Table& table) const {
  for (const std::uint32_t node_count : node_counts) {
    for (const Cutting& cutting : cuttings) {
      const std::string computer = std::to_string(node_count) + " nodes, regions " + cutting.name;
      const dataflow::Report report = runs.run(computer, options_for(*this, node_count, cutting));
      table.add_row(summary_row(report, *this, cutting));
      if (per_node) {
        add_node_rows(report, *this, cutting, table);
      }
    }
  }
}

std::vector<std::string> BalanceStudy::notes(const std::string& scene) const {
  const std::string step = std::to_string(regions.subsample);
  std::vector<std::string> notes = {
      "Average load: mean over maximum of the nodes' work, which is counted operations at measured prices.",
      "Predicted: by the picture of one pixel of every " + step + "x" + step + ".",
      "Alternating: a box is cut along one axis, its halves along the other, as the article has it; the others across their "
      "longer sides.",
      "Scattered: a lattice of regions of equal size, neighbours on different nodes.",
      "Moves: how often a ray goes on to another node.",
      "Duplication: copies of primitives in all regions over those in the database's bricks.",
      "Hops: links that a ray sent from node to node passes on a machine wired as a " + std::string(nodes::name_of(topology)) +
          ", by counted rays, with the regions where they are put and as the mean of random mappings."};
  if (is_rings_3(scene)) {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Rings3 an average load of 82.5 % with one pixel of every 8x8, and under "
        "20 % with regions of equal size.");
  }
  return notes;
}

}  // namespace dmpc::apps
