#include "apps/lab/study/cache.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/geometric_sizes.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/run/run_strategy.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "svm/packets.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

using Sizes = std::vector<std::uint32_t>;

constexpr std::uint32_t standard_size_count = 12;

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

/// The rows of the table on their way: each is added if all of its runs have ended.
class Sweep {
 public:
  Sweep(const CacheStudy& study, const Sizes& sizes, std::uint32_t page_count, const CacheCurves& curves, Table& table)
      : node_count_(study.node_count), table_(table) {
    for (std::size_t row = 0; row < sizes.size(); ++row) {
      begin_row(curves.row(row, page_count));
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

  void begin_row(std::vector<Cell> cells) {
    time_at_ = cells.size();
    rows_.push_back({std::move(cells)});
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

std::vector<CacheCurves::NodeReferences> references_of(const svm::Report& recorded) {
  std::vector<CacheCurves::NodeReferences> references;
  for (const svm::NodeReport& node : recorded.nodes) {
    references.push_back(node.references.pages());
  }
  return references;
}

}  // namespace

std::vector<Column> CacheStudy::columns() const {
  std::vector<Column> columns = CacheCurves::columns("share of database");
  if (machine) {
    columns.insert(columns.end(), {{"virtual time", "s", 3}, {"efficiency", "%", 2}, {"page traffic a node", "bytes/s"}});
  }
  return columns;
}

std::vector<Plot> CacheStudy::plots() const {
  const PlotAxis rate{.label = "", .least = 0};
  std::vector<Plot> plots = {CacheCurves::plot()};
  if (machine) {
    plots.push_back(curves("cache_efficiency", "Efficiency", "cache pages", CacheCurves::size_axis(), percent_axis("efficiency"),
                           {{"on " + machine->name, "efficiency"}}));
    plots.push_back(curves("cache_traffic", "Pages received by a node", "cache pages", CacheCurves::size_axis(), rate,
                           {{"on " + machine->name, "page traffic a node"}}));
  }
  return plots;
}

void CacheStudy::measure(StudyRuns& runs, Table& table) const {
  svm::Report recorded = runs.run(std::to_string(node_count) + " nodes, recording", recording(node_count));
  const std::uint32_t page_count = recorded.plan.request.page_count;
  const Sizes sizes =
      cache_pages.empty() ? geometric_sizes(page_count - page_count / node_count, standard_size_count) : cache_pages;
  const CacheCurves curves(references_of(recorded), recorded.pages().references, sizes, [&runs] { runs.check(); });
  recorded = {.film = core::Film(1, 1)};  // the references take much memory
  Sweep(*this, sizes, page_count, curves, table).carry_out(runs);
  table.add_note(curves.needs_note());
  runs.check();
}

std::vector<std::string> CacheStudy::notes(const std::string& scene) const {
  std::vector<std::string> notes = {
      std::to_string(node_count) + " nodes. Share of database: the cache of one node over all pages.",
      "Faults and misses: pixels shared out beforehand, one in flight on a node, so that all policies see the same references "
      "and every miss is a fault. Misses are given as a share of all references, pages at home included.",
      CacheCurves::note()};
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
