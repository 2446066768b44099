// The study `balance`: how evenly the work of travelling rays is distributed, and the effect of the regions' positions.
#include "apps/lab/study/studies.h"

#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/option_words.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/run/ray_hops.h"
#include "core/families/scenes.h"
#include "dataflow/regions/bsp.h"

namespace dmpc::apps {
namespace {

using dataflow::Balance;
using dataflow::CutOrder;

struct Cutting {
  const char* name;
  Balance balance;
  CutOrder order = CutOrder::longer_axis;
  std::uint32_t regions_a_node = 1;
};
constexpr std::array<Cutting, 4> cuttings = {{{"subsampled", Balance::subsampled},
                                              {"subsampled, alternating", Balance::subsampled, CutOrder::alternating},
                                              {"equal size", Balance::equal_size},
                                              {"scattered, 16 a node", Balance::scattered, CutOrder::longer_axis, 16}}};

dataflow::RunOptions options_for(const BalanceStudy& study, std::uint32_t node_count, const Cutting& cutting) {
  return {.computer = {.node_count = node_count},
          .rays = {.balance = {.balance = cutting.balance,
                               .subsample = study.subsample,
                               .bsp = {.order = cutting.order},
                               .regions_a_node = cutting.regions_a_node},
                   .topology = study.topology}};
}

/// A run, or one of its nodes.
struct BalanceRow {
  const dataflow::Report& report;
  const char* regions;
  RayHops hops;
  std::vector<double> work;
  std::optional<std::uint32_t> node = {};  ///< nothing: all nodes
};

/// Returns an empty cell if no load is known.
Cell average_load_cell(std::span<const double> loads) {
  return loads.empty() ? Cell() : Cell(100 * dataflow::average_load(loads));
}

/// Returns the share of `node` in all work; empty if no load is known.
Cell share_cell(std::span<const double> loads, std::uint32_t node) {
  return loads.empty() ? Cell() : Cell(percent_of(loads[node], std::accumulate(loads.begin(), loads.end(), 0.0)));
}

/// No picture has a longer side.
constexpr std::int64_t subsample_max = 65536;

/// Returns an empty cell if no ray went on.
Cell hops_cell(const BalanceRow& row, double hops) { return row.report.messages_per_ray() > 0 ? Cell(hops) : Cell(); }

FilledColumns<BalanceRow> balance_columns(const BalanceStudy& study) {
  using Row = BalanceRow;
  const auto of_all = [](auto cell) { return only_if([](const Row& row) { return !row.node; }, cell); };
  const auto of_node = [](auto cell) { return only_if([](const Row& row) { return row.node.has_value(); }, cell); };
  FilledColumns<Row> columns = {
      {{"nodes"}, [](const Row& row) { return std::uint64_t{row.report.plan.node_count()}; }},
      {{"regions"}, [](const Row& row) { return row.regions; }},
      {{"average load predicted", "%", 1}, of_all([](const Row& row) { return average_load_cell(row.report.predicted); })},
      {{"average load achieved", "%", 1}, of_all([](const Row& row) { return average_load_cell(row.work); })},
      {{"duplication", "", 3}, of_all([](const Row& row) { return row.report.duplication; })},
      {{"moves a ray", "", 3}, of_all([](const Row& row) { return row.report.messages_per_ray(); })},
      {{"hops", "", 2}, of_all([](const Row& row) { return hops_cell(row, row.hops.mean); })},
      {{"hops at random", "", 2}, of_all([](const Row& row) { return hops_cell(row, row.hops.mean_of_random); })}};
  if (study.per_node) {
    columns.push_back({{"node"}, of_node([](const Row& row) { return std::uint64_t{*row.node}; })});
    columns.push_back(
        {{"share predicted", "%", 2}, of_node([](const Row& row) { return share_cell(row.report.predicted, *row.node); })});
    columns.push_back({{"share achieved", "%", 2}, of_node([](const Row& row) { return share_cell(row.work, *row.node); })});
  }
  return columns;
}

/// Returns whether it is the article's Rings3, in the same number of triangles.
bool is_rings_3(const std::string& scene) {
  const auto scene_name = core::find_scene_name(scene);
  return scene_name && scene_name->text() == "rings-3-t1";
}

/// Returns the average load in the row of these regions and number of nodes; nothing if there is none.
std::optional<double> load_with(const Table& table, double node_count, const std::string& regions) {
  for (const std::vector<Cell>& row : table.rows()) {
    const auto load = number_in(table, row, "average load achieved");
    if (load && number_in(table, row, "nodes") == node_count && row[1] == Cell(regions)) {
      return load;
    }
  }
  return std::nullopt;
}

}  // namespace

void BalanceStudy::add_options(StudyLine line) {
  add_node_counts(line.set, node_counts);
  line.set.add_number("--subsample", subsample, 1, subsample_max, "8", "The subsampled picture has one pixel of every NxN");
  line.set.add_choice("--topology", topology, topology_choices(), "The wiring onto which neighbouring regions are mapped");
  line.set.add_flag("--per-node", per_node, "Show each node's share of the work, too");
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study balance rings-3-t1\n"
      "  dmpc study balance teapot-12 --nodes=16 --topology=torus --per-node --format=csv -o teapot.csv");
}

std::vector<Column> BalanceStudy::columns() const { return heads_of(balance_columns(*this)); }

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
  runs.expect_runs(node_counts.size() * cuttings.size());
  const FilledColumns<BalanceRow> columns = balance_columns(*this);
  for (const std::uint32_t node_count : node_counts) {
    for (const Cutting& cutting : cuttings) {
      const std::string computer = std::to_string(node_count) + " nodes, regions " + cutting.name;
      const dataflow::Report report = runs.run(computer, options_for(*this, node_count, cutting));
      BalanceRow row{report, cutting.name, ray_hops_of(report, topology), report.work()};
      table.add_row(row_of(columns, row));
      for (std::uint32_t node = 0; per_node && node < row.work.size(); ++node) {
        row.node = node;
        table.add_row(row_of(columns, row));
      }
    }
  }
}

std::vector<std::string> BalanceStudy::notes(const std::string& scene) const {
  const std::string step = std::to_string(subsample);
  std::vector<std::string> notes = {
      "Average load: mean over maximum of the nodes' work, which is counted operations at measured prices.",
      "Predicted: by the picture of one pixel of every " + step + "x" + step + ".",
      "Alternating: a box is cut along one axis, its halves along the other, as the article has it; the others across their "
      "longer sides.",
      "Scattered: a lattice of regions of equal size, neighbours on different nodes.",
      "Moves: how often a ray goes on to another node.",
      "Duplication: copies of primitives in all regions over those in the database's BVH nodes.",
      "Hops: links that a ray sent from node to node passes on a machine wired as a " + std::string(nodes::name_of(topology)) +
          ", by counted rays, with the regions where they are put and as the mean of random mappings."};
  if (is_rings_3(scene)) {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Rings3 an average load of 82.5 % with one pixel of every 8x8, and under "
        "20 % with regions of equal size.");
  }
  return notes;
}

std::string BalanceStudy::conclusion(const Table& table) const {
  const auto* const last = last_with(table, {"nodes", "average load achieved"});
  const double node_count = last == nullptr ? 0 : *number_in(table, *last, "nodes");
  const auto sampled = load_with(table, node_count, "subsampled"), equal = load_with(table, node_count, "equal size");
  return !sampled || !equal
             ? ""
             : "On " + nodes_text(table, *last) + " the average load is " + percent_text(*sampled) +
                   " with regions by the subsampled picture, and " + percent_text(*equal) + " with regions of equal size.";
}

}  // namespace dmpc::apps
