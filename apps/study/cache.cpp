#include "apps/study/cache.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "apps/line/number_text.h"
#include "apps/run/run_strategy.h"
#include "apps/system/side_by_side.h"
#include "apps/table/geometric_sizes.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "svm/packets.h"
#include "svm/run.h"
#include "svm/watch/miss_curve.h"
#include "svm/watch/optimum.h"
#include "svm/watch/policy_misses.h"

namespace dmpc::apps {
namespace {

using svm::Replacement;
using Sizes = std::vector<std::uint32_t>;

constexpr std::uint32_t standard_size_count = 12;

/// Those beside lru, whose misses are known for all sizes at once, in the order of their columns.
std::vector<Replacement> other_policies() {
  std::vector<Replacement> policies;
  for (std::size_t i = 0; i < svm::policy_kinds().size(); ++i) {
    if (const auto policy = static_cast<Replacement>(i); policy != Replacement::lru) {
      policies.push_back(policy);
    }
  }
  return policies;
}

/// Where a row's cells are. Behind the other policies come the optimum, and what is timed.
enum At : std::size_t { cache_pages_at, share_at, miss_ratio_at, lru_at, first_policy_at };

/// svm on a machine, one pixel at a time on each node as the 1994 paper's nodes worked.
StrategyOptions one_at_a_time(std::uint32_t node_count, const nodes::Machine& machine) {
  StrategyOptions options{.computer = {.node_count = node_count}, .pages = {.in_flight = 1}};
  choose_machine(options, machine);
  return options;
}

/// All references, which depend on neither cache nor machine, so any machine will do: the default one takes no time.
svm::RunOptions recording(std::uint32_t node_count) {
  return {.computer = {.node_count = node_count, .machine = nodes::Machine()},
          .pages = {.in_flight = 1, .work_item_side = 0, .record_references = true}};
}

/// What follows from the references.
struct Curves {
  svm::MissCurve lru;
  /// By size: of each of the other policies, then of the optimum.
  std::vector<std::vector<std::uint64_t>> faults;
  std::uint64_t references = 0;  ///< of pages at home, too, and repeated ones
};

/// For one node: of each size each policy's misses, then the optimum's.
std::vector<std::vector<std::uint64_t>> faults_of(std::span<const svm::PageId> references, std::uint32_t node, const Sizes& sizes,
                                                  const StudyRuns& runs) {
  const svm::Optimum optimum(references);
  std::vector<std::vector<std::uint64_t>> faults;
  for (const std::uint32_t size : sizes) {
    std::vector<std::uint64_t>& row = faults.emplace_back();
    for (const Replacement policy : other_policies()) {
      runs.check();
      row.push_back(svm::policy_misses(policy, references, size, node));
    }
    row.push_back(optimum.misses(size));
  }
  return faults;
}

void add(const std::vector<std::vector<std::uint64_t>>& more, std::vector<std::vector<std::uint64_t>>& sums) {
  for (std::size_t row = 0; row < sums.size(); ++row) {
    std::transform(more[row].begin(), more[row].end(), sums[row].begin(), sums[row].begin(), std::plus());
  }
}

Curves curves_of(const svm::Report& recorded, const Sizes& sizes, const StudyRuns& runs) {
  Curves curves{.faults = {sizes.size(), std::vector<std::uint64_t>(other_policies().size() + 1)},
                .references = recorded.pages().references};
  side_by_side(recorded.nodes.size(), [&](std::size_t node) -> std::function<void()> {
    const std::span<const svm::PageId> references = recorded.nodes[node].references.pages();
    return [&curves, faults = faults_of(references, static_cast<std::uint32_t>(node), sizes, runs),
            lru = svm::MissCurve(references)] {
      curves.lru += lru;
      add(faults, curves.faults);
    };
  });
  return curves;
}

/// The rows of the table on their way: each is added if all of its runs have ended.
class Sweep {
 public:
  Sweep(const CacheStudy& study, const Sizes& sizes, std::uint32_t page_count, const Curves& curves, Table& table)
      : node_count_(study.node_count), table_(table) {
    for (std::size_t row = 0; row < sizes.size(); ++row) {
      begin_row(sizes[row], page_count, curves, curves.faults[row]);
      if (study.machine) {
        if (row == 0) {
          add_job(one_at_a_time(1, *study.machine), [this](const svm::Report& report) { one_node_ns_ = total_ns(report); });
        }
        add_timed(sizes[row], *study.machine);
      }
      rows_.back().cells.resize(table.columns().size());
    }
  }
  Sweep(const Sweep&) = delete;
  Sweep& operator=(const Sweep&) = delete;

  /// After a signal or an error, too, the table has the rows whose runs had all ended.
  void carry_out(StudyRuns& runs) {
    try {
      run_jobs(runs);
    } catch (...) {
      add_finished_rows();
      throw;
    }
    add_finished_rows();
  }

 private:
  struct Job {
    std::size_t row;  ///< that needs it
    StrategyOptions options;
    std::function<void(const svm::Report&)> take;
  };
  struct Row {
    std::vector<Cell> cells;
    std::size_t jobs_left = 0;
  };

  void run_jobs(StudyRuns& runs) {
    std::vector<StrategyOptions> options;
    for (const Job& job : jobs_) {
      options.push_back(job.options);
    }
    runs.run_side_by_side(options, [this](std::size_t index, const StudyOutcome& outcome) {
      if (!outcome.report) {
        throw core::InputError(outcome.misfit);
      }
      jobs_[index].take(std::get<svm::Report>(*outcome.report));
      --rows_[jobs_[index].row].jobs_left;
    });
  }

  void add_finished_rows() {
    for (const Row& row : rows_) {
      if (row.jobs_left == 0) {
        table_.add_row(row.cells);
      }
    }
  }

  static std::uint64_t total_ns(const svm::Report& report) { return report.virtual_time->total_ns; }

  /// For the row begun last.
  void add_job(StrategyOptions options, std::function<void(const svm::Report&)> take) {
    jobs_.push_back({rows_.size() - 1, std::move(options), std::move(take)});
    ++rows_.back().jobs_left;
  }

  void begin_row(std::uint32_t cache_pages, std::uint32_t page_count, const Curves& curves,
                 const std::vector<std::uint64_t>& faults) {
    const std::uint64_t misses = curves.lru.misses(cache_pages);
    std::vector<Cell>& row = rows_.emplace_back(Row{std::vector<Cell>(first_policy_at)}).cells;
    row[cache_pages_at] = std::uint64_t{cache_pages};
    row[share_at] = percent_of<std::uint64_t>(cache_pages, page_count);
    row[miss_ratio_at] = percent_of<std::uint64_t>(misses, curves.references);
    row[lru_at] = misses;
    row.insert(row.end(), faults.begin(), faults.end());
    time_at_ = row.size();
  }

  void add_timed(std::uint32_t cache_pages, const nodes::Machine& machine) {
    StrategyOptions options = one_at_a_time(node_count_, machine);
    options.pages.cache_pages = cache_pages;
    add_job(options, [this, row = rows_.size() - 1](const svm::Report& report) { fill_times(rows_[row].cells, report); });
  }

  void fill_times(std::vector<Cell>& row, const svm::Report& report) const {
    const double seconds = static_cast<double>(total_ns(report)) * 1e-9;
    const std::uint64_t page_bytes = report.sent()[svm::number_of(svm::Kind::page_reply)].bytes;
    const bool takes_time = total_ns(report) > 0;
    row[time_at_] = seconds;
    row[time_at_ + 1] =
        takes_time && one_node_ns_ ? Cell(percent_of<std::uint64_t>(*one_node_ns_, node_count_ * total_ns(report))) : Cell();
    row[time_at_ + 2] =
        takes_time ? Cell(static_cast<std::uint64_t>(static_cast<double>(page_bytes) / node_count_ / seconds)) : Cell();
  }

  std::uint32_t node_count_;
  Table& table_;
  std::optional<std::uint64_t> one_node_ns_;
  std::size_t time_at_ = 0;  ///< where a row's cells of what is timed are
  std::vector<Row> rows_;
  std::vector<Job> jobs_;  ///< in the order of their rows
};

std::string needs_note(const svm::MissCurve& lru) {
  if (lru.references() == 0) {
    return "No node references a page of another.";
  }
  return "The node that references most has to do with " + counted(lru.distinct_pages(), "different page") + " of others; from " +
         counted(std::max(lru.sufficient_pages(), 1U), "frame") + " on lru faults on each page's first reference only, " +
         counted(lru.cold_misses(), "time") + " in all.";
}

}  // namespace

std::vector<Column> CacheStudy::columns() const {
  std::vector<Column> columns = {{"cache pages"}, {"share of database", "%", 2}, {"misses lru", "%", 4}, {"faults lru"}};
  for (const Replacement policy : other_policies()) {
    columns.push_back({"faults " + std::string(svm::name_of(policy))});
  }
  columns.push_back({"faults optimum"});
  if (machine) {
    columns.insert(columns.end(), {{"virtual time", "s", 3}, {"efficiency", "%", 2}, {"page traffic a node", "bytes/s"}});
  }
  return columns;
}

std::vector<Plot> CacheStudy::plots() const {
  const PlotAxis sizes{.label = "cache of a node (pages)", .scale = PlotScale::powers_of_10};
  const PlotAxis count{.label = "faults", .scale = PlotScale::powers_of_10}, rate{.label = "", .least = 0};
  std::vector<PlotSeries> policies = {{"lru", "faults lru"}};
  for (const Replacement policy : other_policies()) {
    const std::string policy_name(svm::name_of(policy));
    policies.push_back({.title = policy_name, .column = "faults " + policy_name, .color = policies.size()});
  }
  policies.push_back({.title = "optimum", .column = "faults optimum", .color = policies.size()});
  std::vector<Plot> plots = {curves("cache_faults", "Page faults", "cache pages", sizes, count, std::move(policies))};
  if (machine) {
    plots.push_back(curves("cache_efficiency", "Efficiency", "cache pages", sizes, percent_axis("efficiency"),
                           {{"on " + machine->name, "efficiency"}}));
    plots.push_back(curves("cache_traffic", "Pages received by a node", "cache pages", sizes, rate,
                           {{"on " + machine->name, "page traffic a node"}}));
  }
  return plots;
}

void CacheStudy::measure(StudyRuns& runs, Table& table) const {
  svm::Report recorded = runs.run(std::to_string(node_count) + " nodes, recording", recording(node_count));
  const std::uint32_t page_count = recorded.plan.request.page_count;
  const Sizes sizes =
      cache_pages.empty() ? geometric_sizes(page_count - page_count / node_count, standard_size_count) : cache_pages;
  const Curves curves = curves_of(recorded, sizes, runs);
  recorded = {.film = core::Film(1, 1)};  // the references take much memory
  Sweep(*this, sizes, page_count, curves, table).carry_out(runs);
  table.add_note(needs_note(curves.lru));
  runs.check();
}

std::vector<std::string> CacheStudy::notes(const std::string& scene) const {
  std::vector<std::string> notes = {
      std::to_string(node_count) + " nodes. Share of database: the cache of one node over all pages.",
      "Faults and misses: pixels shared out beforehand, one in flight on a node, so that all policies see the same references "
      "and every miss is a fault. Misses are given as a share of all references, pages at home included.",
      "Lru: from the stack distances of one run's references (Mattson, Gecsei, Slutz and Traiger, 1970). Other policies: by a "
      "cache of each size, fed with these references. Optimum: the page that leaves is the one needed last (Belady, 1966)."};
  if (machine) {
    notes.push_back(
        "Virtual time, efficiency against one node with all pages at home, and bytes of pages received a node and "
        "second: the machine " +
        machine->name + ", lru, one pixel in flight, work items of 3x3.");
  }
  const auto scene_name = core::find_scene_name(scene);
  if (scene_name && scene_name->text() == "rings-4-t1") {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Rings4 on 32 nodes of an iPSC/2 that efficiency stays above 50 % with "
        "larger caches only, and that the communication rate peaks at 204 pages, at about 70 % of 0.9 MB/s, and falls with "
        "less.");
  } else if (scene_name && scene_name->text() == "tetra-9") {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Tetra9 on 32 nodes of an iPSC/2 that a small cache is enough.");
  }
  return notes;
}

}  // namespace dmpc::apps
