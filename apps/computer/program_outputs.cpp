#include "apps/computer/program_outputs.h"

#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "apps/computer/page_parts.h"
#include "apps/computer/program_tables.h"
#include "apps/computer/program_work.h"
#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/show/page/sections.h"
#include "apps/frontend/show/references/reference_file.h"
#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/table/table.h"
#include "core/base/expect.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace html {
namespace {

void append_task_facts(Facts& facts, const ProgramRecord& record) {
  const svm::TaskOptions& tasks = record.options.tasks;
  const std::string replaced = ", replaced by " + std::string(name_of(tasks.replacement));
  facts.emplace_back("Tasks", grouped(record.tasks.task_count) + " in " + counted(record.tasks.run_count, "run"));
  facts.emplace_back("Data", counted(record.tasks.page_count, "page") + " of " + nodes::size_text(tasks.page_size_bytes));
  facts.emplace_back("Cache of a node", counted(record.tasks.cache_pages, "page") + replaced);
  facts.emplace_back("Tasks in flight on a node", "up to " + grouped(tasks.in_flight));
  facts.emplace_back("Memory of the fullest node", bytes_text(record.sum().memory.total()));
}

Facts facts_of(const ProgramRecord& record) {
  Facts facts = computer_facts(record.options);
  const bool has_pages = record.vocabulary.has_pages();
  if (has_pages) {
    append_task_facts(facts, record);
  } else {
    const nodes::Traffic all = sent(record);
    facts.emplace_back("Packets sent", grouped(all.packets) + ", " + amount_text(static_cast<double>(all.bytes), "bytes"));
  }
  facts.emplace_back(has_pages ? "They took" : "It took", seconds_text(record.wall_seconds) + " by the wall clock");
  if (record.virtual_ns) {
    facts.emplace_back("Virtual time", amount_text(static_cast<double>(*record.virtual_ns), "ns"));
  }
  return facts;
}

void add_pairs(Page& page, const ProgramRecord& record) {
  if (const auto& pairs = record.pairs; pairs && record.node_count() > 1) {
    page.add_map(pair_map(pairs->packets, "Who sent packets to whom", "node that sends", "node that receives", "packets"), "");
    NumberMap bytes = pair_map(pairs->bytes, "Who sent bytes to whom", "node that sends", "node that receives", "");
    bytes.unit = "bytes";
    page.add_map(bytes, "");
  }
}

void add_packets(Page& page, const ProgramRecord& record) {
  page.begin_section("Packets");
  const std::vector<PacketKindTraffic> packets = packets_of(record);
  page.add_conclusion(traffic_conclusion(packets, record.network ? &*record.network : nullptr));
  if (sent(record).packets > 0) {
    page.add_table(packet_table(packets));
    add_pairs(page, record);
    if (record.network) {
      add_links(page, *record.network);
    }
  }
  add_ranks(page, record.ranks);
}

/// Returns which run was observed; nothing if there was only one.
std::string remark_on_runs(const ProgramRecord& record) {
  return record.tasks.run_count <= 1 ? "" : "Of the last of " + counted(record.tasks.run_count, "run") + ".";
}

void add_heat(Page& page, const ProgramRecord& record) {
  page.begin_section("What each task took");
  for (const TaskHeatKind kind : heat_kinds_of(record)) {
    page.add_conclusion(heat_conclusion(record, kind));
  }
  if (const std::string remark = remark_on_runs(record); !remark.empty()) {
    page.add_text(remark);
  }
  for (const TaskHeatKind kind : heat_kinds_of(record)) {
    page.add_map(heat_map(record, kind),
                 "Each row is a node, with its tasks in order: the lighter, the more a task of that place took on average.");
  }
  page.add_table(hottest_tasks(record));
}

void add_own_pages(Page& page, const ProgramRecord& record) {
  const svm::PageCounters& pages = record.tasks.last_pages;
  const std::string remark = remark_on_runs(record);
  add_pages(page, pages, *record.view->fetches, record.virtual_ns.has_value(), record.nodes.size() <= readable_nodes_max, remark);
  if (pages.faults > 0) {
    add_misses(page, *record.view->misses, record.tasks.page_count, record.tasks.cache_pages, pages, remark);
  }
}

Facts results_of(const ProgramRecord& record) { return record.run_hash ? Facts{{"run", hash_text(*record.run_hash)}} : Facts(); }

/// Writes the whole document. For tasks, counters cover all runs together, and observations the last one. Requires a record with
/// a view. Throws core::InputError if no temporary file can be written.
void write_program_page(const ProgramRecord& record, std::ostream& output) {
  core::expect(record.view.has_value(), "a page that is written was looked on for");
  const bool has_pages = record.vocabulary.has_pages();
  const Origin origin = program_origin(record.name);
  Page page("Run of " + record.name, page_words());
  begin_page(page, origin, facts_of(record), record.result, record.node_count());
  if (record.tasks.run_count > 1) {
    page.add_text("Times and counters are of all " + counted(record.tasks.run_count, "run") +
                  " together, where it does not say otherwise.");
  }
  add_losses(page, losses_of(record));
  add_steps(page, record.view->steps, program_work(record.vocabulary).names, {}, record.virtual_ns.has_value(),
            remark_on_runs(record),
            record.virtual_ns ? "" : "By the wall clock a call counts as long as it took, even where it waited for a core.");
  if (has_pages) {
    add_heat(page, record);
    add_own_pages(page, record);
  }
  add_packets(page, record);
  add_operations(page, operations_of(record), record.options.computer.model());
  const bool has_plot = !has_pages || record.sum().pages.faults > 0;
  add_node_section(page, "Nodes", has_pages ? "" : node_conclusion(record), node_table(record),
                   has_plot ? std::vector{node_plot(record)} : std::vector<Plot>());
  if (!has_pages) {
    add_node_section(page, "Memory", memory_conclusion(record), memory_table(record), {memory_plot(record)});
  }
  page.add_origin(origin, results_of(record));
  output << page.text();
}

}  // namespace
}  // namespace html

namespace {

std::string heat_line(const ProgramRecord& record, std::size_t task) {
  const svm::TaskTaken& taken = record.tasks.heat[task];
  std::string line = std::to_string(task);
  for (const std::uint64_t number : {std::uint64_t{taken.node}, taken.steps, taken.references, taken.faults}) {
    line += "," + std::to_string(number);
  }
  for (const NamedOperation& operation : record.vocabulary.operations) {
    line += "," + std::to_string(taken.charges.count[operation.charge]);
  }
  const nodes::Machine* const machine = record.options.computer.model();
  return line + "," + (machine == nullptr ? "" : std::to_string(machine->price_ps(taken.charges))) + "\n";
}

void write_stats(const ProgramRecord& record, std::ostream& output) { output << stats_json(record); }

void write_program_references(const ProgramRecord& record, std::ostream& output) {
  write_references(output, record.tasks.references, record.options.tasks.page_size_bytes);
}

/// Returns the files that a program reads.
std::vector<NamedFile> inputs_of(const ProgramOptions& options) {
  const bool reads_file = options.is_modelled() && find_machine_preset(options.machine_name) == nullptr;
  return reads_file ? std::vector<NamedFile>{{"--machine", options.machine_name}} : std::vector<NamedFile>();
}

void print_result(const ProgramRecord& record) {
  const std::string& result = record.result;
  std::cout << result << (result.empty() || result.ends_with('\n') ? "" : "\n") << (record.options.quiet ? "" : summary(record));
  finish_output(std::cout, "what the program came to");
}

}  // namespace

void write_task_heat(const ProgramRecord& record, std::ostream& output) {
  output << "task,node,steps,pages.references,pages.faults";
  for (const NamedOperation& operation : record.vocabulary.operations) {
    output << "," << csv_text("operations." + operation.name);
  }
  output << ",computing_ps\n";
  for (std::size_t task = 0; task < record.tasks.heat.size(); ++task) {
    output << heat_line(record, task);
  }
}

ProgramOutputs outputs_of(const ProgramOptions& options) {
  ProgramOutputs outputs;
  const auto add = [&](const char* option, const std::optional<std::filesystem::path>& path, ProgramOutputs::Write write) {
    if (path) {
      outputs.add(option, *path, check_output_path, std::move(write));
    }
  };
  add("--stats", options.stats, write_stats);
  add("--references", options.references, write_program_references);
  add("--trace", options.trace, write_program_trace);
  add("--heat", options.heat, write_task_heat);
  add("--report", options.report, html::write_program_page);
  return outputs;
}

void check_outputs(const ProgramOptions& options, const ProgramOutputs& outputs) {
  check_outputs(inputs_of(options), outputs.names());
  if (options.report) {
    const ScratchFolder probe;
  }
}

int end_program(const ProgramRecord& record, const ProgramOutputs& outputs) {
  Attempts attempts(std::cerr, record.name);
  outputs.write(record, attempts);
  attempts.make([&] { print_result(record); });
  return attempts.status();
}

}  // namespace dmpc::apps
