// The study `systems`: the systems of the article's Table 1 on one machine, with the same scene, picture and counters.
#include "apps/lab/study/studies.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/lab/study/engine/time_part_columns.h"
#include "apps/lab/study/systems_plan.h"
#include "apps/run/run_strategy.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr double system_seconds_of_ns = 1e-9;

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

/// Returns mean over maximum of the nodes' computing times.
double load_of(const nodes::VirtualReport& time) {
  std::uint64_t most = 0, sum = 0;
  const auto nodes = std::span(time.nodes).first(time.nodes.size() - 1);
  for (const nodes::VirtualTimes& node : nodes) {
    most = std::max(most, node.computing_ns);
    sum += node.computing_ns;
  }
  return most == 0 ? 1 : static_cast<double>(sum) / static_cast<double>(most * nodes.size());
}

/// Seconds of a whole run, and of all nodes' computing.
struct RunTimes {
  double seconds, computing_seconds;

  explicit RunTimes(const Account& account)
      : seconds(system_seconds_of_ns * static_cast<double>(account.virtual_time->total_ns)),
        computing_seconds(system_seconds_of_ns * static_cast<double>(sum_of_nodes(*account.virtual_time).computing_ns)) {}
};

/// Returns the bytes of the database at the node with the most.
std::size_t most_held_bytes(const Account& account) {
  std::size_t most = 0;
  for (const NodeAccount& node : account.nodes) {
    most = std::max(most, held_bytes(node.memory_planned));
  }
  return most;
}

/// Returns the bytes that the host sends or receives, over all bytes.
double host_share(const Account& account) {
  const std::uint64_t host_bytes = nodes::total(account.host.sent).bytes + nodes::total(account.host.received).bytes;
  return ratio(static_cast<double>(host_bytes), static_cast<double>(nodes::total(account.sent).bytes));
}

double busiest_link(const nodes::VirtualReport& time) {
  return time.busiest_links.empty()
             ? 0
             : ratio(static_cast<double>(time.busiest_links.front().busy_ns), static_cast<double>(time.total_ns));
}

double all_memory_bytes(const Account& account) {
  return std::accumulate(account.nodes.begin(), account.nodes.end(), 0.0, [](double sum, const NodeAccount& node) {
    return sum + static_cast<double>(node.memory_planned.total());
  });
}

/// The contents of a row for a run that fits.
struct FittingRun {
  const Account& account;
  RunTimes times, one;  ///< its own, and those of one node with the whole scene in the same structure
  std::size_t database_bytes;

  double a_ray(std::uint64_t count) const {
    return ratio(static_cast<double>(count), static_cast<double>(account.operations.ray_count()));
  }
  double efficiency() const { return ratio(one.seconds, times.seconds * static_cast<double>(account.nodes.size())); }
};

const FilledColumns<FittingRun>& system_columns() {
  using Run = FittingRun;
  static const FilledColumns<Run> all = [] {
    FilledColumns<Run> columns = {
        {{"virtual time", "s", 6}, [](const Run& run) { return run.times.seconds; }},
        {{"efficiency", "%", 1}, [](const Run& run) { return 100 * run.efficiency(); }},
        {{"average load", "%", 1}, [](const Run& run) { return 100 * load_of(*run.account.virtual_time); }},
        {{"work", "", 2}, [](const Run& run) { return ratio(run.times.computing_seconds, run.one.computing_seconds); }}};
    add_time_parts(
        1, [](const Run& run) { return std::optional(parts_of(run.account)); }, columns);
    const FilledColumns<Run> behind = {
        {{"messages a ray", "", 3}, [](const Run& run) { return run.a_ray(nodes::total(run.account.sent).packets); }},
        {{"bytes a ray", "bytes", 1}, [](const Run& run) { return run.a_ray(nodes::total(run.account.sent).bytes); }},
        {{"host", "%", 1}, [](const Run& run) { return 100 * host_share(run.account); }},
        {{"busiest link", "%", 1}, [](const Run& run) { return 100 * busiest_link(*run.account.virtual_time); }},
        {{"node memory", "bytes"}, [](const Run& run) { return std::uint64_t{run.account.node_memory_max_bytes}; }},
        {{"all memories", "", 2},
         [](const Run& run) { return all_memory_bytes(run.account) / static_cast<double>(run.database_bytes); }}};
    columns.insert(columns.end(), behind.begin(), behind.end());
    return columns;
  }();
  return all;
}

struct SystemOutcome {
  std::size_t held_bytes = 0;
  std::vector<Cell> figures;  ///< for a row that it fits
};

/// Adds the rows of the table as soon as their runs and all before them have ended.
class SystemRows {
 public:
  SystemRows(const SystemPlan& plan, const std::vector<StudyRun>& runs, Table& table)
      : plan_(plan), runs_(runs), table_(table), outcomes_(plan.runs.size()), is_done_(plan.runs.size()) {}

  void take(std::size_t run, const StudyOutcome& outcome) {
    const SystemRun& done = plan_.runs[run];
    add_notes(std::string(name_of(done.system)) + ", " + apps::name_of(done.asked().structure) + ", on " +
                  counted(done.node_count, "node") + ", memory " + done.memory->text(),
              outcome, table_);
    if (outcome.report) {
      note(run, account_of(*outcome.report));
    }
    is_done_[run] = true;
    for (; next_ < plan_.rows.size() && is_done_[plan_.run_of[next_]]; ++next_) {
      add(plan_.rows[next_], plan_.run_of[next_]);
    }
  }

 private:
  /// Runs of one node with the whole scene come before all others.
  void note(std::size_t run, const Account& account) {
    const RunTimes times(account);
    const core::Structure structure = plan_.runs[run].asked().structure;
    if (plan_.alone.at(structure) == run) {
      alone_.emplace(structure, times);
    }
    const auto one = alone_.find(structure);
    core::expect(one != alone_.end(), "one node has as much memory as it needs, and ends before others");
    const FittingRun fitting{account, times, one->second, runs_[run].database->bytes().size()};
    outcomes_[run] = {most_held_bytes(account), row_of(system_columns(), fitting)};
  }

  void add(const SystemRun& planned, std::size_t run) {
    const core::Database& database = *runs_[run].database;
    const std::optional<SystemOutcome>& outcome = outcomes_[run];
    const bool fits = outcome && planned.memory->allows(outcome->held_bytes, database, planned.node_count);
    std::vector<Cell> row = {text_of(planned.structures),
                             name_of(planned.system),
                             planned.memory->text(),
                             std::uint64_t{planned.node_count},
                             apps::name_of(planned.asked().structure),
                             fits ? "yes" : "no"};
    row.push_back(outcome ? Cell(100 * static_cast<double>(outcome->held_bytes) / static_cast<double>(database.bytes().size()))
                          : Cell());
    if (fits) {
      row.insert(row.end(), outcome->figures.begin(), outcome->figures.end());
    }
    row.resize(table_.columns().size());
    table_.add_row(std::move(row));
  }

  const SystemPlan& plan_;
  const std::vector<StudyRun>& runs_;
  Table& table_;
  std::map<core::Structure, RunTimes> alone_;
  std::vector<std::optional<SystemOutcome>> outcomes_;  ///< by run
  std::vector<bool> is_done_;                           ///< by run
  std::size_t next_ = 0;
};

/// "svm,forest", in that order, each once.
std::vector<System> parse_systems(const std::string& text) {
  std::vector<System> chosen;
  for (const std::string& word : words_between(text, ',')) {
    if (const System system = find_system(word); std::find(chosen.begin(), chosen.end(), system) == chosen.end()) {
      chosen.push_back(system);
    }
  }
  return chosen;
}

/// "papers,today", in that order, each once.
std::vector<SystemStructures> parse_structures(const std::string& text) {
  std::vector<SystemStructures> chosen;
  for (const std::string& word : words_between(text, ',')) {
    const bool is_original = word == name_of(SystemStructures::of_papers);
    if (!is_original && word != name_of(SystemStructures::of_today)) {
      throw core::UsageError("--structures=" + text + ": expected papers, today or both");
    }
    const SystemStructures structures = is_original ? SystemStructures::of_papers : SystemStructures::of_today;
    if (std::find(chosen.begin(), chosen.end(), structures) == chosen.end()) {
      chosen.push_back(structures);
    }
  }
  return chosen;
}

/// Checks after parsing: each system has its own structure.
void check_database(const OptionSet& set) {
  for (const char* option : {"--structure", "--voxels"}) {
    if (set.is_given(option)) {
      throw core::UsageError(std::string(option) + " does not go with study systems: each system has its own (--structures)");
    }
  }
  if (set.is_given("--record-order")) {
    throw core::UsageError("--record-order does not go with study systems: a subtree of forest lies in one page");
  }
}

}  // namespace

const char* name_of(SystemStructures structures) { return structures == SystemStructures::of_papers ? "papers" : "today"; }

std::vector<System> SystemsStudy::all_systems() {
  std::vector<System> all;
  for (const SystemDescription& description : systems()) {
    all.push_back(description.system);
  }
  return all;
}

void SystemsStudy::add_options(StudyLine line) {
  add_node_counts(line.set, node_counts);
  line.set.add_text(
      "--systems", "NAME,NAME,... [all]", [this](const std::string& text) { chosen = parse_systems(text); },
      "Which are compared: " + system_names());
  line.set.add_text(
      "--structures", "NAME,... [papers,today]", [this](const std::string& text) { structures = parse_structures(text); },
      "On which they are compared, a table each: papers, as each had it when it was described, voxels or a tree of boxes; today, "
      "as render --system has it");
  line.set.add_text(
      "--node-memory", "RULE,RULE,... [auto,25%,5%,1%]", [this](const std::string& text) { memories = parse_memory_rules(text); },
      "What a node may hold: auto, as much as its system needs; S%, its part and so much of the database more; or a size such "
      "as 4MiB, of all that its memory holds");
  add_machine_option(line.set, machine.runner.machine_name, "");
  line.set.check_in_the_end([this, set = line.set, &file = line.machine_name] {
    file = machine.runner.machine_name;
    check_database(set);
    choose_machine(machine);
  });
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study systems rings-4-t1\n"
      "  dmpc study systems balls-4 --machine=hdr --resolution=256x256 --plots=plots -o systems.md\n"
      "  dmpc study systems mount-6-t6 --nodes=8,64 --systems=svm,forest --node-memory=auto,2% --format=csv -o systems.csv\n"
      "A system that does not fit has a row without figures.");
}

std::vector<Column> SystemsStudy::columns() const {
  std::vector<Column> columns = {{.name = "structures", .unit = "", .is_heading = true},
                                 {"system"},
                                 {"memory"},
                                 {"nodes"},
                                 {"structure"},
                                 {"fits"},
                                 {"database held", "%", 1}};
  const std::vector<Column> figures = heads_of(system_columns());
  columns.insert(columns.end(), figures.begin(), figures.end());
  return columns;
}

namespace {

/// Returns a plot of one figure, with bars for each system, by the rule of memory.
Plot bars_of(const SystemsStudy& study, SystemStructures structures, Plot bars, const char* figure) {
  bars.name += structures == SystemStructures::of_papers ? "_papers" : "";
  bars.title += std::string(" of the systems, structures ") + text_of(structures);
  bars.places = {"system"};
  for (const MemoryRule& memory : study.memories) {
    const std::string text = memory.text();
    bars.series.push_back({"memory " + text,
                           figure,
                           {{"structures", text_of(structures)}, {"memory", text}},
                           PlotMark::bars,
                           bars.series.size() % plot_color_count});
  }
  return bars;
}

}  // namespace

std::vector<Plot> SystemsStudy::plots() const {
  std::vector<Plot> plots;
  for (const SystemStructures one : structures) {
    const PlotAxis times{.label = "virtual time (s)", .scale = PlotScale::powers_of_10};
    const auto bars = [&](const char* name, const char* title, const PlotAxis& axis, const char* figure) {
      plots.push_back(
          bars_of(*this, one, {.name = name, .title = title, .places = {}, .x = {}, .y = axis, .series = {}}, figure));
    };
    bars("systems_time", "Virtual time", times, "virtual time");
    bars("systems_efficiency", "Efficiency", percent_axis("efficiency"), "efficiency");
  }
  return plots;
}

void SystemsStudy::measure(StudyRuns& runs, Table& table) const {
  const SystemPlan plan = plan_of(*this);
  Structures built({&runs.database(), &runs.settings()}, build);
  std::vector<StudyRun> wanted;
  for (const SystemRun& run : plan.runs) {
    runs.check();
    const Rendered rendered = built.of(run.asked());
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
  std::vector<std::string> notes = {machine_text(*machine.computer.machine) + ". One pixel in flight, forest " +
                                    in_flight_text(Strategy::forest) + "."};
  for (const SystemDescription& description : systems()) {
    if (std::find(chosen.begin(), chosen.end(), description.system) != chosen.end()) {
      notes.push_back(std::string(description.name) + ": " + description.meaning + ". Its structure: " + description.had_what +
                      " (" + name_of(description.had) + ").");
    }
  }
  notes.insert(
      notes.end(),
      {"Memory auto: what each system needs, caches that hold the whole database. S%: a node holds its part, an Nth of the "
       "database, and S % of it more. A size: all that a node's memory holds. Database held: at the node that holds most, caches "
       "as large as they may become.",
       "Structures of the papers: that which each system had when it was described, or of ours the nearest: a plain grid of "
       "voxels "
       "by the rule that the article's memories tell (--voxels=article), or a tree of extents. Structures of today: as render "
       "--system has them.",
       "Efficiency and work: against one node with the whole scene in the same structure, in node-seconds and in those of them "
       "that are computing. "
       "Average load: mean over maximum of the nodes' computing.",
       "Parts of the nodes' time, summed over them: they add up to 100 %. data_wait is for pages, rays or answers.",
       "Messages and bytes of all kinds. Host: the bytes that it sends or is sent, of all. Busiest link: the time that it is "
       "held. "
       "All memories: over the database."});
  return notes;
}

namespace {

/// Returns the row with the least time among systems that do not store the whole scene on a node; nullptr if none has a time.
const std::vector<Cell>* fastest_of(const Table& table, const std::string& structures) {
  const std::vector<Cell>* fastest = nullptr;
  for (const std::vector<Cell>& row : table.rows()) {
    const auto time = number_in(table, row, "virtual time");
    const bool is_meant = std::get<std::string>(row[0]) == structures && !std::get<std::string>(row[1]).starts_with("replicated");
    if (is_meant && time && (fastest == nullptr || *time < number_in(table, *fastest, "virtual time"))) {
      fastest = &row;
    }
  }
  return fastest;
}

}  // namespace

std::string SystemsStudy::conclusion(const Table& table) const {
  std::string text;
  for (const SystemStructures one : structures) {
    if (const std::vector<Cell>* const row = fastest_of(table, text_of(one))) {
      text += (text.empty() ? "Of the systems whose nodes do not hold the whole scene " : "; ") +
              std::get<std::string>((*row)[1]) + " is the fastest on structures " + text_of(one) + ": " +
              amount_text(*number_in(table, *row, "virtual time"), "s") + " on " + nodes_text(table, *row) + ", memory " +
              std::get<std::string>((*row)[2]);
    }
  }
  return text.empty() ? text : text + ".";
}

}  // namespace dmpc::apps
