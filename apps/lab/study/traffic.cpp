// The study `traffic`: the traffic of travelling rays beside that of travelling pages.
#include "apps/lab/study/studies.h"

#include <algorithm>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/run/strategy_options.h"
#include "core/base/ranges.h"
#include "dataflow/regions/balance.h"
#include "svm/packets.h"

namespace dmpc::apps {
namespace {

using dataflow::Balance;

/// The runs of a row.
struct TrafficRow {
  std::uint32_t node_count;
  dataflow::Report rays, rays_of_equal_size;
  svm::Report pages;

  nodes::Traffic ray_traffic() const { return dataflow::ray_traffic(rays.sent()); }
};

/// Returns the memory of the node that used most.
template <class Report>
std::uint64_t memory_max_bytes(const Report& report) {
  return core::max_over(report.nodes, std::size_t{0}, [&](const auto& node) { return node.memory_used.total(); });
}

/// Returns a share of the rays sent; nothing if none was.
Cell percent_cell(double part, std::uint64_t rays_sent) {
  return rays_sent == 0 ? Cell() : Cell(100 * part / static_cast<double>(rays_sent));
}

Cell fill_cell(const dataflow::Report& report) {
  const std::uint64_t sent = report.gathers().rays;
  return percent_cell(report.mean_fill() * static_cast<double>(sent), sent);
}

Cell overflow_cell(const dataflow::Report& report) {
  return percent_cell(static_cast<double>(report.gathers().rays_overflowed), report.gathers().rays);
}

double average_load_percent(const dataflow::Report& report) { return 100 * dataflow::average_load(report.work()); }

const FilledColumns<TrafficRow>& traffic_columns() {
  using Row = TrafficRow;
  static const FilledColumns<Row> columns = {
      {{"nodes"}, [](const Row& row) { return std::uint64_t{row.node_count}; }},
      {{"hops a ray", "", 3}, [](const Row& row) { return row.rays.messages_per_ray(); }},
      {{"rays sent"}, [](const Row& row) { return row.rays.gathers().rays; }},
      {{"ray packets"}, [](const Row& row) { return row.ray_traffic().packets; }},
      {{"ray traffic", "bytes"}, [](const Row& row) { return row.ray_traffic().bytes; }},
      {{"packet fill", "%", 1}, [](const Row& row) { return fill_cell(row.rays); }},
      {{"overflow", "%", 2}, [](const Row& row) { return overflow_cell(row.rays); }},
      {{"dataflow memory", "bytes"}, [](const Row& row) { return memory_max_bytes(row.rays); }},
      {{"average load", "%", 1}, [](const Row& row) { return average_load_percent(row.rays); }},
      {{"average load equal size", "%", 1}, [](const Row& row) { return average_load_percent(row.rays_of_equal_size); }},
      {{"faults"}, [](const Row& row) { return row.pages.pages().faults; }},
      {{"page traffic", "bytes"}, [](const Row& row) { return row.pages.sent()[svm::number_of(svm::Kind::page_reply)].bytes; }},
      {{"svm memory", "bytes"}, [](const Row& row) { return memory_max_bytes(row.pages); }}};
  return columns;
}

}  // namespace

void TrafficStudy::add_options(StudyLine line) {
  add_node_counts(line.set, node_counts);
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study traffic teapot-12\n"
      "  dmpc study traffic rings-4-t1 --nodes=8,64 --resolution=256x256 --format=json -o rings.json");
}

std::vector<Column> TrafficStudy::columns() const { return heads_of(traffic_columns()); }

std::vector<Plot> TrafficStudy::plots() const {
  const PlotAxis bytes{.label = "", .scale = PlotScale::powers_of_10};
  return {curves("traffic_bytes", "Bytes that travel", "nodes", node_axis(), bytes,
                 {{.title = "rays travel", .column = "ray traffic", .color = 1}, {"pages travel", "page traffic"}}),
          curves("traffic_memory", "Memory of the fullest node", "nodes", node_axis(), bytes,
                 {{.title = "rays travel", .column = "dataflow memory", .color = 1}, {"pages travel", "svm memory"}})};
}

void TrafficStudy::measure(StudyRuns& runs, Table& table) const {
  runs.expect_runs(3 * node_counts.size());
  for (const std::uint32_t node_count : node_counts) {
    const auto by_rays = [&](Balance balance, const char* regions) {
      dataflow::RayOptions rays = StrategyOptions().rays;
      rays.balance.balance = balance;
      return runs.run(std::to_string(node_count) + " nodes, dataflow, regions " + regions,
                      dataflow::RunOptions{.computer = {.node_count = node_count}, .rays = rays});
    };
    table.add_row(row_of(traffic_columns(), TrafficRow{node_count, by_rays(Balance::subsampled, "subsampled"),
                                                       by_rays(Balance::equal_size, "equal size"),
                                                       runs.run(std::to_string(node_count) + " nodes, svm",
                                                                svm::RunOptions{.computer = {.node_count = node_count}})}));
  }
}

std::vector<std::string> TrafficStudy::notes(const std::string&) const {
  return {
      "Rays travel (dataflow, regions by the subsampled picture): hops a ray are rays sent over rays shot; packets and "
      "their bytes count every packet with rays, those by way of the host twice; overflow is the share of the rays sent that "
      "took that way.",
      "Average load: mean over maximum of the nodes' work, with regions by the subsampled picture and of equal size.",
      "Pages travel (svm, cache of a quarter of the database): faults, and the bytes of the pages sent for them.",
      "Memory: high-water mark of the fullest node."};
}

std::string TrafficStudy::conclusion(const Table& table) const {
  const auto* const last = last_with(table, {"nodes", "ray traffic", "page traffic"});
  if (last == nullptr) {
    return "";
  }
  const std::string where = "On " + nodes_text(table, *last);
  const double rays = *number_in(table, *last, "ray traffic"), pages = *number_in(table, *last, "page traffic");
  if (rays == 0 || pages == 0) {
    return where + (rays == pages ? " nothing travels." : rays == 0 ? " no ray travels." : " no page travels.");
  }
  const bool rays_are_less = rays < pages;
  return where + " rays move " + amount_text(rays, "bytes") + " and pages " + amount_text(pages, "bytes") + ": " +
         (rays_are_less ? "rays" : "pages") + " are " + fixed(rays_are_less ? pages / rays : rays / pages, 1) +
         " times cheaper here.";
}

}  // namespace dmpc::apps
