#include "apps/frontend/show/stats/counters_json.h"

namespace dmpc::apps {

nlohmann::ordered_json ranks_json(std::span<const nodes::RankFigures> ranks, bool is_observed) {
  using Json = nlohmann::ordered_json;
  Json result;
  for (const nodes::RankFigures& rank : ranks) {
    const nodes::NetworkMemory& network = rank.memory.network;
    result.push_back({{"name", rank.name},
                      {"nodes", rank.memory.node_count},
                      {"node_memory", rank.memory.nodes_bytes},
                      {"network_memory",
                       {{"outbox", network.outbox_bytes},
                        {"frames_sent", network.sent_bytes},
                        {"frames_arrived", network.arrived_bytes},
                        {"stream", network.stream_bytes},
                        {"total", network.total()}}},
                      {"packets", {{"sent", rank.traffic.packets_sent}, {"received", rank.traffic.packets_received}}},
                      {"frames_sent", rank.traffic.frames_sent},
                      {"bytes_sent", rank.traffic.bytes_sent},
                      {"waves", rank.traffic.waves},
                      {"clock_error", is_observed ? Json(static_cast<double>(rank.clock.error_ns()) * 1e-9) : Json()}});
  }
  return result;
}

}  // namespace dmpc::apps
