#include "apps/computer/program_page.h"

#include <iostream>

#include "apps/computer/page_parts.h"
#include "apps/computer/program_tables.h"
#include "apps/computer/program_work.h"
#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {
namespace {

Facts facts_of(const ProgramRecord& record) {
  Facts facts = computer_facts(record.options);
  const nodes::Traffic all = sent(record);
  facts.emplace_back("Packets sent", grouped(all.packets) + ", " + amount_text(static_cast<double>(all.bytes), "bytes"));
  facts.emplace_back("It took", seconds_text(record.wall_seconds) + " by the wall clock");
  if (record.virtual_time) {
    facts.emplace_back("Virtual time", amount_text(static_cast<double>(record.virtual_time->total_ns), "ns"));
  }
  return facts;
}

void add_pairs(Page& page, const ProgramRecord& record) {
  if (const auto& pairs = record.view->pairs; pairs && record.plan.node_count() > 1) {
    page.add_map(pair_map(pairs->packets, "Who sent packets to whom", "node that sends", "node that receives", "packets"), "");
    NumberMap bytes = pair_map(pairs->bytes, "Who sent bytes to whom", "node that sends", "node that receives", "");
    bytes.unit = "bytes";
    page.add_map(bytes, "");
  }
}

void add_packets(Page& page, const ProgramRecord& record) {
  page.begin_section("Packets");
  const std::vector<PacketKindTraffic> packets = packets_of(record);
  page.add_conclusion(traffic_conclusion(packets, record.virtual_time ? &*record.virtual_time : nullptr));
  if (sent(record).packets == 0) {
    return;
  }
  page.add_table(packet_table(packets));
  add_pairs(page, record);
  add_ranks(page, record.ranks);
  if (record.virtual_time) {
    page.add_text(way_text(record.virtual_time->links));
    const Table table = link_table(*record.virtual_time);
    page.add_plot(link_plot(), table);
    page.add_table(table);
  }
}

void add_nodes(Page& page, const ProgramRecord& record) {
  page.begin_section("Nodes");
  page.add_conclusion(node_conclusion(record));
  const Table table = node_table(record);
  add_node_plot(page, record.nodes.size(), packet_plot(), table);
  page.add_table(table);
}

void add_memory(Page& page, const ProgramRecord& record) {
  page.begin_section("Memory");
  page.add_conclusion(memory_conclusion(record));
  const Table table = memory_table(record);
  add_node_plot(page, record.nodes.size(), memory_plot(record), table);
  page.add_table(table);
}

Facts results_of(const ProgramRecord& record) {
  return record.virtual_time ? Facts{{"run", hash_text(record.virtual_time->run_hash(0))}} : Facts();
}

}  // namespace

void write_program_page(const ProgramRecord& record, std::ostream& output) {
  core::expect(record.view.has_value(), "a page that is written was looked on for");
  const Origin origin = program_origin(record.name);
  Page page("Run of " + record.name, std::cerr, speaker(record.name));
  begin_page(page, origin, facts_of(record), record.result, record.plan.node_count());
  add_losses(page, losses_of(record));
  add_steps(page, record.view->steps, packet_work(record.plan.needs().operations).names, "");
  add_packets(page, record);
  add_operations(page, operations_of(record), record.options.computer.model());
  add_nodes(page, record);
  add_memory(page, record);
  page.add_origin(origin, results_of(record));
  output << page.text();
}

}  // namespace dmpc::apps::html
