#include "nodes/observers/meter.h"

#include "nodes/threads/clock.h"

namespace dmpc::nodes {

void Meter::begin(const HeatTotals& totals) {
  if (map_ != nullptr) {
    before_ = totals;
    clock_before_ps_ = clock_ps();
  }
}

void Meter::end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals) {
  if (map_ != nullptr) {
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
  if (observer_ != nullptr) {
    observer_->worked({self_, item, depth});
  }
}

void Meter::claim(std::uint32_t item) {
  if (map_ != nullptr) {
    map_->set(map_->node(), item, index_of(self_));
  }
}

/// 0 unless an observer needs it.
std::uint64_t Meter::clock_ps() const {
  return machine_ == nullptr && map_->has(map_->time()) ? nanoseconds(CLOCK_THREAD_CPUTIME_ID) * 1000 : 0;
}

}  // namespace dmpc::nodes
