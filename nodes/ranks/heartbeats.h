// Long work that does not involve other ranks, which need heartbeats meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/ranks/call_forwarder.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Receives and drops what arrives, and sends heartbeats. Throws LostRank as RankLinks do.
inline void send_heartbeat(RankLinks& links) {
  while (links.take([](std::uint32_t, const ItemHeader&, std::span<const std::byte>) {})) {
  }
  links.look_after();
}

/// Returns or throws what work() does. It runs on a separate thread, while the calling one, which communicates, sends heartbeats.
/// Others send nothing else meanwhile. Throws LostRank as RankLinks do, when the work is done.
template <class Work>
auto with_heartbeats(RankLinks& links, const Work& work) {
  const auto show = [&links] { send_heartbeat(links); };
  return CallForwarder().while_working(work, show, show);
}

}  // namespace dmpc::nodes
