#include "apps/computer/paged_page.h"

#include <iostream>
#include <string>

#include "apps/computer/page_parts.h"
#include "apps/computer/paged_tables.h"
#include "apps/computer/program_work.h"
#include "apps/computer/readable_nodes.h"
#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/view_conclusions.h"
#include "core/base/expect.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {
namespace {

Facts facts_of(const PagedRecord& record) {
  const svm::TaskOptions& tasks = record.options.tasks;
  Facts facts = computer_facts(record.options.program);
  facts.emplace_back("Tasks", grouped(record.task_count) + " in " + counted(record.run_count, "run"));
  facts.emplace_back("Data", counted(record.page_count, "page") + " of " + nodes::size_text(tasks.page_size_bytes));
  facts.emplace_back("Cache of a node",
                     counted(record.cache_pages, "page") + ", replaced by " + std::string(name_of(tasks.replacement)));
  facts.emplace_back("Tasks in flight on a node", "up to " + grouped(tasks.in_flight));
  facts.emplace_back("Memory of the fullest node", bytes_text(record.sum().memory_bytes));
  facts.emplace_back("They took", seconds_text(record.wall_seconds) + " by the wall clock");
  if (record.virtual_ns) {
    facts.emplace_back("Virtual time", amount_text(static_cast<double>(*record.virtual_ns), "ns"));
  }
  return facts;
}

/// Of which run it is what was watched; nothing if there was only one.
std::string remark_on_runs(const PagedRecord& record) {
  return record.run_count == 1 ? "" : "Of the last of " + counted(record.run_count, "run") + ".";
}

void begin_watched(Page& page, const PagedRecord& record, const std::string& heading, const std::string& conclusion) {
  page.begin_section(heading);
  page.add_conclusion(conclusion);
  if (const std::string remark = remark_on_runs(record); !remark.empty()) {
    page.add_text(remark);
  }
}

void add_heat(Page& page, const PagedRecord& record) {
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

void add_misses(Page& page, const PagedRecord& record) {
  const MissEstimate& misses = *record.view->misses;
  begin_watched(page, record, "Other caches", cache_conclusion(misses, record.cache_pages, record.page_count));
  const Table table =
      miss_table(misses, record.page_count, record.last_pages.references, record.cache_pages, record.last_pages.faults);
  page.add_plot(miss_plot(), table);
  page.add_table(table);
}

void add_fetches(Page& page, const PagedRecord& record) {
  const svm::Fetches& fetches = *record.view->fetches;
  begin_watched(page, record, "Fetching a page", fetch_conclusion(fetches));
  const Table table = fetch_table(fetches);
  page.add_plot(fetch_plot(fetches), table);
  page.add_table(table);
  page.add_table(fetch_part_table(fetches));
}

void add_pages(Page& page, const PagedRecord& record) {
  const svm::Fetches& fetches = *record.view->fetches;
  begin_watched(page, record, "Pages", page_conclusion(record.last_pages, fetches));
  if (record.last_pages.faults == 0) {
    return;
  }
  if (record.nodes.size() <= readable_nodes_max) {
    page.add_map(pair_map(fetches.by_pair, "Who fetched pages from whom", "node that asks", "home of the page", "fetches"), "");
  }
  page.add_plot(page_share_plot(), page_share_table(fetches));
  page.add_table(page_table(fetches));
  add_fetches(page, record);
  add_misses(page, record);
}

void add_nodes(Page& page, const PagedRecord& record) {
  page.begin_section("Nodes");
  const Table table = node_table(record);
  if (record.sum().pages.faults > 0) {
    add_node_plot(page, record.nodes.size(), fault_plot(), table);
  }
  page.add_table(table);
}

void add_packets(Page& page, const PagedRecord& record) {
  page.begin_section("Packets");
  const std::vector<PacketKindTraffic> packets = packets_of(record);
  page.add_conclusion(traffic_conclusion(packets, nullptr));
  if (record.sum().pages.faults > 0) {
    page.add_table(packet_table(packets));
  }
  add_ranks(page, record.ranks);
}

Facts results_of(const PagedRecord& record) { return record.run_hash ? Facts{{"run", hash_text(*record.run_hash)}} : Facts(); }

}  // namespace

void write_paged_page(const PagedRecord& record, std::ostream& output) {
  core::expect(record.view.has_value(), "a page that is written was looked on for");
  const Origin origin = program_origin(record.name);
  Page page("Run of " + record.name, std::cerr, speaker(record.name));
  begin_page(page, origin, facts_of(record), record.result, record.options.program.computer.node_count);
  if (record.run_count > 1) {
    page.add_text("Times and counters are of all " + counted(record.run_count, "run") +
                  " together, where it does not say otherwise.");
  }
  add_losses(page, losses_of(record));
  add_steps(page, record.view->steps, task_work(record.operations).names, remark_on_runs(record));
  add_heat(page, record);
  add_pages(page, record);
  add_nodes(page, record);
  add_operations(page, operations_of(record), record.options.program.computer.model());
  add_packets(page, record);
  page.add_origin(origin, results_of(record));
  output << page.text();
}

}  // namespace dmpc::apps::html
