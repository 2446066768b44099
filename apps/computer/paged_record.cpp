#include "apps/computer/paged_record.h"

#include <algorithm>
#include <array>

#include "apps/computer/record.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/run/time_parts.h"
#include "apps/edge/show/trace/view.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "svm/pages/packets.h"

namespace dmpc::apps {
namespace {

/// What a node does without an operation of its tasks.
constexpr std::array<const char*, span_names.size()> task_activity_names = {
    "compute", "compute", "install page", "compute", "compute", "compute", "serve page", "send packets", "take packet"};

/// Links count frames and their bytes from the beginning, runners the rest in each run.
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

}  // namespace

PagedNode& PagedNode::operator+=(const PagedNode& more) {
  pages += more.pages;
  charges += more.charges;
  requests += more.requests;
  replies += more.replies;
  add_times(times, more.times);
  clock.busy_ns += more.clock.busy_ns;
  clock.asleep_ns += more.clock.asleep_ns;
  clock.wall_ns += more.clock.wall_ns;
  memory_bytes = std::max(memory_bytes, more.memory_bytes);
  return *this;
}

void PagedRecord::add(const svm::TaskFigures& figures, const svm::TaskPlan& plan, std::uint32_t tasks) {
  nodes.resize(plan.node_count());
  for (std::uint32_t index = 0; index < plan.node_count(); ++index) {
    const nodes::NodeCounters& counters = figures.counters[index];
    nodes[index] += {.pages = figures.pages[index],
                     .charges = figures.charges[index],
                     .requests = counters.sent[number_of(svm::Kind::page_request)],
                     .replies = counters.sent[number_of(svm::Kind::page_reply)],
                     .times = figures.virtual_time ? figures.virtual_time->nodes[index] : nodes::VirtualTimes{},
                     .clock = counters,
                     .memory_bytes = plan.node_memory(index).total()};
  }
  if (figures.virtual_time) {
    virtual_ns = virtual_ns.value_or(0) + figures.virtual_time->total_ns;
    run_hash = figures.virtual_time->run_hash(run_hash.value_or(0));
  }
  add_ranks(ranks, figures.ranks);
  ++run_count;
  task_count += tasks;
  page_count = plan.pages().page_count;
  cache_pages = plan.pages().cache.frame_count;
  last_pages = figures.all_pages();
}

PagedNode PagedRecord::sum() const {
  PagedNode sum;
  for (const PagedNode& node : nodes) {
    sum += node;
  }
  return sum;
}

std::string summary(const PagedRecord& record) {
  const PagedNode sum = record.sum();
  const double missed = percent_of(static_cast<double>(sum.pages.faults), static_cast<double>(sum.pages.references));
  return computer_text(record.options.program) + ": " +
         (record.virtual_ns
              ? virtual_time_text(*record.virtual_ns, sum.times.computing_ns, record.options.program.computer.node_count)
              : seconds_text(record.wall_seconds)) +
         "; " + counted(sum.pages.references, "look-up") + ", " + percent_text(missed) + " of them faults; " +
         counted(record.page_count, "page") + ", " + grouped(record.cache_pages) + " in a cache" + ranks_text(record.ranks) +
         "; " + bytes_text(sum.memory_bytes) + " of memory a node\n";
}

void write_trace(const PagedRecord& record, std::ostream& output) {
  core::expect(record.trace.has_value(), "a trace that is written was recorded");
  std::array<const char*, nodes::charge_count> operation_names{};
  for (Index i = 0; i < record.operations.size(); ++i) {
    operation_names[static_cast<std::size_t>(charge_of(i))] = record.operations[i].name.c_str();
  }
  write_view({.trace = *record.trace,
              .kind_names = svm::kind_names,
              .has_pages = true,
              .activity_names = task_activity_names,
              .operation_names = operation_names},
             record.name, record.options.program, output);
}

}  // namespace dmpc::apps
