// The study `systems`: the systems of the article's Table 1 on one machine, with the same scene, picture and counters.
#include <algorithm>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/drawn_machine.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/lab/study/studies.h"
#include "apps/lab/study/systems/runner.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

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

/// "described,equal", in that order, each once.
std::vector<SystemTable> parse_tables(const std::string& text) {
  std::vector<SystemTable> chosen;
  for (const std::string& word : words_between(text, ',')) {
    const bool is_described = word == name_of(SystemTable::described);
    if (!is_described && word != name_of(SystemTable::equal)) {
      throw core::UsageError("--tables=" + text + ": expected described, equal or both");
    }
    const SystemTable table = is_described ? SystemTable::described : SystemTable::equal;
    if (std::find(chosen.begin(), chosen.end(), table) == chosen.end()) {
      chosen.push_back(table);
    }
  }
  return chosen;
}

/// Checks after parsing: the study has its own databases.
void check_database(const OptionSet& set) {
  for (const char* option : {"--structure", "--voxels", "--page-size", "--record-order"}) {
    if (set.is_given(option)) {
      throw core::UsageError(std::string(option) + " does not go with study systems: its tables have their own");
    }
  }
}

}  // namespace

const char* name_of(SystemTable table) { return table == SystemTable::described ? "described" : "equal"; }

std::vector<System> SystemsStudy::all_systems() { return core::mapped<System>(systems(), &SystemDescription::system); }

void SystemsStudy::add_options(StudyLine line) {
  constexpr std::uint32_t draws_max = 10'000;
  add_node_counts(line.set, node_counts);
  line.set.add_text(
      "--systems", "NAME,NAME,... [all]", [this](const std::string& text) { chosen = parse_systems(text); },
      "Which are compared: " + system_names());
  line.set.add_text(
      "--tables", "NAME,... [described,equal]", [this](const std::string& text) { tables = parse_tables(text); },
      "described: each system as it had it when it was described. equal: each on every structure at its best, with equal memory");
  line.set.add_text(
      "--node-memory", "RULE,RULE,... [rays]", [this](const std::string& text) { memories = parse_memory_rules(text); },
      "All that a node may store, in the table equal: rays, what the better of scattered and subsampled needs by default on the "
      "grid; S%, a share of the database; or a size such as 4MiB");
  line.set.add_flag("--search", has_search, "Adds the steps of each row's search as notes");
  line.set.add_number("--draws", draws, 0, draws_max, "100",
                      "Draws of the machine's prices, within the certainty of their sources, for the best rows; 0: none");
  add_machine_option(line.set, machine_name, "");
  line.set.check_in_the_end([this, set = line.set, &file = line.machine_name] {
    file = machine_name;
    check_database(set);
    machine = load_machine(machine_name);
  });
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study systems rings-4-t1\n"
      "  dmpc study systems balls-4 --machine=hdr --samples=16 --plots=plots -o systems.md\n"
      "  dmpc study systems mount-6-t6 --tables=equal --node-memory=rays,25%,1MiB --search --format=csv -o systems.csv\n"
      "A system that does not fit has a row without figures.");
}

std::vector<Column> SystemsStudy::columns() const {
  std::vector<Column> columns = {{.name = "table", .unit = "", .is_heading = true},
                                 {"memory"},
                                 {"nodes"},
                                 {"system"},
                                 {"structure"},
                                 {"node memory", "bytes"},
                                 {"memory over database", "%", 1},
                                 {"page size"},
                                 {"in flight"},
                                 {"work donor"},
                                 {"resident", "%"},
                                 {"backpressure"},
                                 {"ray batch"},
                                 {"free beforehand"},
                                 {"draws ahead"}};
  const std::vector<Column> figures = figure_columns();
  columns.insert(columns.end(), figures.begin(), figures.end());
  return columns;
}

std::vector<Plot> SystemsStudy::plots() const {
  std::vector<Plot> plots;
  for (const SystemTable table : tables) {
    const bool is_described = table == SystemTable::described;
    const std::string which = name_of(table);
    Plot bars{.name = "systems_time_" + which,
              .title = "Virtual time of the systems, " + which,
              .places = {"system", "structure"},
              .x = {},
              .y = {.label = "virtual time (s)", .scale = PlotScale::powers_of_10},
              .series = {}};
    for (std::size_t i = 0; i < (is_described ? 1 : memories.size()); ++i) {
      const std::string memory = is_described ? "as needed" : memories[i].text();
      bars.series.push_back(
          {"memory " + memory, "virtual time", {{"table", which}, {"memory", memory}}, PlotMark::bars, i % plot_color_count});
    }
    plots.push_back(std::move(bars));
  }
  return plots;
}

void SystemsStudy::measure(StudyRuns& runs, Table& table) const {
  SystemRunner runner(*this, runs, table);
  for (const SystemTable one : tables) {
    one == SystemTable::described ? describe(runner) : compare_at_equal_memory(runner);
  }
}

std::vector<std::string> SystemsStudy::notes(const std::string&) const {
  std::vector<std::string> notes = {machine_text(machine.machine) +
                                    ". Voxels on ipsc2 have the prices of ipsc2-1994, which were "
                                    "fitted to voxels."};
  for (const SystemDescription& system : systems()) {
    if (std::find(chosen.begin(), chosen.end(), system.system) != chosen.end()) {
      notes.push_back(std::string(system.name) + ": " + system.meaning + ". Its structure: " + system.had_what + " (" +
                      name_of(system.had) + ").");
    }
  }
  const std::vector<std::string> more = {
      "Table described: each system as it had it when it was described, or as dmpc has it nearest: its structure (voxels by the "
      "article's rule, or a tree), one pixel in flight, cuts in alternating directions, no backpressure, as much memory as it "
      "needs, caches of the whole database. Its verdicts are those that authors drew.",
      "Table equal: equal memory, and each system on each structure that it can walk at the best of one search: from its "
      "defaults, "
      "one option after the other, each value with the others at their best so far, as far as the option is the system's and "
      "does "
      "not define it: " +
          search_text() + ". Free beforehand: what a system finds out before the run, in no virtual time.",
      "Best against best: the fastest row beside the fastest of each other strategy. Isolated: rows that differ in one option. "
      "Times within 1 % are a tie.",
      "Draws: " + std::to_string(draws) + " (seed " + std::to_string(draw_seed) +
          "), each price multiplied by a factor from 1/f to "
          "f, uniform in its logarithm, f = 1.1, 1.3 or 2 by the certainty of its source (high, medium, low or none). A row that "
          "is "
          "ahead in fewer than 80 of 100 is undecided.",
      "Parts of the nodes' time add up to 100 %; data_wait is for pages, rays or answers. Host busy: of the run. Messages and "
      "bytes "
      "of all kinds."};
  notes.insert(notes.end(), more.begin(), more.end());
  return notes;
}

std::string SystemsStudy::conclusion(const Table& table) const {
  const auto& notes = table.notes();
  const auto found =
      std::find_if(notes.begin(), notes.end(), [](const std::string& note) { return note.starts_with(BestVerdict::opening); });
  return found == notes.end() ? "" : *found;
}

}  // namespace dmpc::apps
