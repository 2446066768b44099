#include "apps/render/live_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

/// Share of `passed_ns` that was busy.
double part_of(std::uint64_t busy_ns, std::uint64_t passed_ns) {
  return passed_ns == 0 ? 0 : std::min(1.0, static_cast<double>(busy_ns) / static_cast<double>(passed_ns));
}

}  // namespace

LiveMoment::LiveMoment(std::uint64_t now_ms, const std::vector<nodes::LiveNode>& nodes) : ms(now_ms) {
  for (const nodes::LiveNode& node : nodes) {
    ns = std::max(ns, node.now_ns);
  }
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    busy.push_back(nodes[i].busy_ns);
  }
}

std::size_t LiveSteps::add(LiveMoment moment) {
  const std::uint64_t every = std::uint64_t{1} << doublings_;
  if (added_++ % every != 0) {
    return count();
  }
  moments_.push_back(std::move(moment));
  if (count() <= steps_max_) {
    return count() == 0 ? 0 : count() - 1;
  }
  std::vector<LiveMoment> kept;
  for (std::size_t i = 0; i < moments_.size(); i += 2) {
    kept.push_back(std::move(moments_[i]));
  }
  moments_ = std::move(kept);
  ++doublings_;
  return 0;
}

std::string LiveSteps::cells(std::size_t step) const {
  const LiveMoment &before = moments_[step], &after = moments_[step + 1];
  std::string text;
  for (std::size_t node = 0; node < after.busy.size(); ++node) {
    std::uint64_t sum_ns = 0, most_ns = 0;
    std::size_t most = 0;
    for (std::size_t work = 0; work < nodes::work_count; ++work) {
      const std::uint64_t busy_ns = after.busy[node][work] - before.busy[node][work];
      sum_ns += busy_ns;
      if (busy_ns > most_ns) {
        most_ns = busy_ns;
        most = work;
      }
    }
    const auto level = static_cast<std::size_t>(std::lround(levels_max * part_of(sum_ns, after.ns - before.ns)));
    text += static_cast<char>(level * nodes::work_count + most);
  }
  return text;
}

void LiveSteps::clear() {
  moments_.clear();
  doublings_ = 0;
  added_ = 0;
}

std::vector<double> shares_between(const LiveMoment& before, const LiveMoment& after) {
  nodes::WorkTimes sums{};
  for (std::size_t node = 0; node < after.busy.size(); ++node) {
    for (std::size_t work = 0; work < nodes::work_count; ++work) {
      sums[work] += after.busy[node][work] - before.busy[node][work];
    }
  }
  return core::mapped<double>(
      sums, [&](const std::uint64_t sum_ns) { return part_of(sum_ns, (after.ns - before.ns) * after.busy.size()); });
}

}  // namespace dmpc::apps
