#include "nodes/watch/heat_meter.h"

#include "nodes/threads/clock.h"

namespace dmpc::nodes {

void HeatMeter::begin(const HeatTotals& totals) {
  before_ = totals;
  clock_before_ps_ = clock_ps();
}

void HeatMeter::end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals) {
  const std::uint64_t clock_now_ps = clock_ps();
  for (std::size_t kind = 0; kind < heat_kind_count; ++kind) {
    map_->add(HeatNumber(kind), item, totals.counts[kind] - before_.counts[kind]);
  }
  map_->add(map_->time(), item,
            machine_ != nullptr ? machine_->price_ps(before_.charges, totals.charges) : clock_now_ps - clock_before_ps_);
  map_->raise(map_->depth(), item, depth);
  before_ = totals;
  clock_before_ps_ = clock_now_ps;
}

/// 0 unless somebody wants to know.
std::uint64_t HeatMeter::clock_ps() const {
  return machine_ == nullptr && map_->has(map_->time()) ? nanoseconds(CLOCK_THREAD_CPUTIME_ID) * 1000 : 0;
}

}  // namespace dmpc::nodes
