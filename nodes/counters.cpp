#include "nodes/counters.h"

namespace dmpc::nodes {

TrafficByKind& operator+=(TrafficByKind& sum, const TrafficByKind& more) {
  for (std::size_t kind = 0; kind < sum.size(); ++kind) {
    sum[kind] += more[kind];
  }
  return sum;
}

Traffic total(const TrafficByKind& traffic) {
  Traffic sum;
  for (const Traffic& kind : traffic) {
    sum += kind;
  }
  return sum;
}

}  // namespace dmpc::nodes
