// Long work that has nothing to do with other ranks, who are to know meanwhile that this one lives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/ranks/call_forwarder.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Takes what comes and drops it, and shows that this rank lives. Throws LostRank as RankLinks do.
inline void send_heartbeat(RankLinks& links) {
  while (links.take([](std::uint32_t, const ItemHeader&, std::span<const std::byte>) {})) {
  }
  links.look_after();
}

/// What work() returns or throws. It runs on a thread of its own, while the calling one, which communicates, shows that it lives.
/// Others say nothing meanwhile. Throws LostRank as RankLinks do, when the work is done.
template <class Work>
auto with_heartbeats(RankLinks& links, const Work& work) {
  const auto show = [&links] { send_heartbeat(links); };
  return CallForwarder().while_working(work, show, show);
}

}  // namespace dmpc::nodes
