#include "apps/lab/study/traffic.h"

#include <algorithm>
#include <utility>

#include "dataflow/regions/balance.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/run.h"
#include "svm/packets.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

using dataflow::Balance;

/// The memory of the node that used most.
template <class Report>
std::uint64_t memory_max_bytes(const Report& report) {
  std::size_t most = 0;
  for (const auto& node : report.nodes) {
    most = std::max(most, node.memory_used.total());
  }
  return most;
}

/// A share of the rays sent; nothing if none was.
Cell percent_cell(double part, std::uint64_t rays_sent) {
  return rays_sent == 0 ? Cell() : Cell(100 * part / static_cast<double>(rays_sent));
}

double average_load_percent(const dataflow::Report& report) { return 100 * dataflow::average_load(report.work()); }

/// In the order of columns().
std::vector<Cell> ray_cells(const dataflow::Report& report) {
  const dataflow::Gather::Counters gathers = report.gathers();
  const nodes::Traffic traffic = dataflow::ray_traffic(report.sent());
  return {report.messages_per_ray(),
          gathers.rays,
          traffic.packets,
          traffic.bytes,
          percent_cell(report.mean_fill() * static_cast<double>(gathers.rays), gathers.rays),
          percent_cell(static_cast<double>(gathers.rays_overflowed), gathers.rays),
          memory_max_bytes(report),
          average_load_percent(report)};
}

std::vector<Cell> page_cells(const svm::Report& report) {
  const nodes::Traffic replies = report.sent()[svm::number_of(svm::Kind::page_reply)];
  return {report.pages().faults, replies.bytes, memory_max_bytes(report)};
}

void append(std::vector<Cell>& row, const std::vector<Cell>& more) { row.insert(row.end(), more.begin(), more.end()); }

}  // namespace

std::vector<Column> TrafficStudy::columns() const {
  return {{"nodes"},
          {"hops a ray", "", 3},
          {"rays sent"},
          {"ray packets"},
          {"ray traffic", "bytes"},
          {"packet fill", "%", 1},
          {"overflow", "%", 2},
          {"dataflow memory", "bytes"},
          {"average load", "%", 1},
          {"average load equal size", "%", 1},
          {"faults"},
          {"page traffic", "bytes"},
          {"svm memory", "bytes"}};
}

std::vector<Plot> TrafficStudy::plots() const {
  const PlotAxis bytes{.label = "", .scale = PlotScale::powers_of_10};
  return {curves("traffic_bytes", "Bytes that travel", "nodes", node_axis(), bytes,
                 {{.title = "rays travel", .column = "ray traffic", .color = 1}, {"pages travel", "page traffic"}}),
          curves("traffic_memory", "Memory of the fullest node", "nodes", node_axis(), bytes,
                 {{.title = "rays travel", .column = "dataflow memory", .color = 1}, {"pages travel", "svm memory"}})};
}

void TrafficStudy::measure(StudyRuns& runs, Table& table) const {
  for (const std::uint32_t node_count : node_counts) {
    const auto run_dataflow = [&](Balance balance, const char* regions) {
      return runs.run(std::to_string(node_count) + " nodes, dataflow, regions " + regions,
                      dataflow::RunOptions{.computer = {.node_count = node_count}, .rays = {.balance = {.balance = balance}}});
    };
    std::vector<Cell> row = {std::uint64_t{node_count}};
    append(row, ray_cells(run_dataflow(Balance::subsampled, "subsampled")));
    row.emplace_back(average_load_percent(run_dataflow(Balance::equal_size, "equal size")));
    append(row, page_cells(runs.run(std::to_string(node_count) + " nodes, svm",
                                    svm::RunOptions{.computer = {.node_count = node_count}})));
    table.add_row(std::move(row));
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

}  // namespace dmpc::apps
