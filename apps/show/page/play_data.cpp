#include "apps/show/page/play_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "apps/frontend/run/run_view.h"
#include "apps/frontend/run/work.h"
#include "apps/run/report.h"
#include "apps/show/heat/field.h"
#include "apps/show/page/forecast_view.h"
#include "apps/show/page/path_table.h"
#include "apps/show/page/play_cells.h"
#include "apps/show/page/typed_array.h"
#include "apps/show/stats/stats.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps::html {

namespace {

using core::HeatKind;
using nlohmann::json;
using Counts = std::vector<std::uint64_t>;

constexpr std::size_t pages_max = 256;          ///< limit of the listed hottest pages
constexpr std::size_t over_time_side_max = 96;  ///< pairs of nodes; they then have 295,000 values

std::uint64_t largest(std::span<const std::uint64_t> values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

std::uint64_t sum_of(std::span<const std::uint64_t> values) {
  return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

/// By the clock of the run: the last time recorded anywhere.
std::uint64_t total_ns(const RenderRecord& record, const Account& account) {
  std::uint64_t total = std::max<std::uint64_t>(1, largest(record.heat->values(HeatKind::done)));
  if (account.virtual_time) {
    return std::max(total, account.virtual_time->total_ns);
  }
  for (const NodeAccount& node : account.nodes) {
    total = std::max(total, node.counters.wall_ns);
  }
  return total;
}

/// Rounds up, so that nothing is lit before it is done.
Counts parts_of_run(std::span<const std::uint64_t> done_ns, std::uint64_t total) {
  Counts parts;
  for (const std::uint64_t ns : done_ns) {
    const double part = std::ceil(static_cast<double>(ns) / static_cast<double>(total) * static_cast<double>(done_parts));
    parts.push_back(std::min(done_parts, static_cast<std::uint64_t>(part)));
  }
  return parts;
}

/// Values as they are sent, and the worth of each in the unit of the field.
struct Scaled {
  Counts values;
  double scale = 1;
};

Scaled scaled(HeatKind kind, std::span<const std::uint64_t> values) {
  if (kind != HeatKind::time) {
    return {{values.begin(), values.end()}};
  }
  Scaled nanoseconds{.values = {}, .scale = 1e-3};  // picoseconds, shown in microseconds
  for (const std::uint64_t picoseconds : values) {
    nanoseconds.values.push_back((picoseconds + 500) / 1000);
  }
  return nanoseconds;
}

json fields_of(const RenderRecord& record, const PlayCells& cells) {
  json fields = json::array();
  const std::span<const std::uint64_t> done = record.heat->values(HeatKind::done);
  for (std::size_t number = 0; number < core::heat_kind_names.size(); ++number) {
    const auto kind = static_cast<HeatKind>(number);
    if (!record.heat->has(kind) || kind == HeatKind::done || kind == HeatKind::samples) {
      continue;
    }
    const std::span<const std::uint64_t> values = record.heat->values(kind);
    const Scaled sent = scaled(kind, kind == HeatKind::node    ? cells.of_last(values, done)
                                     : kind == HeatKind::depth ? cells.largest(values)
                                                               : cells.sums(values));
    const HeatMeaning meaning = meaning_of(kind, record.options.strategy);
    fields.push_back({{"name", core::name_of(kind)},
                      {"meaning", meaning.text},
                      {"unit", meaning.unit},
                      {"scale", sent.scale},
                      {"values", typed_array(sent.values)}});
  }
  return fields;
}

/// Appends a node's activity in each step, in 255ths of it; rounding errors carry over to the next step.
template <class Times>
void append_shares(Counts& shares, const std::vector<Times>& steps, std::size_t kind, std::uint64_t step_ns) {
  double due = 0;
  for (const Times& times : steps) {
    due += 255 * static_cast<double>(times[kind]) / static_cast<double>(step_ns);
    const double given = std::clamp(std::round(due), 0.0, 255.0);
    shares.push_back(static_cast<std::uint64_t>(given));
    due -= given;
  }
}

/// Shares by kind of work or wait, without kinds that are all zero. The host, which is the last, is left out.
template <class Times, class NameOf>
json shares_of(const std::vector<std::vector<Times>>& nodes, std::uint64_t step_ns, const NameOf& name_of) {
  json all = json::array();
  for (std::size_t kind = 0; kind < Times{}.size(); ++kind) {
    Counts shares;
    std::uint64_t ns = 0;
    for (const std::vector<Times>& node : std::span(nodes.data(), nodes.size() - 1)) {
      append_shares(shares, node, kind, step_ns);
      for (const Times& times : node) {
        ns += times[kind];
      }
    }
    if (ns > 0) {
      all.push_back({{"name", name_of(kind)}, {"ns", ns}, {"shares", typed_array(shares)}});
    }
  }
  return all;
}

template <class ValueOf>
json column_of(const std::vector<nodes::Waited>& waits, const ValueOf& value_of) {
  Counts values;
  std::transform(waits.begin(), waits.end(), std::back_inserter(values), value_of);
  return typed_array(values);
}

json causes_of(const nodes::WaitRecord& record, std::span<const char* const> kind_names) {
  using nodes::Waited;
  json kinds = json::array();
  for (const char* const name : kind_names) {
    kinds.push_back(packet_text(name));
  }
  const auto column = [&record](const auto& value_of) { return column_of(record.waits, value_of); };
  return {{"kinds", std::move(kinds)},
          {"count", record.count},
          {"left_out_ns", record.left_out_ns_max},
          {"node", column([](const Waited& wait) { return index_of(wait.node); })},
          {"begin", column([](const Waited& wait) { return wait.begin_ns; })},
          {"length", column([](const Waited& wait) { return wait.end_ns - wait.begin_ns; })},
          {"kind", column([](const Waited& wait) { return wait.kind; })},
          {"peer", column([](const Waited& wait) { return index_of(wait.peer); })},
          {"left", column([](const Waited& wait) { return wait.end_ns - wait.left_ns; })},
          {"request", column([&](const Waited& wait) { return wait.request ? std::size_t{*wait.request} : kind_names.size(); })},
          {"from", column([](const Waited& wait) { return index_of(wait.from.node); })},
          {"at", column([](const Waited& wait) { return wait.end_ns - wait.from.time_ns; })}};
}

json path_of(const nodes::CriticalPath& critical, std::span<const char* const> kind_names) {
  const nodes::PathTimes& path = critical.times;
  json parts = json::array(), kinds = json::array();
  for (const auto& [name, ns] : path_parts(path)) {
    parts.push_back({{"name", name}, {"ns", ns}});
  }
  for (std::size_t kind = 0; kind < kind_names.size(); ++kind) {
    if (path.by_kind_ns[kind] > 0) {
      kinds.push_back({{"name", packet_text(kind_names[kind])}, {"ns", path.by_kind_ns[kind]}});
    }
  }
  return {{"messages", path.messages},
          {"node", index_of(critical.from.node)},
          {"from_ns", critical.from.time_ns},
          {"parts", std::move(parts)},
          {"kinds", std::move(kinds)}};
}

void add_causes(json& head, const RunView& view, const Account& account) {
  if (view.waits) {
    head["causes"] = causes_of(*view.waits, account.kind_names);
  }
  if (account.virtual_time && account.virtual_time->critical_path) {
    head["path"] = path_of(*account.virtual_time->critical_path, account.kind_names);
  }
}

/// Returns the positions of nodes for a drawing.
json topology_of(const nodes::Machine& machine, std::uint32_t node_count) {
  const nodes::Topology topology(machine.topology, node_count, machine.uplinks);
  return {{"kind", name_of(machine.topology)}, {"columns", topology.columns()}, {"uplinks", machine.uplinks}};
}

/// Returns all counts, or the positions and values of those other than 0, whichever takes less.
json pairs_of(std::span<const std::uint64_t> counts, json head) {
  Counts places, there;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    if (counts[place] > 0) {
      places.push_back(place);
      there.push_back(counts[place]);
    }
  }
  json all = typed_array(counts), where = typed_array(places), some = typed_array(there);
  const auto size = [](const json& array) { return array["data"].get_ref<const std::string&>().size(); };
  head["side"] = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(counts.size()))));
  if (size(where) + size(some) < size(all)) {
    head["places"] = std::move(where);
    head["counts"] = std::move(some);
  } else {
    head["counts"] = std::move(all);
  }
  return head;
}

json links_of(const Account& account) {
  json links = json::array();
  if (account.virtual_time) {
    for (const nodes::LinkUse& link : account.virtual_time->busiest_links) {
      links.push_back({link.from, link.to, link.messages, link.bytes, link.busy_ns, link.wait_ns});
    }
  }
  return links;
}

json pages_of(const svm::Fetches& fetches) {
  std::vector<std::uint32_t> numbers(fetches.by_page.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::erase_if(numbers, [&](std::uint32_t page) { return fetches.by_page[page] == 0; });
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return fetches.by_page[a] > fetches.by_page[b]; });
  numbers.resize(std::min(numbers.size(), pages_max));
  json pages = json::array();
  for (const std::uint32_t page : numbers) {
    pages.push_back({page, fetches.home_of(page), fetches.by_page[page]});
  }
  return pages;
}

/// Rows of steps, in 255ths of the largest of all: 255 is `most`.
json steps_of(const nodes::StepCounts& counts, const std::vector<std::span<const std::uint64_t>>& rows, std::uint64_t total) {
  const std::size_t steps = std::min<std::size_t>(counts.step_count_max(), (total + counts.step_ns() - 1) / counts.step_ns());
  const std::uint64_t most =
      core::max_over(rows, std::uint64_t{1}, [&](const std::span<const std::uint64_t> row) { return largest(row); });
  Counts values;
  for (const std::span<const std::uint64_t> row : rows) {
    for (std::size_t step = 0; step < steps; ++step) {
      values.push_back(row.empty()  ? 0
                       : most < 256 ? row[step]
                                    : (row[step] * 255 + most - 1) / most);  // keeps values other than 0
                                                                             // above 0
    }
  }
  return {{"step_ns", counts.step_ns()},
          {"steps", steps},
          {"most", std::max<std::uint64_t>(most, 255)},
          {"values", typed_array(values)}};
}

json link_steps(const nodes::ExchangeProfile& exchange, const nodes::VirtualReport& report) {
  const std::vector<std::span<const std::uint64_t>> rows = core::mapped<std::span<const std::uint64_t>>(
      report.busiest_links, [&](const nodes::LinkUse& link) { return exchange.link_bytes(link.from, link.to); });
  return steps_of(exchange.links(), rows, report.total_ns);
}

/// Steps of the first `side` of `peer_count` nodes and a host.
json pair_steps(const nodes::ExchangeProfile& exchange, std::size_t peer_count, std::size_t side, std::uint64_t total) {
  std::vector<std::span<const std::uint64_t>> rows;
  for (std::size_t i = 0; i < side * side; ++i) {
    rows.push_back(exchange.pairs().row(static_cast<std::uint32_t>(i / side * peer_count + i % side)));
  }
  return steps_of(exchange.pairs(), rows, total);
}

json level_steps(const nodes::ExchangeProfile& exchange, std::uint64_t total) {
  json levels = json::array();
  for (std::size_t level = 0; level < exchange.level_names().size(); ++level) {
    const Counts sums = exchange.level_sums(level);
    json steps = steps_of(exchange.levels(), {sums}, total);
    steps["name"] = exchange.level_names()[level];
    levels.push_back(std::move(steps));
  }
  return levels;
}

/// `head` has pairs and pages, if there are any.
void add_over_time(json& head, const nodes::ExchangeProfile& exchange, const nodes::VirtualReport& report) {
  json over = {{"links", link_steps(exchange, report)}, {"levels", level_steps(exchange, report.total_ns)}};
  if (head.contains("pairs") && exchange.pairs().is_complete() && head["pairs"]["side"] <= over_time_side_max) {
    over["pairs"] = pair_steps(exchange, report.nodes.size(), head["pairs"]["side"], report.total_ns);
    over["pairs"]["what"] = head["pairs"]["what"] == "pages" ? "pages" : "packets of rays";
  }
  if (!head["pages"].empty()) {
    const std::vector<std::span<const std::uint64_t>> rows = core::mapped<std::span<const std::uint64_t>>(
        head["pages"], [&](const json& page) { return exchange.numbers().row(page[0]); });
    over["pages"] = steps_of(exchange.numbers(), rows, report.total_ns);
  }
  head["over"] = std::move(over);
}

void add_exchange(json& head, const RenderRecord& record) {
  if (const auto& fetches = record.view->fetches) {
    head["pairs"] = pairs_of(fetches->by_pair, {{"what", "pages"}, {"row", "node that asks"}, {"column", "home of the page"}});
    head["pages"] = pages_of(*fetches);
    if (const std::optional<ForecastView> forecast = forecast_view(record)) {
      head["forecast"] = json_of(*forecast);
    }
    head["fetched"] = sum_of(fetches->by_page);
  } else if (const auto* const rays = std::get_if<dataflow::Report>(&record.report)) {
    head["pairs"] =
        pairs_of(rays->ray_matrix(), {{"what", "rays"}, {"row", "node that sends"}, {"column", "owner that receives"}});
  }
}

/// Leaves out its lists: each has a figure or more for each node or link, which are in other parts of the data.
json stats_of(const RenderRecord& record) {
  json stats = json::parse(stats_json(record));
  for (const char* const list : {"nodes", "ranks", "pairs", "heat_maps"}) {
    stats.erase(list);
  }
  if (stats["links"].is_object()) {
    stats["links"].erase("rows");
  }
  return stats;
}

}  // namespace

json play_data(const RenderRecord& record, const Origin& origin) {
  core::expect(record.view != nullptr && record.heat != nullptr && record.heat->has(HeatKind::done),
               "what is played was recorded");
  const Account account = account_of(record.report);
  const PlayCells cells(account.film.width(), account.film.height(), play_cells_max);
  const std::uint64_t total = total_ns(record, account);
  const nodes::ActivitySteps& steps = record.view->steps;
  json head = {{"format", play_format},
               {"scene", record.options.picture.scene},
               {"computer", computer_text(record)},
               {"clock", account.virtual_time ? "virtual time" : "wall clock"},
               {"total_ns", total},
               {"words", origin.words},
               {"nodes", account.nodes.size()},
               {"step_ns", steps.step_ns},
               {"steps", steps.nodes.front().size()},
               {"width", account.film.width()},
               {"height", account.film.height()},
               {"cell", cells.side()},
               {"wide", cells.wide()},
               {"high", cells.high()},
               {"done", typed_array(parts_of_run(cells.largest(record.heat->values(HeatKind::done)), total))},
               {"fields", fields_of(record, cells)},
               {"works", shares_of(steps.nodes, steps.step_ns, [](std::size_t work) { return work_names[work]; })},
               {"waits", shares_of(steps.waits, steps.step_ns,
                                   [&](std::size_t wait) { return words_of(wait_parts.at(wait), account.waits); })},
               {"links", links_of(account)},
               {"pages", json::array()}};
  if (const auto& machine = record.options.computer.machine) {
    head["topology"] = topology_of(*machine, static_cast<std::uint32_t>(account.nodes.size()));
  }
  add_causes(head, *record.view, account);
  add_exchange(head, record);
  if (record.view->exchange) {
    add_over_time(head, *record.view->exchange, *account.virtual_time);
  }
  head["stats"] = stats_of(record);
  return head;
}

}  // namespace dmpc::apps::html
