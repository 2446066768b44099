#include "dataflow/metered_program.h"

namespace dmpc::dataflow {

MeteredProgram::MeteredProgram(nodes::Node& node, const Plan& plan, const NodeDeal& deal, const nodes::Meter& meter)
    : NodeProgram(node, plan, deal), meter_(meter) {}

bool MeteredProgram::work() {
  const Task task = next_task(state());
  if (task != Task::start_primary && task != Task::take_received && task != Task::go_on) {
    perform(task);
    return rest_or_more();
  }
  meter_.begin(totals());
  perform(task);
  meter_.end(newest().pixel, newest().depth, totals());
  if (task == Task::start_primary && newest().sample == 0) {
    meter_.claim(newest().pixel);
  }
  return rest_or_more();
}

}  // namespace dmpc::dataflow
