#include "nodes/observers/wait_log.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "core/base/expect.h"
#include "nodes/atomics.h"

namespace dmpc::nodes {

namespace {

std::uint64_t length_ns(const Waited& wait) { return wait.end_ns - wait.begin_ns; }

/// Keeps only the `count_max` longest, among equal ones the first, in order; returns the longest that is dropped.
std::uint64_t keep_longest(std::vector<Waited>& waits, std::size_t count_max) {
  std::vector<std::uint64_t> lengths;
  std::transform(waits.begin(), waits.end(), std::back_inserter(lengths), length_ns);
  const auto out = lengths.begin() + static_cast<std::ptrdiff_t>(count_max);
  std::nth_element(lengths.begin(), out, lengths.end(), std::greater());
  const std::uint64_t left_out_ns = *out;
  auto equal_kept = std::count(lengths.begin(), out, left_out_ns);
  std::erase_if(waits, [&](const Waited& wait) {
    return length_ns(wait) < left_out_ns || (length_ns(wait) == left_out_ns && equal_kept-- <= 0);
  });
  return left_out_ns;
}

}  // namespace

/// One node's waits, on separate cache lines.
struct alignas(cache_line_bytes) WaitLog::Log {
  std::vector<Waited> waits;
  std::uint64_t count = 0;
  std::uint64_t left_out_ns_max = 0;
};

WaitLog::WaitLog(std::uint32_t peer_count, std::size_t node_waits_max) : node_waits_max_(node_waits_max), logs_(peer_count) {
  core::expect(node_waits_max >= 2, "half of the waits can be kept");
}

WaitLog::~WaitLog() = default;

void WaitLog::waited(const Waited& wait) {
  Log& log = logs_[index_of(wait.node)];
  ++log.count;
  if (log.left_out_ns_max > 0 && length_ns(wait) <= log.left_out_ns_max) {
    return;
  }
  log.waits.push_back(wait);
  if (log.waits.size() > node_waits_max_) {
    log.left_out_ns_max = keep_longest(log.waits, node_waits_max_ / 2);
  }
}

WaitRecord WaitLog::take(std::size_t count_max) {
  WaitRecord all;
  for (Log& log : logs_) {
    all.waits.insert(all.waits.end(), log.waits.begin(), log.waits.end());
    all.count += log.count;
    all.left_out_ns_max = std::max(all.left_out_ns_max, log.left_out_ns_max);
    log.waits = {};
  }
  if (all.waits.size() > count_max) {
    all.left_out_ns_max = std::max(all.left_out_ns_max, keep_longest(all.waits, count_max));
  }
  return all;
}

}  // namespace dmpc::nodes
