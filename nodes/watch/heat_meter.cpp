#include "nodes/watch/heat_meter.h"

#include "nodes/threads/clock.h"

namespace dmpc::nodes {

void HeatMeter::begin(const HeatTotals& totals) {
  before_ = totals;
  clock_before_ps_ = clock_ps();
}

void HeatMeter::end(std::uint32_t pixel, std::uint32_t depth, const HeatTotals& totals) {
  const std::uint64_t clock_now_ps = clock_ps();
  map_->add(HeatKind::rays, pixel, totals.rays - before_.rays);
  map_->add(HeatKind::references, pixel, totals.references - before_.references);
  map_->add(HeatKind::faults, pixel, totals.faults - before_.faults);
  map_->add(HeatKind::pages, pixel, totals.pages - before_.pages);
  map_->add(HeatKind::time, pixel,
            machine_ != nullptr ? machine_->price_ps(before_.charges, totals.charges) : clock_now_ps - clock_before_ps_);
  map_->raise(HeatKind::depth, pixel, depth);
  before_ = totals;
  clock_before_ps_ = clock_now_ps;
}

/// 0 unless somebody wants to know.
std::uint64_t HeatMeter::clock_ps() const {
  return machine_ == nullptr && map_->has(HeatKind::time) ? nanoseconds(CLOCK_THREAD_CPUTIME_ID) * 1000 : 0;
}

}  // namespace dmpc::nodes
