#include "dataflow/next_stop.h"

namespace dmpc::dataflow {

NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const core::GridFrame& frame, const Bsp& bsp,
                   core::Operations& operations) {
  NextStop stop{.passage = passage, .region = bsp.region_index_of(passage.cell)};
  while (stop.traced == core::Traced::left && bsp.is_empty(stop.region)) {
    stop.traced = core::pass(ray, frame, bsp.region_at(stop.region), stop.passage, operations);
    ++operations.skipped.empty_regions;
    stop.region = bsp.region_index_of(stop.passage.cell);
  }
  return stop;
}

}  // namespace dmpc::dataflow
