#include "apps/computer/page_parts.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "apps/computer/record.h"
#include "apps/frontend/run/time_parts.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {
namespace {

/// Replaces dmpc's own explanations, which mention rays and pictures, for any program.
constexpr std::array own_words = {
    GlossaryEntry{"chaos", "A seed disturbs the computer: packets are delayed, nodes pause, credits shrink."},
    GlossaryEntry{"computing", "Time in which a node's program works, by the operations that it charges."},
    GlossaryEntry{"home", "The node that keeps a page for good and sends it on request."},
    GlossaryEntry{"hop", "A step of a message over one link."},
    GlossaryEntry{"look-up", "A request for one place in the data, and so for the page that holds it."},
    GlossaryEntry{"miss", "A look-up that does not find its page. Several misses that wait for one page are one fault."},
    GlossaryEntry{"packet", "A message between two nodes: a short header and what the program puts into it."},
    GlossaryEntry{"page", "A numbered piece of the data, all of one size."},
    GlossaryEntry{"refused", "Packets that a program tried to send without credit."},
    GlossaryEntry{"run hash", "A digest of all events in virtual time and the machine: equal runs have equal hashes."},
    GlossaryEntry{"virtual time", "The modelled machine's clock. It does not depend on the computer that the program runs on."},
    GlossaryEntry{"wall clock", "Time on the computer that the program runs on."},
    GlossaryEntry{"step", "One call of a task; if its page is absent, the task is called again when the page has arrived."},
};

/// Terms whose explanations in dmpc apply to any program.
constexpr std::array<std::string_view, 14> common_words = {
    "asleep", "cache", "eviction",         "fault",          "fetch",   "lru", "node", "idle at the end", service_idle_words,
    "link",   "p95",   service_busy_words, "stack distance", "topology"};

std::vector<GlossaryEntry> all_words() {
  std::vector<GlossaryEntry> all(own_words.begin(), own_words.end());
  for (const GlossaryEntry& entry : glossary()) {
    if (std::find(common_words.begin(), common_words.end(), entry.word) != common_words.end()) {
      all.push_back(entry);
    }
  }
  std::sort(all.begin(), all.end(), [](const GlossaryEntry& a, const GlossaryEntry& b) { return a.word < b.word; });
  return all;
}

}  // namespace

std::span<const GlossaryEntry> page_words() {
  static const std::vector<GlossaryEntry> all = all_words();
  return all;
}

void begin_page(Page& page, const Origin& origin, const Facts& facts, const std::string& result, std::uint32_t node_count) {
  page.add_text(origin.program + ", " + origin.date);
  page.add_facts(facts);
  if (node_count > readable_nodes_max) {
    page.add_text("The traffic of pairs is shown of up to " + std::to_string(readable_nodes_max) +
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

}  // namespace dmpc::apps::html
