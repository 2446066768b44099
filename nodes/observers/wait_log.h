// The longest waits of a run, with the cause of the end of each; an instrument outside of the computer, whose memory is no
// node's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/observer.h"

namespace dmpc::nodes {

struct WaitRecord {
  /// By node, then in order of time.
  std::vector<Waited> waits;
  std::uint64_t count = 0;            ///< number of all waits
  std::uint64_t left_out_ns_max = 0;  ///< the longest that is not included; all longer ones are
};

/// Keeps waits where paths are followed. Thread safety: as an Observer; take() when the run is over.
class WaitLog final : public Observer {
 public:
  /// `peer_count` = nodes + host. `node_waits_max`, at least 2, is the number kept per node during the run.
  WaitLog(std::uint32_t peer_count, std::size_t node_waits_max);
  ~WaitLog() override;

  void waited(const Waited& wait) override;
  bool follows_paths() const override { return true; }

  /// At most `count_max` of all nodes together. Call it once.
  WaitRecord take(std::size_t count_max);

 private:
  struct Log;

  std::size_t node_waits_max_;
  std::vector<Log> logs_;  ///< by node
};

}  // namespace dmpc::nodes
