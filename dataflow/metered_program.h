// The node program of dataflow with a meter: what each pixel takes, quantum by quantum. A type of its own, so that normal runs
// pay nothing for it.
#pragma once

#include "dataflow/program.h"
#include "nodes/watch/meter.h"

namespace dmpc::dataflow {

/// A quantum that works on a ray is that ray's pixel's; what rays cost when they come in, and sending what waits, is nobody's.
class MeteredProgram final : public NodeProgram {
 public:
  /// `meter` is this node's.
  MeteredProgram(nodes::Node& node, const Plan& plan, const NodeDeal& deal, const nodes::Meter& meter);

  bool work() override;

 private:
  nodes::HeatTotals totals() const { return {.rays = operations().ray_count(), .charges = charges()}; }

  nodes::Meter meter_;
};

}  // namespace dmpc::dataflow
