#include "apps/frontend/run/computer_capacity.h"

#include <utility>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {

void check_room(const nodes::RankMemory& memory, const AvailableMemory& room) {
  const std::string host = memory.has_host ? " and the host" : "";
  const std::string network = memory.network.total() > 0 ? ", with what lies between ranks" : "";
  check_available_memory(memory.total(), counted(memory.node_count, "node") + host + network, room);
}

std::string network_text(const nodes::NetworkMemory& network) {
  std::string text = bytes_text(network.total()) + " of network memory";
  const char* separator = ": ";
  for (const auto& [name, bytes] : {std::pair{"outbox ", network.outbox_bytes}, std::pair{"frames sent ", network.sent_bytes},
                                    std::pair{"frames that have come ", network.arrived_bytes},
                                    std::pair{"what comes before the run ", network.stream_bytes}}) {
    if (bytes > 0) {
      text += separator + (name + bytes_text(bytes));
      separator = ", ";
    }
  }
  return text;
}

}  // namespace dmpc::apps
