#include "apps/lab/study/options.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/edge/line/option_values.h"
#include "apps/edge/line/words.h"
#include "apps/edge/machine/machine_file.h"
#include "apps/edge/machine/machines.h"
#include "apps/edge/table/table_options.h"
#include "apps/run/run_strategy.h"
#include "core/base/expect.h"
#include "dataflow/regions/bsp.h"
#include "svm/plan.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t cache_pages_max = 0x7fffffff;

/// "4,8,16".
std::string listed(const std::vector<std::uint32_t>& counts) {
  std::string text;
  for (const std::uint32_t count : counts) {
    text += (text.empty() ? "" : ",") + std::to_string(count);
  }
  return text;
}

void add_node_counts(OptionSet& set, std::vector<std::uint32_t>& counts) {
  set.add_text(
      "--nodes", "N,N,... [" + listed(counts) + "]",
      [&counts](const std::string& text) { counts = parse_numbers(text, "--nodes", nodes::node_count_max); },
      "Nodes of the computers, one after the other");
}

/// In the end: the options go together, and the machine is read.
void finish(const OptionSet& set, SpeedupStudy& study, DatabaseOptions& database) {
  settle_database(set, study.run.strategy, database);
  check_together(set, study.run);
  choose_machine(study.run);
}

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

/// In the end: the machine is read, and the database is that of the systems in a grid.
void finish(const OptionSet& set, SystemsStudy& study) {
  if (set.is_given("--structure")) {
    throw core::UsageError("--structure does not go with study systems: each system has its own");
  }
  if (set.is_given("--record-order")) {
    throw core::UsageError("--record-order does not go with study systems: a subtree of forest lies in one page");
  }
  choose_machine(study.machine);
}

/// One overload a study: its own options, and examples.
struct AddOwn {
  OptionSet& set;
  std::string& machine_name;
  DatabaseOptions& database;

  void operator()(BalanceStudy& study) const {
    add_node_counts(set, study.node_counts);
    add_option(set, core::field_of<&dataflow::BalanceOptions::subsample>(), study.regions);
    add_option(set, core::field_of<&dataflow::BalanceOptions::columns_per_side>(), study.regions);
    add_topology_option(set, study.topology);
    set.add_flag("--per-node", study.per_node, "Show each node's share of the work, too");
    set.set_examples(
        "Examples:\n"
        "  dmpc study balance rings-3-t1\n"
        "  dmpc study balance teapot-12 --nodes=16 --topology=torus --per-node --format=csv -o teapot.csv");
  }
  void operator()(TrafficStudy& study) const {
    add_node_counts(set, study.node_counts);
    set.set_examples(
        "Examples:\n"
        "  dmpc study traffic teapot-12\n"
        "  dmpc study traffic rings-4-t1 --nodes=8,64 --resolution=256x256 --format=json -o rings.json");
  }
  void operator()(CacheStudy& study) const {
    set.add_number("--nodes", study.node_count, 2, nodes::node_count_max, "32", "Nodes, each with a cache of its own");
    set.add_text(
        "--cache-pages", "N,N,... [12 from 1 to all]",
        [&study](const std::string& text) { study.cache_pages = parse_numbers(text, "--cache-pages", cache_pages_max); },
        "Sizes of the caches in pages");
    set.add_text(
        "--machine", "MACHINE|FILE.json",
        [&study, &file = machine_name](const std::string& text) {
          study.machine = load_machine(text).machine;
          file = text;
        },
        "The machine that the study is timed on, in virtual time: one of " + machine_preset_names() + ", or a file");
    set.set_examples(
        "Examples:\n"
        "  dmpc study cache rings-4-t1\n"
        "  dmpc study cache tetra-9 --nodes=32 --machine=ipsc2 --resolution=512x512 --format=csv -o tetra.csv");
  }
  void operator()(SpeedupStudy& study) const {
    add_node_counts(set, study.node_counts);
    add_strategy_option(set, study.run.strategy);
    add_memory_option(set, study.run.computer.node_memory_bytes);
    add_machine_options(set, study.run.runner, "");
    add_page_options(set, study.run.pages, "1");
    add_ray_options(set, study.run.rays);
    set.check_in_the_end([set = set, &study, &file = machine_name, &wanted = database] {
      file = study.run.runner.machine_name;
      finish(set, study, wanted);
    });
    set.set_examples(
        "Examples:\n"
        "  dmpc study speedup rings-4-t1\n"
        "  dmpc study speedup rings-4-t1 --node-memory=1MiB --replacement=clock --in-flight=4 --format=csv -o rings.csv\n"
        "  dmpc study speedup teapot-12 --strategy=dataflow --machine=hdr --nodes=1,16,256,1024\n"
        "A number of nodes whose memory cannot hold the scene has a row without figures, and a note that says what would do.\n"
        "If none can, the exit status is 4.");
  }
  void operator()(SystemsStudy& study) const {
    add_node_counts(set, study.node_counts);
    set.add_text(
        "--systems", "NAME,NAME,... [all]", [&study](const std::string& text) { study.chosen = parse_systems(text); },
        "Which are compared: " + system_names());
    set.add_text(
        "--node-memory", "RULE,RULE,... [auto,25%,5%,1%]",
        [&study](const std::string& text) { study.memories = parse_memory_rules(text); },
        "What a node may hold: auto, as much as its system needs; S%, its part and so much of the database more; or a size such "
        "as 4MiB, of all that its memory holds");
    add_machine_options(set, study.machine.runner, "");
    set.check_in_the_end([set = set, &study, &file = machine_name] {
      file = study.machine.runner.machine_name;
      finish(set, study);
    });
    set.set_examples(
        "Examples:\n"
        "  dmpc study systems rings-4-t1\n"
        "  dmpc study systems balls-4 --machine=hdr --resolution=256x256 --plots=plots -o systems.md\n"
        "  dmpc study systems mount-6-t6 --nodes=8,64 --systems=svm,forest --node-memory=auto,2% --format=csv -o systems.csv\n"
        "A system that does not fit has a row without figures.");
  }
};

}  // namespace

void add_options(OptionSet set, StudyOptions& options) {
  add_options(set, options.picture);
  add_options(set, options.database);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
  std::visit(AddOwn{set, options.machine_name, options.database}, options.study);
}

}  // namespace dmpc::apps
