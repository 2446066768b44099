#include "apps/run/ray_hops.h"

#include <cstdint>
#include <vector>

#include "dataflow/regions/mapping.h"

namespace dmpc::apps {

RayHops ray_hops_of(const dataflow::Report& report, nodes::TopologyKind topology) {
  const auto node_count = static_cast<std::uint32_t>(report.nodes.size());
  const std::vector<dataflow::Flow> flows = report.ray_flows();
  const nodes::Topology wiring(topology, node_count);
  return {dataflow::mean_hops(dataflow::identity_mapping(node_count), flows, wiring),
          dataflow::mean_hops_of_random(flows, wiring)};
}

}  // namespace dmpc::apps
