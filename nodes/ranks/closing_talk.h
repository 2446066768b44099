// The last words of ranks: how the run has ended for each and, if not well, what there is to say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nodes/chaos.h"
#include "nodes/ranks/failure.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/runner.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {

/// Items: text, closing. Thread safety: belongs to one thread at a time.
class ClosingTalk {
 public:
  /// `links` and `nodes` outlive this.
  ClosingTalk(RankLinks& links, NodeThreads& nodes) : links_(&links), nodes_(&nodes), last_words_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another. What has ended elsewhere ends here.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  /// This rank's last word, when its nodes have stopped, for which it waits.
  void close();
  bool is_closing() const { return is_closing_; }
  /// All have said their last word.
  bool is_closed() const;
  /// This rank knows from that one's last word that the run has not ended well.
  bool has_told_of_failure(std::uint32_t rank) const { return last_words_[rank].ending >= Ending::stalled; }

  /// How the run has ended, as badly as anywhere; throws what a rank has failed with, or StandstillError. When all is closed.
  RunEnd judge(const std::optional<Chaos>& disturbance) const;

 private:
  struct LastWord {
    Ending ending = Ending::none;
    FailureKind kind = FailureKind::internal;  ///< of one that has failed
    std::string text;                          ///< of one that has failed, or a line for each program of one that stalls
  };

  LastWord own_word() const;
  std::string texts() const;

  RankLinks* links_;
  NodeThreads* nodes_;
  std::vector<LastWord> last_words_;  ///< of other ranks, as far as they have come
  bool is_closing_ = false;
};

}  // namespace dmpc::nodes
