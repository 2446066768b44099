// What ranks that all run one program tell each other between its runs.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "nodes/ranks/call_forwarder.h"
#include "nodes/ranks/heartbeats.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/streams.h"

namespace dmpc::apps {

/// All ranks call agree(), meet() and share() in the same order, unless agree() finds that they do not. On rank 0 an error of
/// another rank is thrown; on the others nodes::Dismissed, if rank 0 has ended; on all nodes::LostRank. Thread safety: belongs to
/// the communicating thread, except here().
class RankRounds {
 public:
  /// `links` outlive this.
  explicit RankRounds(nodes::RankLinks& links);

  nodes::RankLinks& links() { return links_; }
  bool is_first() const { return links_.rank() == 0; }

  /// What work() returns or throws, on a thread of its own: others know meanwhile that this rank lives.
  template <class Work>
  auto apart(const Work& work) {
    return call_forwarder_.while_working(
        work, [this] { look_after(); }, [this] { nodes::send_heartbeat(links_); });
  }
  /// From work apart: what is to be done on the communicating thread. After one that fails none is done any more, and all fail
  /// so: this rank and others would not know of each other where they are.
  void here(const std::function<void()>& forwarded_call);

  /// What comes next is the same on all ranks: throws ProgramError where it is not rank 0's.
  void agree(const std::string& next);
  /// Waits until all have come here.
  void meet();
  /// Rank 0's bytes, of which there are as many everywhere, are everybody's.
  void share(std::span<std::byte> bytes);

 private:
  void expect_no_failure() const;
  void look_after();

  nodes::RankLinks& links_;
  nodes::CallForwarder call_forwarder_;
  std::exception_ptr failed_call_;
  std::optional<nodes::StreamsToRanks> to_others_;
  std::optional<nodes::StreamFromHost> from_first_;
};

}  // namespace dmpc::apps
