#include "apps/show/page/render_tables.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "apps/frontend/show/page/node_table.h"
#include "apps/run/memory_categories.h"
#include "apps/show/counters.h"
#include "apps/show/page/path_table.h"

namespace dmpc::apps::html {

namespace {

std::uint64_t sum_of(const std::array<std::uint64_t, core::ray_kind_count>& by_kind) {
  return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0});
}

NodeColumns own_columns(const svm::Report& report, Strategy strategy) {
  const auto program = [&](std::size_t node) -> const svm::ProgramReport& { return report.nodes[node].program; };
  using Node = std::size_t;
  NodeColumns columns =
      counter_columns<svm::WorkCounters>([=](Node node) -> const svm::WorkCounters& { return program(node).work; });
  if (strategy == Strategy::svm) {
    append(columns,
           counter_columns<svm::PageCounters>([=](Node node) -> const svm::PageCounters& { return program(node).pages; }));
  } else if (strategy == Strategy::forest) {
    append(columns, counter_columns<svm::QuestionCounters>(
                        [=](Node node) -> const svm::QuestionCounters& { return program(node).questions; }));
  }
  return columns;
}

NodeColumns own_columns(const dataflow::Report& report, Strategy) {
  const auto program = [&](std::size_t node) -> const dataflow::ProgramReport& { return report.nodes[node].program; };
  using Node = std::size_t;
  NodeColumns columns = {count_column("primary rays", [&](Node node) { return report.nodes[node].primary_rays; }),
                         count_column("rays in", [=](Node node) { return sum_of(program(node).rays.in); }),
                         count_column("rays out", [=](Node node) { return sum_of(program(node).rays.out); })};
  append(columns, counter_columns<dataflow::RayCounters>([=](Node node) -> const auto& { return program(node).rays; }));
  append(columns, counter_columns<dataflow::Gather::Counters>([=](Node node) -> const auto& { return program(node).gather; }));
  append(columns, counter_columns<dataflow::ProgramCounts>(program));
  return columns;
}

/// Returns categories of which any node has some bytes.
std::vector<NamedCategory> categories_of(const Account& account) {
  std::vector<NamedCategory> categories;
  std::copy_if(memory_categories.begin(), memory_categories.end(), std::back_inserter(categories),
               [&](const NamedCategory& named) {
                 return std::any_of(account.nodes.begin(), account.nodes.end(),
                                    [&](const NodeAccount& node) { return node.memory_used[named.category] > 0; });
               });
  return categories;
}

NodeColumns memory_columns(const Account& account) {
  NodeColumns columns;
  for (const NamedCategory& named : categories_of(account)) {
    columns.push_back(
        kibibyte_column(named.name, [&, named](std::size_t node) { return account.nodes[node].memory_used[named.category]; }));
  }
  return columns;
}

}  // namespace

Table node_table(const RenderRecord& record) {
  const Account account = account_of(record.report);
  const std::vector<NodeAccount>& all = account.nodes;
  NodeColumns columns = {count_column("rays traced", [&](std::size_t node) { return all[node].operations.ray_count(); })};
  append(columns,
         counter_columns<core::Operations>([&](std::size_t node) -> const core::Operations& { return all[node].operations; }));
  append(columns, std::visit([&](const auto& report) { return own_columns(report, record.options.strategy); }, record.report));
  append(columns, traffic_columns([&](std::size_t node) -> const nodes::NodeCounters& { return all[node].counters; }));
  return node_table("What each node did", all.size(), columns);
}

std::vector<Plot> node_plots(const RenderRecord& record) {
  const PlotAxis from_0{.label = "", .least = 0};
  std::vector<Plot> plots = {
      bars_by_node("node_rays", "Rays traced by each node", from_0, {{"rays traced", "rays traced"}}, false)};
  if (record.options.strategy == Strategy::svm && std::get<svm::Report>(record.report).pages().faults > 0) {
    plots.push_back(fault_plot());
  }
  const auto* const travels = std::get_if<dataflow::Report>(&record.report);
  if (travels != nullptr && travels->messages_per_ray() > 0) {
    plots.push_back(bars_by_node("node_travel", "Rays that came and went", from_0,
                                 {{"rays in", "rays in"}, {.title = "rays out", .column = "rays out", .color = 1}}, false));
  }
  return plots;
}

Losses losses_of(const Account& account) {
  if (account.virtual_time) {
    const std::vector<nodes::VirtualTimes>& times = account.virtual_time->nodes;
    return virtual_losses(std::span(times).first(account.nodes.size()), account.waits);
  }
  std::vector<nodes::NodeCounters> counters;
  for (const NodeAccount& node : account.nodes) {
    counters.push_back(node.counters);
  }
  return wall_losses(counters);
}

Table memory_table(const Account& account) {
  NodeColumns columns = memory_columns(account);
  columns.push_back(kibibyte_column("used", [&](std::size_t node) { return account.nodes[node].memory_used.total(); }));
  columns.push_back(kibibyte_column("planned", [&](std::size_t node) { return account.nodes[node].memory_planned.total(); }));
  return node_table("Memory of each node", account.nodes.size(), columns);
}

Plot memory_plot(const Account& account) {
  const std::vector<Column> columns = node_table("", 0, memory_columns(account)).columns();
  return stacked_by_node("memory", "Memory of each node", {.label = "", .least = 0}, columns);
}

std::vector<PacketKindTraffic> packets_of(const Account& account) {
  std::vector<PacketKindTraffic> packets;
  for (std::size_t kind = 0; kind < account.kind_names.size(); ++kind) {
    packets.push_back({packet_text(account.kind_names[kind]), account.sent[kind]});
  }
  return packets;
}

}  // namespace dmpc::apps::html
