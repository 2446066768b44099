// The study `speedup`: how much faster a modelled machine gets with more nodes, and where the remaining time goes.
#include "apps/lab/study/studies.h"

#include <optional>
#include <string_view>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/engine/time_part_columns.h"
#include "apps/run/run_strategy.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace {

constexpr double nanosecond = 1e-9;

/// The result of a run on this many nodes.
struct SpeedupRow {
  std::uint32_t node_count;
  std::optional<Account> account = {};  ///< nothing if the scene does not fit
  double first_node_seconds = 0;        ///< of the first run that has an account

  double seconds() const { return nanosecond * static_cast<double>(account->virtual_time->total_ns); }
  double efficiency() const { return seconds() == 0 ? 1 : first_node_seconds / (seconds() * node_count); }
};

const FilledColumns<SpeedupRow>& speedup_columns() {
  using Row = SpeedupRow;
  static const FilledColumns<Row> all = [] {
    const auto of_run = [](auto cell) { return only_if([](const Row& row) { return row.account.has_value(); }, cell); };
    FilledColumns<Row> columns = {{{"nodes"}, [](const Row& row) { return std::uint64_t{row.node_count}; }},
                                  {{"virtual time", "s", 3}, of_run([](const Row& row) { return row.seconds(); })},
                                  {{"speedup", "", 2}, of_run([](const Row& row) { return row.efficiency() * row.node_count; })},
                                  {{"efficiency", "%", 1}, of_run([](const Row& row) { return 100 * row.efficiency(); })}};
    add_time_parts(
        1, [](const Row& row) { return row.account ? std::optional(parts_of(*row.account)) : std::nullopt; }, columns);
    columns.push_back({{"link wait", "s", 3}, of_run([](const Row& row) {
                         return nanosecond * static_cast<double>(row.account->virtual_time->links.wait_ns);
                       })});
    columns.push_back(
        {{"node memory", "bytes"}, of_run([](const Row& row) { return std::uint64_t{row.account->node_memory_max_bytes}; })});
    columns.push_back({{"run hash"}, of_run([](const Row& row) {
                         return hash_text(row.account->virtual_time->run_hash(row.account->film.hash()));
                       })});
    return columns;
  }();
  return all;
}

std::string computer_text(const StrategyOptions& run) {
  const std::string memory =
      run.computer.node_memory_bytes ? nodes::size_text(*run.computer.node_memory_bytes) + " a node" : "as much as it needs";
  return "strategy " + std::string(name_of(run.strategy)) + ", memory " + memory;
}

std::string cache_text(const StrategyOptions& run) {
  const std::string policy = " (" + std::string(svm::policy_name(run.pages)) + ")";
  if (run.pages.cache_pages) {
    return "cache of " + counted(*run.pages.cache_pages, "page") + policy;
  }
  return (run.computer.node_memory_bytes ? "cache of what the memory leaves" : "cache of a quarter of the database") + policy;
}

std::string pages_text(const StrategyOptions& run) {
  const std::string in_flight = run.pages.in_flight ? counted(*run.pages.in_flight, "pixel") : in_flight_text(run.strategy);
  const std::uint32_t item_side = svm::work_item_side_of(run.pages, run.pages.bundles_on_machines);
  const std::string side = std::to_string(item_side);
  return (run.strategy == Strategy::svm ? cache_text(run) + ", " : "") + in_flight + " in flight, " +
         (item_side == 0 ? "no work given away" : "work items of " + side + "x" + side);
}

std::string rays_text(const dataflow::RayOptions& rays) {
  const bool subsampled = rays.balance.balance == dataflow::Balance::subsampled;
  return "regions " + std::string(subsampled ? "by the subsampled picture" : "of equal size") +
         (rays.balance.bsp.order == dataflow::CutOrder::alternating ? " and alternating cuts" : "") + ", mapped onto the machine";
}

}  // namespace

void SpeedupStudy::add_options(StudyLine line) {
  add_node_counts(line.set, node_counts);
  add_strategy_option(line.set, run.strategy);
  add_memory_option(line.set, run.computer.node_memory_bytes);
  add_machine_option(line.set, run.runner.machine_name, "");
  add_page_options(line.set, run, "1");
  add_ray_options(line.set, run.rays);
  line.set.check_in_the_end([this, set = line.set, &file = line.machine_name, &database = line.database] {
    file = run.runner.machine_name;
    settle_database(set, run.strategy, database);
    check_together(set, run);
    choose_machine(run);
  });
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study speedup rings-4-t1\n"
      "  dmpc study speedup rings-4-t1 --node-memory=1MiB --replacement=clock --in-flight=4 --format=csv -o rings.csv\n"
      "  dmpc study speedup teapot-12 --strategy=dataflow --machine=hdr --nodes=1,16,256,1024\n"
      "A number of nodes whose memory cannot hold the scene has a row without figures, and a note that says what would do.\n"
      "If none can, the exit status is 4.");
}

void SpeedupStudy::load(const std::function<void()>& check) { load_policy(run, check); }

std::vector<Column> SpeedupStudy::columns() const { return heads_of(speedup_columns()); }

std::vector<Plot> SpeedupStudy::plots() const {
  const PlotAxis times{.label = "speedup", .scale = PlotScale::powers_of_2};
  const std::string who = std::string(name_of(run.strategy)) + " on " + run.computer.machine->name;
  Plot losses = curves("speedup_losses", "Where the nodes' time goes", "nodes", {}, percent_axis("of the nodes' time"), {});
  losses.is_stacked = true;
  for (const char* part : time_part_names) {
    losses.series.push_back({time_part_words(part), part, {}, PlotMark::bars, losses.series.size()});
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
  std::optional<double> first;
  runs.run_side_by_side(options, [&](std::size_t i, const StudyOutcome& outcome) {
    SpeedupRow row{node_counts[i]};
    add_notes(counted(row.node_count, "node"), outcome, table);
    if (outcome.report) {
      row.account.emplace(account_of(*outcome.report));
      first = first.value_or(row.seconds() * row.node_count);
      row.first_node_seconds = *first;
    }
    table.add_row(row_of(speedup_columns(), row));
  });
  runs.check();
}

std::vector<std::string> SpeedupStudy::notes(const std::string&) const {
  const std::string what = run.strategy == Strategy::dataflow ? rays_text(run.rays) : pages_text(run);
  return {machine_text(*run.computer.machine) + ", " + computer_text(run) + ", " + what + ".",
          "Speedup and efficiency: against the first row with figures, in node-seconds, as if its own efficiency were 100 %.",
          "Parts of the nodes' time, summed over them: they add up to 100 %. data_wait is for pages or rays, starvation for "
          "pixels of "
          "other nodes, token_wait for the token that finds out whether all rays have ended, service_busy and service_idle serve "
          "page requests "
          "while there is something else to do and while there is not.",
          "Link wait: that messages stood before links that others held, summed. Node memory: of the fullest node."};
}

std::string SpeedupStudy::conclusion(const Table& table) const {
  const auto* const last = last_with(table, {"nodes", "speedup", "efficiency"});
  if (last == nullptr) {
    return "";
  }
  std::string largest;
  double share = 0;
  for (const char* const part : time_part_names) {
    const double percent = number_in(table, *last, part).value_or(0);
    if (std::string_view(part) != "computing" && percent > share) {
      largest = time_part_words(part);
      share = percent;
    }
  }
  return "On " + nodes_text(table, *last) + " the speedup is " + fixed(*number_in(table, *last, "speedup"), 1) +
         ", an efficiency of " + percent_text(*number_in(table, *last, "efficiency")) +
         (largest.empty() ? "." : "; the largest loss is " + largest + ", " + percent_text(share) + " of the nodes' time.");
}

}  // namespace dmpc::apps
