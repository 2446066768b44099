#include "dataflow/moving_units.h"

namespace dmpc::dataflow {

MovingUnits::MovingUnits(nodes::Node& node, const Plan& plan, const NodeDeal& deal, const core::DatabaseHeader& header,
                         Regions& regions)
    : regions_(&regions),
      pages_(node.memory(), plan.pages_of_node(nodes::index_of(node.id()))),
      primaries_(node.memory(), plan.primaries_of_node(nodes::index_of(node.id())), deal.primaries, deal.runs_of_unit,
                 deal.settings.first_samples()),
      movement_(node, plan, {&header, &regions, &pages_, &primaries_}) {
  pages_.begin_with(deal.pages, deal.records);
}

nodes::MemoryPlan MovingUnits::layout(const Plan& plan, std::uint32_t index) {
  return UnitPages::layout(plan.pages_of_node(index)) + UnitPrimaries::layout(plan.primaries_of_node(index)) +
         Movement::layout(plan);
}

void MovingUnits::receive(const nodes::Packet& packet, Termination& termination) {
  if (Kind{packet.kind} == Kind::unit_moved) {
    return movement_.take_news(packet.as<UnitMoved>());
  }
  termination.ray_packet_received();
  if (movement_.receive(packet)) {
    termination.ray_packet_sent();
  }
}

}  // namespace dmpc::dataflow
