#include "apps/computer/record.h"

#include <array>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/show/trace/perfetto.h"
#include "apps/frontend/show/trace/view.h"
#include "core/base/counts.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "svm/pages/packets.h"

namespace dmpc::apps {
namespace {

using ActivityNames = std::array<const char*, span_names.size()>;

/// Names of activities that are not operations of the program.
constexpr ActivityNames activity_names = {"compute", "compute", "compute",      "compute",    "compute",
                                          "compute", "serve",   "send packets", "take packet"};
constexpr ActivityNames task_activity_names = {"compute", "compute",    "install page", "compute",    "compute",
                                               "compute", "serve page", "send packets", "take packet"};

/// Links count frames and their bytes cumulatively, runners count the rest per run.
void add_ranks(std::vector<nodes::RankFigures>& sums, const std::vector<nodes::RankFigures>& more) {
  for (std::size_t rank = 0; rank < more.size(); ++rank) {
    const nodes::RankTraffic before = rank < sums.size() ? sums[rank].traffic : nodes::RankTraffic{};
    sums.resize(more.size());
    sums[rank] = more[rank];
    sums[rank].traffic.packets_sent += before.packets_sent;
    sums[rank].traffic.packets_received += before.packets_received;
    sums[rank].traffic.waves += before.waves;
  }
}

/// Returns "; 1,200 packets between 3 ranks"; empty without ranks.
std::string ranks_text(const std::vector<nodes::RankFigures>& ranks) {
  const std::uint64_t packets =
      core::sum_over<std::uint64_t>(ranks, [&](const nodes::RankFigures& rank) { return rank.traffic.packets_sent; });
  return ranks.empty() ? "" : "; " + counted(packets, "packet") + " between " + counted(ranks.size(), "rank");
}

/// Returns "83.5 us of virtual time, 12.0 % of it computing", or the same by the wall clock.
std::string time_text(const ProgramRecord& record, const ProgramNode& sum) {
  if (!record.virtual_ns) {
    return seconds_text(record.wall_seconds);
  }
  const auto total_ns = static_cast<double>(*record.virtual_ns);
  const double share = percent_of(static_cast<double>(sum.times.computing_ns), total_ns * record.node_count());
  return amount_text(total_ns, "ns") + " of virtual time, " + percent_text(share) + " of it computing";
}

std::string traffic_text(const ProgramRecord& record, const ProgramNode& sum) {
  if (!record.vocabulary.has_pages()) {
    const nodes::Traffic traffic = sent(record);
    return counted(traffic.packets, "packet") + ", " + bytes_text(traffic.bytes);
  }
  const double missed = percent_of(static_cast<double>(sum.pages.faults), static_cast<double>(sum.pages.references));
  return counted(sum.pages.references, "look-up") + ", " + percent_text(missed) + " of them faults; " +
         counted(record.tasks.page_count, "page") + ", " + grouped(record.tasks.cache_pages) + " in a cache";
}

std::vector<const char*> kind_names_of(const Vocabulary& vocabulary) {
  if (vocabulary.has_pages()) {
    return {svm::kind_names.begin(), svm::kind_names.end()};
  }
  return core::mapped<const char*>(vocabulary.packets, [&](const NamedPacket& packet) { return packet.name.c_str(); });
}

}  // namespace

ProgramNode& ProgramNode::operator+=(const ProgramNode& more) {
  core::add_counts(counters, more.counters);
  charges += more.charges;
  add_times(times, more.times);
  core::add_counts(pages, more.pages);
  memory = more.memory.total() > memory.total() ? more.memory : memory;
  return *this;
}

void ProgramRecord::add(const svm::TaskFigures& figures, const svm::TaskPlan& plan, std::uint32_t task_count) {
  nodes.resize(plan.node_count());
  for (std::uint32_t index = 0; index < plan.node_count(); ++index) {
    nodes[index] += {.counters = figures.counters[index],
                     .charges = figures.charges[index],
                     .times = {},
                     .pages = figures.pages[index],
                     .memory = plan.node_memory(index),
                     .used_bytes = {}};
  }
  if (figures.virtual_time) {
    add(*figures.virtual_time);
  }
  add_ranks(ranks, figures.ranks);
  ++tasks.run_count;
  tasks.task_count += task_count;
  tasks.page_count = plan.pages().page_count;
  tasks.cache_pages = plan.pages().cache.frame_count;
  tasks.last_pages = figures.all_pages();
}

void ProgramRecord::add(const nodes::VirtualReport& report) {
  virtual_ns = virtual_ns.value_or(0) + report.total_ns;
  run_hash = report.run_hash(run_hash.value_or(0));
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    add_times(nodes[node].times, report.nodes[node]);
  }
}

ProgramNode ProgramRecord::sum() const {
  ProgramNode sum;
  for (const ProgramNode& node : nodes) {
    sum += node;
  }
  return sum;
}

nodes::Traffic sent(const ProgramRecord& record) {
  const nodes::TrafficByKind by_kind = record.sum().counters.sent;
  nodes::Traffic all;
  for (const NamedPacket& packet : record.vocabulary.packets) {
    all += by_kind[packet.kind];
  }
  return all;
}

std::string computer_text(const ProgramOptions& options) {
  const nodes::Machine* const machine = options.computer.model();
  const std::string kind = options.runner == RunnerKind::mpi    ? " on ranks"
                           : options.runner == RunnerKind::pool ? " on a pool of threads"
                           : machine == nullptr                 ? " on threads"
                                                                : " of " + machine->name;
  return counted(options.computer.node_count, "node") + kind;
}

std::string summary(const ProgramRecord& record) {
  const ProgramNode sum = record.sum();
  return computer_text(record.options) + ": " + time_text(record, sum) + "; " + traffic_text(record, sum) +
         ranks_text(record.ranks) + "; " + bytes_text(sum.memory.total()) + " of memory a node\n";
}

void write_program_trace(const ProgramRecord& record, std::ostream& output) {
  core::expect(record.trace.has_value(), "a trace that is written was recorded");
  const Vocabulary& vocabulary = record.vocabulary;
  const std::vector<const char*> kind_names = kind_names_of(vocabulary);
  std::vector<const char*> operation_names(nodes::charge_count);
  for (const NamedOperation& operation : vocabulary.operations) {
    operation_names[operation.charge] = operation.name.c_str();
  }
  const bool is_whole = record.trace->events_lost == 0;
  const TraceView view = {.trace = *record.trace,
                          .kind_names = kind_names,
                          .has_pages = vocabulary.has_pages(),
                          .clock = record.options.is_modelled() ? "virtual time" : "wall clock",
                          .remarks = {{"program", record.name},
                                      {"computer", computer_text(record.options)},
                                      {"lost", is_whole ? "nothing" : lost_text(*record.trace)}},
                          .activity_names = vocabulary.has_pages() ? task_activity_names : activity_names,
                          .operation_names = operation_names};
  write_perfetto(view, output);
}

}  // namespace dmpc::apps
