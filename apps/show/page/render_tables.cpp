#include "apps/show/page/render_tables.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "apps/line/number_text.h"
#include "apps/run/memory_categories.h"
#include "apps/run/time_parts.h"

namespace dmpc::apps::html {

namespace {

/// Of the links of a machine; `--stats` has more.
constexpr std::size_t link_rows_max = 64;

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

/// Bars side by side, or upon one another.
Plot bars_by_node(std::string name, std::string title, PlotAxis y, std::vector<PlotSeries> series, bool is_stacked) {
  for (PlotSeries& one : series) {
    one.mark = PlotMark::bars;
  }
  Plot plot = curves(std::move(name), std::move(title), "node", {.label = "node"}, std::move(y), std::move(series));
  plot.is_stacked = is_stacked;
  return plot;
}

/// The columns from the second on, upon one another.
std::vector<PlotSeries> series_of(const std::vector<Column>& columns) {
  std::vector<PlotSeries> series;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    series.push_back({.title = columns[i].name, .column = columns[i].name, .color = (i - 1) % plot_color_count});
  }
  return series;
}

/// Numbers of the parts of which any node has some; computing is always among them.
std::vector<std::size_t> parts_found(const nodes::VirtualReport& report, const WaitKinds& waits) {
  const TimeParts all = parts_of(sum_of_nodes(report), waits);
  std::vector<std::size_t> found;
  for (std::size_t part = 0; part < time_part_count; ++part) {
    if (all.ns[part] > 0 || part == static_cast<std::size_t>(TimePart::computing)) {
      found.push_back(part);
    }
  }
  return found;
}

/// What nodes' time is made of, in words.
std::vector<std::string> part_names(const Account& account) {
  if (!account.virtual_time) {
    return {"computing", "asleep", "waiting for a core"};
  }
  std::vector<std::string> names;
  for (const std::size_t part : parts_found(*account.virtual_time, account.waits)) {
    names.push_back(words_of(static_cast<TimePart>(part), account.waits));
  }
  return names;
}

std::vector<std::uint64_t> parts_of_node(const Account& account, std::size_t node) {
  if (account.virtual_time) {
    const TimeParts all = parts_of(account.virtual_time->nodes[node], account.waits);
    std::vector<std::uint64_t> parts;
    for (const std::size_t part : parts_found(*account.virtual_time, account.waits)) {
      parts.push_back(all.ns[part]);
    }
    return parts;
  }
  const nodes::NodeCounters& counters = account.nodes[node].counters;
  const std::uint64_t known_ns = counters.busy_ns + counters.asleep_ns;
  return {counters.busy_ns, counters.asleep_ns, counters.wall_ns - std::min(counters.wall_ns, known_ns)};
}

void add_shares(Table& table, const std::string& name, std::span<const std::uint64_t> parts) {
  std::vector<Cell> row = {name};
  for (const double percent : percent_parts(parts)) {
    row.emplace_back(percent);
  }
  table.add_row(std::move(row));
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

double kibibytes(std::size_t bytes) { return static_cast<double>(bytes) / 1024; }

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

Table loss_table(const Account& account) {
  std::vector<Column> columns = {{"node", "", 0}};
  for (const std::string& name : part_names(account)) {
    columns.push_back({name, "%", 1});
  }
  Table table("Where each node's time went", columns);
  std::vector<std::uint64_t> sum(columns.size() - 1);
  for (std::size_t i = 0; i < account.nodes.size(); ++i) {
    const std::vector<std::uint64_t> parts = parts_of_node(account, i);
    std::transform(sum.begin(), sum.end(), parts.begin(), sum.begin(), std::plus());
    add_shares(table, std::to_string(i), parts);
  }
  add_shares(table, "all", sum);
  table.add_note(account.virtual_time
                     ? "Virtual time. Stolen and lent: others' requests served while there was something else to do, and while "
                       "there was not."
                     : "Wall clock of the nodes' threads. Asleep: for want of packets. They share this computer's cores.");
  return table;
}

Plot loss_plot(const Account& account) {
  return bars_by_node("losses", "Where each node's time went", {.label = "of its time (%)", .least = 0, .most = 100},
                      series_of(loss_table(account).columns()), true);
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
  return bars_by_node("memory", "Memory of each node", {.label = "", .least = 0}, series_of(memory_columns(account)), true);
}

Table packet_table(const Account& account) {
  Table table("Packets by kind", {{"kind", "", 0}, {"packets", "", 0}, {"carried", "bytes", 0}, {"of all bytes", "%", 1}});
  std::vector<std::uint64_t> bytes;
  for (const nodes::Traffic& traffic : account.sent) {
    bytes.push_back(traffic.bytes);
  }
  const std::vector<double> percent = percent_parts(bytes);
  for (std::size_t kind = 0; kind < account.kind_names.size(); ++kind) {
    if (account.sent[kind].packets > 0) {
      std::string name = account.kind_names[kind];
      std::replace(name.begin(), name.end(), '_', ' ');
      table.add_row({std::move(name), account.sent[kind].packets, account.sent[kind].bytes, percent[kind]});
    }
  }
  return table;
}

Table rank_table(const Account& account) {
  Table table("Ranks", {{"rank", "", 0},
                        {"nodes", "", 0},
                        {"network memory", "KiB", 1},
                        {"packets sent", "", 0},
                        {"packets received", "", 0},
                        {"frames sent", "", 0},
                        {"sent", "bytes", 0},
                        {"clock wrong by at most", "us", 1}});
  for (const nodes::RankFigures& rank : account.ranks) {
    table.add_row({rank.name, std::uint64_t{rank.memory.node_count}, kibibytes(rank.memory.network.total()),
                   rank.traffic.packets_sent, rank.traffic.packets_received, rank.traffic.frames_sent, rank.traffic.bytes_sent,
                   static_cast<double>(rank.clock.error_ns()) / 1000});
  }
  return table;
}

Table link_table(const nodes::VirtualReport& report) {
  Table table("The busiest links", {{"link", "", 0},
                                    {"messages", "", 0},
                                    {"carried", "bytes", 0},
                                    {"held", "ms", 3},
                                    {"held in all", "%", 1},
                                    {"waited for", "ms", 3}});
  const std::size_t count = std::min(report.busiest_links.size(), link_rows_max);
  for (const nodes::LinkUse& link : std::span(report.busiest_links).first(count)) {
    const auto milliseconds = [](std::uint64_t ns) { return static_cast<double>(ns) / 1e6; };
    const double share =
        report.total_ns == 0 ? 0 : 100 * static_cast<double>(link.busy_ns) / static_cast<double>(report.total_ns);
    table.add_row(
        {link.from + " to " + link.to, link.messages, link.bytes, milliseconds(link.busy_ns), share, milliseconds(link.wait_ns)});
  }
  if (report.links_used > count) {
    table.add_note(std::to_string(count) + " of " + std::to_string(report.links_used) + " links that carried anything.");
  }
  return table;
}

Plot link_plot() {
  Plot plot = bars_by_node("links", "Traffic of the busiest links", {.label = "", .least = 0}, {{"carried", "carried"}}, false);
  plot.places = {"link"};
  plot.x = {};
  return plot;
}

}  // namespace dmpc::apps::html
