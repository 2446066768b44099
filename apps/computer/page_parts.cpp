#include "apps/computer/page_parts.h"

#include <utility>

#include "apps/computer/page_words.h"
#include "apps/computer/readable_nodes.h"
#include "apps/computer/record.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/node_bands.h"
#include "apps/edge/show/page/traffic.h"
#include "apps/edge/show/page/view_conclusions.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {

PageSpeaker speaker(const std::string& name) { return {.name = name, .words = page_words()}; }

void begin_page(Page& page, const Origin& origin, const Facts& facts, const std::string& result, std::uint32_t node_count) {
  page.add_text(origin.program + ", " + origin.date);
  page.add_facts(facts);
  if (node_count > readable_nodes_max) {
    page.add_text("Who sends whom how much is shown of up to " + std::to_string(readable_nodes_max) +
                  " nodes: the tables have all of them.");
  }
  if (!result.empty()) {
    page.begin_section("What it came to");
    page.add_code(result);
  }
}

Origin program_origin(const std::string& name) {
  Origin origin = this_origin();
  origin.program = name + " on " + origin.program;
  return origin;
}

Facts computer_facts(const ProgramOptions& options) {
  const std::string where = options.runner == RunnerKind::mpi ? " on ranks" : "";
  Facts facts = {{"Computer", computer_text(options)}, {"Runner", runner_text(options.computer, where)}};
  if (options.chaos_seed) {
    facts.emplace_back("Chaos", "disturbed by seed " + std::to_string(*options.chaos_seed));
  }
  if (options.computer.node_memory_bytes) {
    facts.emplace_back("Bound of a node's memory", nodes::size_text(*options.computer.node_memory_bytes));
  }
  return facts;
}

Table operation_table(const std::vector<OperationCount>& operations, const nodes::Machine* machine) {
  std::vector<Column> columns = {{"operation", "", 0}, {"count", "", 0}, {"each on a core of today", "ns", 1}};
  if (machine != nullptr) {
    columns.insert(columns.end(), {{"each on this machine", "ns", 1}, {"all of them", "ms", 3}});
  }
  Table table("Operations", std::move(columns));
  for (const auto& [name, count, today_ns, each_ps] : operations) {
    std::vector<Cell> row = {name, count, today_ns ? Cell(*today_ns) : Cell()};
    if (machine != nullptr) {
      const double each_ns = static_cast<double>(each_ps) / 1000;
      row.insert(row.end(), {each_ns, each_ns * static_cast<double>(count) / 1e6});
    }
    table.add_row(std::move(row));
  }
  return table;
}

void add_operations(Page& page, const std::vector<OperationCount>& operations, const nodes::Machine* machine) {
  if (!operations.empty()) {
    page.begin_section("Operations");
    page.add_table(operation_table(operations, machine));
  }
}

void add_ranks(Page& page, const std::vector<nodes::RankFigures>& ranks) {
  if (!ranks.empty()) {
    page.add_table(rank_table(ranks));
  }
}

void add_losses(Page& page, const Losses& losses) {
  page.begin_section("Where the time went");
  page.add_conclusion(loss_conclusion(losses));
  const Table table = loss_table(losses);
  add_node_plot(page, loss_plot(losses), table);
  page.add_table(table);
}

void add_steps(Page& page, const nodes::ActivitySteps& steps, const std::vector<std::string>& work_names,
               const std::string& remark) {
  if (steps.nodes.front().empty()) {
    return;
  }
  page.begin_section("Over time");
  page.add_conclusion(time_conclusion(steps));
  if (!remark.empty()) {
    page.add_text(remark);
  }
  const Table table = step_table(steps, work_names);
  page.add_plot(step_plot(steps, work_names), table);
  page.add_map(step_map(steps), "Each row is a node, each column a step of time: the darker, the less it did.");
  page.add_table(table);
}

}  // namespace dmpc::apps::html
