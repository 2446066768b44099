#include "apps/lab/study/systems.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/run/time_parts.h"
#include "apps/run/report.h"
#include "apps/run/run_strategy.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr double seconds_of_ns = 1e-9;

/// A row, and the run that it shows.
struct PlannedRow {
  std::uint32_t node_count;
  const MemoryRule* memory;
  System system;
  std::size_t run;
};

/// A run of `system` by `memory`.
struct SystemRun {
  std::uint32_t node_count;
  const MemoryRule* memory;
  System system;
};

struct SystemPlan {
  std::vector<SystemRun> runs;
  std::vector<PlannedRow> rows;
};

constexpr MemoryRule as_needed = {};

/// The rows, each with the first run that is good for it.
SystemPlan plan_of(const SystemsStudy& study) {
  SystemPlan plan;
  plan.runs.push_back({1, &as_needed, System::replicated});  // that efficiencies are by
  for (const std::uint32_t node_count : study.node_counts) {
    std::map<System, std::size_t> unbounded;
    for (const MemoryRule& memory : study.memories) {
      for (const System system : study.chosen) {
        const auto before = unbounded.find(system);
        const bool is_new = memory.changes(system) || before == unbounded.end();
        plan.rows.push_back({node_count, &memory, system, is_new ? plan.runs.size() : before->second});
        if (is_new) {
          plan.runs.push_back({node_count, memory.changes(system) ? &memory : &as_needed, system});
        }
        if (!memory.changes(system)) {
          unbounded.emplace(system, plan.rows.back().run);
        }
      }
    }
  }
  return plan;
}

/// What a system renders.
struct Rendered {
  const core::Database* database;
  const core::RenderSettings* settings;
};

/// The study's scene, and the same in other structures that its systems ask for, each built when it is first wanted.
class Structures {
 public:
  Structures(const Rendered& usual, const SystemsStudy::Build& build) : usual_(usual), build_(build) {}

  Rendered of(System system) {
    const core::BuildOptions asked = database_of(system).build;
    if (asked.structure == core::Structure::grid) {
      return usual_;
    }
    // Forest's subtrees are its pages; others have pages of one size, so that faults can be compared.
    const std::size_t page_size_bytes =
        strategy_of(system).strategy == Strategy::forest ? asked.page_size_bytes : usual_.database->page_size();
    auto found = extents_.find(page_size_bytes);
    if (found == extents_.end()) {
      found = extents_.emplace(page_size_bytes, build_(asked.structure, page_size_bytes)).first;
    }
    return {&found->second.database, &found->second.settings};
  }

 private:
  Rendered usual_;
  const SystemsStudy::Build& build_;
  std::map<std::size_t, Subject> extents_;  ///< by size of pages
};

/// What a run came to: cells, and what decides whether it fits.
struct Figures {
  std::size_t held_bytes = 0;  ///< of the database, at the node that holds most
  std::size_t memory_bytes = 0, all_memory_bytes = 0;
  double seconds = 0;
  double computing_seconds = 0;  ///< summed over the nodes
  double average_load = 0;
  std::array<double, time_part_count> parts{};
  double messages_a_ray = 0, bytes_a_ray = 0;
  double host_share = 0, busiest_link = 0;
};

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

/// Mean over maximum of the time that the nodes computed.
double load_of(const nodes::VirtualReport& time) {
  std::uint64_t most = 0, sum = 0;
  const auto nodes = std::span(time.nodes).first(time.nodes.size() - 1);
  for (const nodes::VirtualTimes& node : nodes) {
    most = std::max(most, node.computing_ns);
    sum += node.computing_ns;
  }
  return most == 0 ? 1 : static_cast<double>(sum) / static_cast<double>(most * nodes.size());
}

Figures figures_of(const Account& account) {
  const nodes::VirtualReport& time = *account.virtual_time;
  const nodes::VirtualTimes sum = sum_of_nodes(time);
  const nodes::Traffic sent = nodes::total(account.sent);
  const auto rays = static_cast<double>(account.operations.ray_count());
  const auto total_ns = static_cast<double>(time.total_ns);
  Figures figures{.memory_bytes = account.node_memory_max_bytes,
                  .seconds = seconds_of_ns * total_ns,
                  .computing_seconds = seconds_of_ns * static_cast<double>(sum.computing_ns),
                  .average_load = load_of(time),
                  .parts = parts_of(sum, account.waits).percent(),
                  .messages_a_ray = ratio(static_cast<double>(sent.packets), rays),
                  .bytes_a_ray = ratio(static_cast<double>(sent.bytes), rays)};
  for (const NodeAccount& node : account.nodes) {
    figures.held_bytes = std::max(figures.held_bytes, held_bytes(node.memory_planned));
    figures.all_memory_bytes += node.memory_planned.total();
  }
  const std::uint64_t host_bytes = nodes::total(account.host.sent).bytes + nodes::total(account.host.received).bytes;
  figures.host_share = ratio(static_cast<double>(host_bytes), static_cast<double>(sent.bytes));
  if (!time.busiest_links.empty()) {
    figures.busiest_link = ratio(static_cast<double>(time.busiest_links.front().busy_ns), total_ns);
  }
  return figures;
}

/// The rows of the table, as soon as their runs and all before them have ended.
class SystemRows {
 public:
  SystemRows(const SystemPlan& plan, const std::vector<StudyRun>& runs, Table& table)
      : plan_(plan), runs_(runs), table_(table), figures_(plan.runs.size()), is_done_(plan.runs.size()) {}

  void take(std::size_t run, const StudyOutcome& outcome) {
    const SystemRun& done = plan_.runs[run];
    add_notes(std::string(name_of(done.system)) + " on " + counted(done.node_count, "node") + ", memory " + done.memory->text(),
              outcome, table_);
    if (outcome.report) {
      figures_[run] = figures_of(account_of(*outcome.report));
    }
    is_done_[run] = true;
    for (; next_ < plan_.rows.size() && is_done_[plan_.rows[next_].run]; ++next_) {
      add(plan_.rows[next_]);
    }
  }

 private:
  void add(const PlannedRow& planned) {
    std::vector<Cell> row = {name_of(planned.system), planned.memory->text(), std::uint64_t{planned.node_count}};
    const std::optional<Figures>& figures = figures_[planned.run];
    const core::Database& database = *runs_[planned.run].database;
    const bool fits = figures && planned.memory->allows(figures->held_bytes, database, planned.node_count);
    row.emplace_back(fits ? "yes" : "no");
    row.push_back(figures ? share_cell(figures->held_bytes, database) : Cell());
    if (fits) {
      append(row, *figures, database, planned.node_count);
    }
    row.resize(table_.columns().size());
    table_.add_row(std::move(row));
  }

  static Cell share_cell(std::size_t bytes, const core::Database& database) {
    return 100 * static_cast<double>(bytes) / static_cast<double>(database.bytes().size());
  }

  void append(std::vector<Cell>& row, const Figures& figures, const core::Database& database, std::uint32_t node_count) const {
    const Figures& one = *figures_.front();
    row.emplace_back(figures.seconds);
    row.emplace_back(100 * ratio(one.seconds, figures.seconds * node_count));
    row.emplace_back(100 * figures.average_load);
    row.emplace_back(ratio(figures.computing_seconds, one.computing_seconds));
    for (const double percent : figures.parts) {
      row.emplace_back(percent);
    }
    row.emplace_back(figures.messages_a_ray);
    row.emplace_back(figures.bytes_a_ray);
    row.emplace_back(100 * figures.host_share);
    row.emplace_back(100 * figures.busiest_link);
    row.emplace_back(static_cast<std::uint64_t>(figures.memory_bytes));
    row.emplace_back(static_cast<double>(figures.all_memory_bytes) / static_cast<double>(database.bytes().size()));
  }

  const SystemPlan& plan_;
  const std::vector<StudyRun>& runs_;
  Table& table_;
  std::vector<std::optional<Figures>> figures_;  ///< by run
  std::vector<bool> is_done_;                    ///< by run
  std::size_t next_ = 0;
};

}  // namespace

std::vector<System> SystemsStudy::all_systems() {
  std::vector<System> all;
  for (const SystemDescription& description : systems()) {
    all.push_back(description.system);
  }
  return all;
}

std::vector<Column> SystemsStudy::columns() const {
  std::vector<Column> columns = {{"system"},
                                 {"memory"},
                                 {"nodes"},
                                 {"fits"},
                                 {"database held", "%", 1},
                                 {"virtual time", "s", 6},
                                 {"efficiency", "%", 1},
                                 {"average load", "%", 1},
                                 {"work", "", 2}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 1});
  }
  columns.insert(columns.end(), {{"messages a ray", "", 3},
                                 {"bytes a ray", "bytes", 1},
                                 {"host", "%", 1},
                                 {"busiest link", "%", 1},
                                 {"node memory", "bytes"},
                                 {"all memories", "", 2}});
  return columns;
}

std::vector<Plot> SystemsStudy::plots() const {
  const auto bars = [&](const char* plot, const char* title, const char* column, PlotAxis axis) {
    Plot bars{.name = plot, .title = title, .places = {"system"}, .x = {}, .y = std::move(axis), .series = {}};
    for (const MemoryRule& memory : memories) {
      const std::string text = memory.text();
      bars.series.push_back(
          {"memory " + text, column, {{"memory", text}}, PlotMark::bars, bars.series.size() % plot_color_count});
    }
    return bars;
  };
  const PlotAxis times{.label = "virtual time (s)", .scale = PlotScale::powers_of_10};
  return {bars("systems_time", "Virtual time of the systems", "virtual time", times),
          bars("systems_efficiency", "Efficiency of the systems", "efficiency", percent_axis("efficiency"))};
}

std::uint32_t SystemsStudy::run_count() const { return static_cast<std::uint32_t>(plan_of(*this).runs.size()); }

void SystemsStudy::measure(StudyRuns& runs, Table& table) const {
  const SystemPlan plan = plan_of(*this);
  Structures structures({&runs.database(), &runs.settings()}, build);
  std::vector<StudyRun> wanted;
  for (const SystemRun& run : plan.runs) {
    runs.check();
    const Rendered rendered = structures.of(run.system);
    StrategyOptions options = strategy_of(run.system);
    options.runner = machine.runner;
    choose_machine(options, *machine.computer.machine);
    options.computer.node_count = run.node_count;
    run.memory->apply(options, *rendered.database);
    wanted.push_back({std::move(options), rendered.database, rendered.settings});
  }
  SystemRows rows(plan, wanted, table);
  runs.run_side_by_side(wanted, [&](std::size_t i, const StudyOutcome& outcome) { rows.take(i, outcome); });
  runs.check();
  for (std::string& verdict : verdicts_of(table)) {
    table.add_note(std::move(verdict));
  }
}

std::vector<std::string> SystemsStudy::notes(const std::string&) const {
  std::vector<std::string> notes = {machine_text(*machine.computer.machine) + ". One pixel in flight, forest 16."};
  for (const SystemDescription& description : systems()) {
    if (std::find(chosen.begin(), chosen.end(), description.system) != chosen.end()) {
      notes.push_back(std::string(description.name) + ": " + description.meaning + ".");
    }
  }
  notes.insert(
      notes.end(),
      {"Memory auto: what each system needs, caches that hold the whole database. S%: a node holds its part, an Nth of the "
       "database, and S % of it more. A size: all that a node's memory holds. Database held: at the node that holds most, caches "
       "as large as they may become.",
       "Efficiency and work: against one node with the whole scene, in node-seconds and in those of them that are computing. "
       "Average load: mean over maximum of the nodes' computing.",
       "Parts of the nodes' time, summed over them: they add up to 100 %. data_wait is for pages, rays or answers.",
       "Messages and bytes of all kinds. Host: the bytes that it sends or is sent, of all. Busiest link: the time that it is "
       "held. "
       "All memories: over the database."});
  return notes;
}

}  // namespace dmpc::apps
