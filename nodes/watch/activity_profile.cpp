#include "nodes/watch/activity_profile.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/flat_bytes.h"

namespace dmpc::nodes {

namespace {

constexpr std::uint64_t first_step_ns = 1024;

}  // namespace

/// One node's steps, on cache lines of their own.
struct alignas(cache_line_bytes) ActivityProfile::Log {
  std::uint64_t step_ns = first_step_ns;
  std::vector<WorkTimes> steps;

  /// Two steps become one.
  void double_steps() {
    const std::size_t count = (steps.size() + 1) / 2;
    for (std::size_t i = 0; i < count; ++i) {
      WorkTimes sum = steps[2 * i];
      for (std::size_t work = 0; 2 * i + 1 < steps.size() && work < sum.size(); ++work) {
        sum[work] += steps[2 * i + 1][work];
      }
      steps[i] = sum;
    }
    steps.resize(count);
    step_ns *= 2;
  }

  /// `own_ns` spread over the time from begin to end, rounded so that nothing is lost.
  void add(std::size_t work, std::uint64_t begin_ns, std::uint64_t end_ns, std::uint64_t own_ns) {
    const std::size_t last = end_ns > begin_ns ? (end_ns - 1) / step_ns : begin_ns / step_ns;
    steps.resize(std::max(steps.size(), last + 1));
    std::uint64_t given_ns = 0;
    for (std::size_t step = begin_ns / step_ns; step <= last; ++step) {
      const std::uint64_t until_ns = std::min(end_ns, (step + 1) * step_ns);
      const double share = step == last ? 1 : static_cast<double>(until_ns - begin_ns) / static_cast<double>(end_ns - begin_ns);
      const std::uint64_t due_ns = step == last ? own_ns : static_cast<std::uint64_t>(share * static_cast<double>(own_ns));
      steps[step].at(work) += due_ns - given_ns;
      given_ns = due_ns;
    }
  }
};

ActivityProfile::ActivityProfile(std::uint32_t peer_count, WorkOf work_of, std::size_t step_count_max)
    : work_of_(std::move(work_of)), step_count_max_(step_count_max) {
  core::expect(step_count_max >= 2 && step_count_max % 2 == 0, "steps can be joined in pairs");
  for (std::uint32_t i = 0; i < peer_count; ++i) {
    logs_.push_back(std::make_unique<Log>());
  }
}

ActivityProfile::~ActivityProfile() = default;

void ActivityProfile::ended(const Span& span, const Program& /*program*/) {
  Log& log = *logs_[index_of(span.node)];
  while (span.end_ns > log.step_ns * step_count_max_) {
    log.double_steps();
  }
  if (span.own_ns > 0) {
    log.add(work_of_(span), span.begin_ns, span.end_ns, span.own_ns);
  }
}

std::string ActivityProfile::bytes() const {
  FlatWriter flat;
  for (std::uint32_t index = 0; index < logs_.size(); ++index) {
    if (!logs_[index]->steps.empty()) {
      flat.put(index);
      flat.put(logs_[index]->step_ns);
      flat.put_all(logs_[index]->steps);
    }
  }
  return flat.take();
}

void ActivityProfile::add(std::string_view bytes) {
  FlatReader flat(bytes);
  while (!flat.is_at_end()) {
    Log& log = *logs_.at(flat.take<std::uint32_t>());
    core::expect(log.steps.empty(), "a node is on one rank");
    log.step_ns = flat.take<std::uint64_t>();
    log.steps = flat.take_all<WorkTimes>();
  }
}

ActivitySteps ActivityProfile::take() {
  ActivitySteps all;
  std::size_t count = 0;
  for (const auto& log : logs_) {
    all.step_ns = std::max(all.step_ns, log->step_ns);
  }
  for (const auto& log : logs_) {
    while (log->step_ns < all.step_ns) {
      log->double_steps();
    }
    count = std::max(count, log->steps.size());
  }
  for (const auto& log : logs_) {
    log->steps.resize(count);
    all.nodes.push_back(std::move(log->steps));
  }
  return all;
}

}  // namespace dmpc::nodes
