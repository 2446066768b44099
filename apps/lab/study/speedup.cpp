#include "apps/lab/study/speedup.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/run/time_parts.h"
#include "apps/run/report.h"
#include "apps/run/run_strategy.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace {

constexpr double nanosecond = 1e-9;

/// The rows of the table as their runs end.
class Rows {
 public:
  explicit Rows(Table& table) : table_(table) {}

  void add(std::uint32_t node_count, const StudyOutcome& outcome) {
    add_notes(counted(node_count, "node"), outcome, table_);
    if (outcome.report) {
      return add(node_count, account_of(*outcome.report));
    }
    std::vector<Cell> row = {std::uint64_t{node_count}};
    row.resize(table_.columns().size());
    table_.add_row(std::move(row));
  }

 private:
  void add(std::uint32_t node_count, const Account& account) {
    const nodes::VirtualReport& time = *account.virtual_time;
    const double seconds = nanosecond * static_cast<double>(time.total_ns);
    first_ = first_.value_or(seconds * node_count);
    const double efficiency = seconds == 0 ? 1 : *first_ / (seconds * node_count);
    std::vector<Cell> row = {std::uint64_t{node_count}, seconds, efficiency * node_count, 100 * efficiency};
    for (const double percent : parts_of(sum_of_nodes(time), account.waits).percent()) {
      row.emplace_back(percent);
    }
    row.emplace_back(nanosecond * static_cast<double>(time.links.wait_ns));
    row.emplace_back(static_cast<std::uint64_t>(account.node_memory_max_bytes));
    row.emplace_back(hash_text(time.run_hash(account.film.hash())));
    table_.add_row(std::move(row));
  }

  Table& table_;
  std::optional<double> first_;  ///< node-seconds of the first run
};

std::string computer_text(const StrategyOptions& run) {
  const std::string memory =
      run.computer.node_memory_bytes ? nodes::size_text(*run.computer.node_memory_bytes) + " a node" : "as much as it needs";
  return "strategy " + std::string(name_of(run.strategy)) + ", memory " + memory;
}

std::string cache_text(const StrategyOptions& run) {
  const std::string policy = " (" + std::string(svm::name_of(run.pages.replacement)) + ")";
  if (run.pages.cache_pages) {
    return "cache of " + counted(*run.pages.cache_pages, "page") + policy;
  }
  return (run.computer.node_memory_bytes ? "cache of what the memory leaves" : "cache of a quarter of the database") + policy;
}

std::string pages_text(const StrategyOptions& run) {
  svm::PageOptions pages = run.pages;
  pages.in_flight = pages.in_flight.value_or(run.strategy == Strategy::forest ? 16 : 1);
  const std::uint32_t item_side = svm::work_item_side_of(pages, run.strategy != Strategy::forest);
  const std::string side = std::to_string(item_side);
  return (run.strategy == Strategy::svm ? cache_text(run) + ", " : "") + counted(*pages.in_flight, "pixel") + " in flight, " +
         (item_side == 0 ? "no work given away" : "work items of " + side + "x" + side);
}

std::string rays_text(const dataflow::RayOptions& rays) {
  const bool subsampled = rays.balance.balance == dataflow::Balance::subsampled;
  return "regions " + std::string(subsampled ? "by the subsampled picture" : "of equal size") +
         (rays.balance.bsp.order == dataflow::CutOrder::alternating ? " and alternating cuts" : "") + ", mapped onto the machine";
}

}  // namespace

std::vector<Column> SpeedupStudy::columns() const {
  std::vector<Column> columns = {{"nodes"}, {"virtual time", "s", 3}, {"speedup", "", 2}, {"efficiency", "%", 1}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 1});
  }
  columns.insert(columns.end(), {{"link wait", "s", 3}, {"node memory", "bytes"}, {"run hash"}});
  return columns;
}

std::vector<Plot> SpeedupStudy::plots() const {
  const PlotAxis times{.label = "speedup", .scale = PlotScale::powers_of_2};
  const std::string who = std::string(name_of(run.strategy)) + " on " + run.computer.machine->name;
  Plot losses = curves("speedup_losses", "Where the nodes' time goes", "nodes", {}, percent_axis("of the nodes' time"), {});
  losses.is_stacked = true;
  for (const char* part : time_part_names) {
    std::string title = part;
    std::replace(title.begin(), title.end(), '_', ' ');
    losses.series.push_back({std::move(title), part, {}, PlotMark::bars, losses.series.size()});
  }
  return {curves("speedup", "Speedup", "nodes", node_axis(), times, {{who, "speedup"}}),
          curves("speedup_efficiency", "Efficiency", "nodes", node_axis(), percent_axis("efficiency"), {{who, "efficiency"}}),
          std::move(losses)};
}

void SpeedupStudy::measure(StudyRuns& runs, Table& table) const {
  std::vector<StrategyOptions> options(node_counts.size(), run);
  for (std::size_t i = 0; i < options.size(); ++i) {
    options[i].computer.node_count = node_counts[i];
  }
  Rows rows(table);
  runs.run_side_by_side(options, [&](std::size_t i, const StudyOutcome& outcome) { rows.add(node_counts[i], outcome); });
  runs.check();
}

std::vector<std::string> SpeedupStudy::notes(const std::string&) const {
  const std::string what = run.strategy == Strategy::dataflow ? rays_text(run.rays) : pages_text(run);
  return {
      machine_text(*run.computer.machine) + ", " + computer_text(run) + ", " + what + ".",
      "Speedup and efficiency: against the first row with figures, in node-seconds, as if its own efficiency were 100 %.",
      "Parts of the nodes' time, summed over them: they add up to 100 %. data_wait is for pages or rays, work_wait for pixels of "
      "other nodes, stolen and lent serve page requests while there is something else to do and while there is not.",
      "Link wait: that messages stood before links that others held, summed. Node memory: of the fullest node."};
}

}  // namespace dmpc::apps
