#include "nodes/counters.h"

namespace dmpc::nodes {

Traffic total(const std::array<Traffic, packet_kind_count>& traffic) {
  Traffic sum;
  for (const Traffic& kind : traffic) {
    sum.packets += kind.packets;
    sum.bytes += kind.bytes;
  }
  return sum;
}

}  // namespace dmpc::nodes
