#include "nodes/observers/activity_profile.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/flat_bytes.h"

namespace dmpc::nodes {

namespace {

constexpr std::uint64_t first_step_ns = 1024;

/// Times by category in steps of equal length, which doubles as a run goes on. `Times`: an array of nanoseconds by category.
template <class Times>
struct StepSums {
  std::vector<Times> steps;  ///< up to the last that is not empty

  /// Merges pairs of steps.
  void join_pairs() {
    const std::size_t count = (steps.size() + 1) / 2;
    for (std::size_t i = 0; i < count; ++i) {
      Times sum = steps[2 * i];
      for (std::size_t kind = 0; 2 * i + 1 < steps.size() && kind < sum.size(); ++kind) {
        sum[kind] += steps[2 * i + 1][kind];
      }
      steps[i] = sum;
    }
    steps.resize(count);
  }

  /// Spreads `own_ns` over the time from begin to end, rounded so that the sum is kept.
  void add(std::size_t kind, std::uint64_t step_ns, std::uint64_t begin_ns, std::uint64_t end_ns, std::uint64_t own_ns) {
    const std::size_t last = end_ns > begin_ns ? (end_ns - 1) / step_ns : begin_ns / step_ns;
    steps.resize(std::max(steps.size(), last + 1));
    std::uint64_t given_ns = 0;
    for (std::size_t step = begin_ns / step_ns; step <= last; ++step) {
      const std::uint64_t until_ns = std::min(end_ns, (step + 1) * step_ns);
      const double share = step == last ? 1 : static_cast<double>(until_ns - begin_ns) / static_cast<double>(end_ns - begin_ns);
      const std::uint64_t due_ns = step == last ? own_ns : static_cast<std::uint64_t>(share * static_cast<double>(own_ns));
      steps[step].at(kind) += due_ns - given_ns;
      given_ns = due_ns;
    }
  }
};

}  // namespace

/// One node's steps, on separate cache lines.
struct alignas(cache_line_bytes) ActivityProfile::Log {
  std::uint64_t step_ns = first_step_ns, end_ns = 0;
  StepSums<WorkTimes> works;
  StepSums<WaitTimes> waits;

  void double_steps() {
    works.join_pairs();
    waits.join_pairs();
    step_ns *= 2;
  }
  std::size_t step_count() const { return std::max(works.steps.size(), waits.steps.size()); }
};

ActivityProfile::ActivityProfile(std::uint32_t peer_count, WorkOf work_of, const WaitOf& wait_of, std::size_t step_count_max)
    : work_of_(std::move(work_of)), wait_of_(wait_of), step_count_max_(step_count_max), logs_(peer_count) {
  core::expect(step_count_max >= 2 && step_count_max % 2 == 0, "steps can be joined in pairs");
}

ActivityProfile::~ActivityProfile() = default;

ActivityProfile::Log& ActivityProfile::log_until(NodeId node, std::uint64_t end_ns) {
  Log& log = logs_[index_of(node)];
  log.end_ns = std::max(log.end_ns, end_ns);
  while (end_ns > log.step_ns * step_count_max_) {
    log.double_steps();
  }
  return log;
}

void ActivityProfile::ended(const Span& span, const Program& /*program*/) {
  Log& log = log_until(span.node, span.end_ns);
  if (span.own_ns > 0) {
    log.works.add(work_of_(span), log.step_ns, span.begin_ns, span.end_ns, span.own_ns);
  }
  if (span.received_ns > 0) {
    log.works.add(work_of_(span.taking_packets()), log.step_ns, span.begin_ns, span.end_ns, span.received_ns);
  }
}

void ActivityProfile::waited(const Waited& wait) {
  Log& log = log_until(wait.node, wait.end_ns);
  if (wait.own_ns > 0) {
    log.waits.add(wait_of_.at(wait.kind), log.step_ns, wait.begin_ns, wait.end_ns, wait.own_ns);
  }
}

std::string ActivityProfile::bytes() const {
  FlatWriter flat;
  for (std::uint32_t index = 0; index < logs_.size(); ++index) {
    const Log& log = logs_[index];
    if (log.step_count() > 0) {
      flat.put(index);
      flat.put(log.step_ns);
      flat.put(log.end_ns);
      flat.put_all(log.works.steps);
      flat.put_all(log.waits.steps);
    }
  }
  return flat.take();
}

void ActivityProfile::add(std::string_view bytes) {
  FlatReader flat(bytes);
  while (!flat.is_at_end()) {
    Log& log = logs_.at(flat.take<std::uint32_t>());
    core::expect(log.step_count() == 0, "a node is on one rank");
    log.step_ns = flat.take<std::uint64_t>();
    log.end_ns = flat.take<std::uint64_t>();
    log.works.steps = flat.take_all<WorkTimes>();
    log.waits.steps = flat.take_all<WaitTimes>();
  }
}

ActivitySteps ActivityProfile::take() {
  ActivitySteps all;
  std::size_t count = 0;
  for (Log& log : logs_) {
    all.step_ns = std::max(all.step_ns, log.step_ns);
    all.end_ns = std::max(all.end_ns, log.end_ns);
  }
  for (Log& log : logs_) {
    while (log.step_ns < all.step_ns) {
      log.double_steps();
    }
    count = std::max(count, log.step_count());
  }
  for (Log& log : logs_) {
    log.works.steps.resize(count);
    log.waits.steps.resize(count);
    all.nodes.push_back(std::move(log.works.steps));
    all.waits.push_back(std::move(log.waits.steps));
  }
  return all;
}

}  // namespace dmpc::nodes
