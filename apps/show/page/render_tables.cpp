#include "apps/show/page/render_tables.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "apps/edge/line/amount.h"
#include "apps/run/memory_categories.h"

namespace dmpc::apps::html {

namespace {

void append(std::vector<Cell>& row, std::initializer_list<std::uint64_t> numbers) {
  row.insert(row.end(), numbers.begin(), numbers.end());
}

std::vector<Column> own_columns(const svm::Report&, Strategy strategy) {
  std::vector<Column> columns = {{"pixels", "", 0}};
  if (strategy == Strategy::svm) {
    columns.insert(columns.end(), {{"look-ups", "", 0}, {"faults", "", 0}, {"pages served", "", 0}, {"evictions", "", 0}});
  } else if (strategy == Strategy::forest) {
    columns.insert(columns.end(), {{"rays asked about", "", 0}, {"records asked for", "", 0}, {"questions answered", "", 0}});
  }
  return columns;
}

std::vector<Column> own_columns(const dataflow::Report&, Strategy) {
  return {{"primary rays", "", 0}, {"rays in", "", 0}, {"rays out", "", 0}, {"most rays waiting", "", 0}};
}

void append_own(std::vector<Cell>& row, const svm::NodeReport& node, Strategy strategy) {
  append(row, {node.program.work.pixels_rendered});
  if (strategy == Strategy::svm) {
    const svm::PageCounters& pages = node.program.pages;
    append(row, {pages.references, pages.faults, pages.served, pages.evictions});
  } else if (strategy == Strategy::forest) {
    const svm::QuestionCounters& questions = node.program.questions;
    append(row, {questions.rays_asked, questions.records_asked, questions.rays_answered + questions.records_answered});
  }
}

void append_own(std::vector<Cell>& row, const dataflow::NodeReport& node, Strategy) {
  const auto sum = [](const auto& by_kind) { return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0}); };
  append(row, {node.primary_rays, sum(node.program.rays.in), sum(node.program.rays.out), node.program.backlog_high_water});
}

/// Categories of which any node has some bytes.
std::vector<NamedCategory> categories_of(const Account& account) {
  std::vector<NamedCategory> categories;
  std::copy_if(memory_categories.begin(), memory_categories.end(), std::back_inserter(categories),
               [&](const NamedCategory& named) {
                 return std::any_of(account.nodes.begin(), account.nodes.end(),
                                    [&](const NodeAccount& node) { return node.memory_used[named.category] > 0; });
               });
  return categories;
}

std::vector<Column> memory_columns(const Account& account) {
  std::vector<Column> columns = {{"node", "", 0}};
  for (const NamedCategory& named : categories_of(account)) {
    columns.push_back({named.name, "KiB", 1});
  }
  return columns;
}

}  // namespace

Table node_table(const RenderRecord& record) {
  const Account account = account_of(record.report);
  std::vector<Column> columns = {{"node", "", 0}, {"rays shot", "", 0}, {"shadings", "", 0}};
  const std::vector<Column> own =
      std::visit([&](const auto& report) { return own_columns(report, record.options.strategy); }, record.report);
  columns.insert(columns.end(), own.begin(), own.end());
  columns.insert(columns.end(),
                 {{"packets sent", "", 0}, {"sent", "bytes", 0}, {"packets received", "", 0}, {"received", "bytes", 0}});
  Table table("What each node did", std::move(columns));
  for (std::size_t i = 0; i < account.nodes.size(); ++i) {
    const NodeAccount& node = account.nodes[i];
    std::vector<Cell> row = {std::uint64_t{i}, node.operations.ray_count(), node.operations.shadings};
    std::visit([&](const auto& report) { append_own(row, report.nodes[i], record.options.strategy); }, record.report);
    const nodes::Traffic sent = total(node.counters.sent), received = total(node.counters.received);
    append(row, {sent.packets, sent.bytes, received.packets, received.bytes});
    table.add_row(std::move(row));
  }
  return table;
}

std::vector<Plot> node_plots(const RenderRecord& record) {
  const PlotAxis from_0{.label = "", .least = 0};
  std::vector<Plot> plots = {bars_by_node("node_rays", "Rays shot by each node", from_0, {{"rays shot", "rays shot"}}, false)};
  if (record.options.strategy == Strategy::svm && std::get<svm::Report>(record.report).pages().faults > 0) {
    plots.push_back(bars_by_node("node_faults", "Pages asked for and served", from_0,
                                 {{"faults", "faults"}, {.title = "pages served", .column = "pages served", .color = 1}}, false));
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
  const std::vector<NamedCategory> categories = categories_of(account);
  std::vector<Column> columns = memory_columns(account);
  columns.push_back({"used", "KiB", 1});
  columns.push_back({"planned", "KiB", 1});
  Table table("Memory of each node", std::move(columns));
  for (std::size_t i = 0; i < account.nodes.size(); ++i) {
    const NodeAccount& node = account.nodes[i];
    std::vector<Cell> row = {std::uint64_t{i}};
    for (const NamedCategory& named : categories) {
      row.emplace_back(kibibytes(node.memory_used[named.category]));
    }
    row.emplace_back(kibibytes(node.memory_used.total()));
    row.emplace_back(kibibytes(node.memory_planned.total()));
    table.add_row(std::move(row));
  }
  return table;
}

Plot memory_plot(const Account& account) {
  return stacked_by_node("memory", "Memory of each node", {.label = "", .least = 0}, memory_columns(account));
}

std::vector<PacketKindTraffic> packets_of(const Account& account) {
  std::vector<PacketKindTraffic> packets;
  for (std::size_t kind = 0; kind < account.kind_names.size(); ++kind) {
    std::string name = account.kind_names[kind];
    std::replace(name.begin(), name.end(), '_', ' ');
    packets.push_back({std::move(name), account.sent[kind]});
  }
  return packets;
}

}  // namespace dmpc::apps::html
