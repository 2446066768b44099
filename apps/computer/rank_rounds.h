// Coordinates ranks that execute one program, between its runs.
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

/// All ranks call agree(), meet() and share() in the same order, unless agree() finds a difference. Rank 0 throws an error of
/// another rank; the others throw nodes::Dismissed if rank 0 has ended; all throw nodes::LostRank. Thread safety: only here() may
/// be called outside of the communicating thread.
class RankRounds {
 public:
  /// `links` outlive this object.
  explicit RankRounds(nodes::RankLinks& links);

  nodes::RankLinks& links() { return links_; }
  bool is_first() const { return links_.rank() == 0; }

  /// Returns or throws the result of work(), which runs on its own thread; meanwhile other ranks still receive heartbeats.
  template <class Work>
  auto apart(const Work& work) {
    return call_forwarder_.while_working(
        work, [this] { look_after(); }, [this] { nodes::send_heartbeat(links_); });
  }
  /// Called by the work of apart() to run a function on the communicating thread. After a failed call all further calls fail with
  /// the same error, since ranks would no longer know each other's state.
  void here(const std::function<void()>& forwarded_call);

  /// Checks that the next operation is equal on all ranks: throws ProgramError where it differs from rank 0's.
  void agree(const std::string& next);
  /// Waits until all ranks have arrived.
  void meet();
  /// Copies rank 0's bytes to all ranks; their number is equal everywhere.
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
