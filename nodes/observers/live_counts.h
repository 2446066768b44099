// What each node has done so far, readable during the run; an instrument outside of the computer, whose memory is no node's.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/observer.h"
#include "nodes/observers/activity_profile.h"

namespace dmpc::nodes {

struct LiveNode {
  std::uint64_t now_ns = 0;  ///< the end of the last thing that it did
  WorkTimes busy_ns{};
  std::uint64_t packets_sent = 0, bytes_sent = 0;  ///< bytes of payloads
};

/// Each number is written by one thread at a time, its node's, and read by any, without waiting; numbers of one node that are
/// read together may be of moments that are a call apart. Thread safety: as an Observer; read() from any thread at any time.
class LiveCounts final : public Observer {
 public:
  /// `peer_count` = nodes + host.
  LiveCounts(std::uint32_t peer_count, WorkOf work_of);
  ~LiveCounts() override;

  void ended(const Span& span, const Program& program) override;
  void sent(const Passing& packet) override;

  /// By number, the host last.
  std::vector<LiveNode> read() const;
  /// To be called before another run: all is 0. Requires that nothing is reported meanwhile.
  void clear();

 private:
  struct Node;

  WorkOf work_of_;
  std::vector<Node> nodes_;
};

}  // namespace dmpc::nodes
