// The ranks' termination messages: how the run has ended for each and, if not regularly, why.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <utility>
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
  ClosingTalk(RankLinks& links, NodeThreads& nodes) : links_(&links), nodes_(&nodes), termination_messages_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another. If the run has ended elsewhere, it ends here.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    TerminationMessage& word = termination_messages_[rank];
    if (header.item == Item::text) {
      word.text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      return true;
    }
    if (header.item == Item::closing) {
      word.ending = value_of<Closing>(bytes).ending;
      word.kind = value_of<Closing>(bytes).kind;
      nodes_->end(word.ending);
      return true;
    }
    return false;
  }

  /// Sends this rank's termination message, after waiting until its nodes have stopped.
  void close() {
    is_closing_ = true;
    nodes_->join();
    const TerminationMessage word = own_message();
    if (!word.text.empty()) {
      links_->say_to_all(Item::text, std::as_bytes(std::span(word.text)));
    }
    links_->say_to_all(Item::closing, bytes_of(Closing{word.ending, word.kind}));
  }

  bool is_closing() const { return is_closing_; }
  /// Whether all have sent their termination message.
  bool is_closed() const {
    const auto is_silent = [](const TerminationMessage& word) { return word.ending == Ending::none; };
    return is_closing_ && std::count_if(termination_messages_.begin(), termination_messages_.end(), is_silent) == 1 &&
           links_->has_said_all();
  }

  /// Whether that rank's termination message says that the run has failed.
  bool has_reported_of_failure(std::uint32_t rank) const { return termination_messages_[rank].ending >= Ending::stalled; }

  /// The end of the run, the gravest of all ranks; throws a rank's failure, or DeadlockError. Requires is_closed().
  RunEnd judge(const std::optional<Chaos>& disturbance) const {
    const auto gravity = [](const TerminationMessage& word) { return std::pair(word.ending, !word.text.empty()); };
    const auto gravest =
        std::max_element(termination_messages_.begin(), termination_messages_.end(),
                         [&](const TerminationMessage& a, const TerminationMessage& b) { return gravity(a) < gravity(b); });
    switch (std::max(nodes_->ending(), gravest->ending)) {
      case Ending::failed:
        if (nodes_->failure()) {
          std::rethrow_exception(nodes_->failure());
        }
        fail_as(gravest->kind,
                links_->name_of(static_cast<std::uint32_t>(gravest - termination_messages_.begin())) + ": " + gravest->text);
      case Ending::stalled:
        throw DeadlockError(deadlock_text(disturbance) + nodes_->describe() + texts());
      case Ending::interrupted:
        return RunEnd::interrupted;
      default:
        return RunEnd::finished;
    }
  }

 private:
  /// The format of a termination message, after its text.
  struct Closing {
    Ending ending;
    FailureKind kind;
  };
  struct TerminationMessage {
    Ending ending = Ending::none;
    FailureKind kind = FailureKind::internal;  ///< if the rank has failed
    std::string text;                          ///< if the rank has failed; in a deadlock a line for each program
  };

  TerminationMessage own_message() const {
    TerminationMessage word{.ending = nodes_->ending()};
    if (word.ending == Ending::stalled) {
      word.text = nodes_->describe();
    }
    if (nodes_->failure()) {
      Failure failure = failure_of(nodes_->failure());
      word.kind = failure.kind;
      word.text = std::move(failure.text);
    }
    return word;
  }

  /// The texts of the other ranks.
  std::string texts() const {
    std::string texts;
    for (const TerminationMessage& word : termination_messages_) {
      texts += word.text;
    }
    return texts;
  }

  RankLinks* links_;
  NodeThreads* nodes_;
  std::vector<TerminationMessage> termination_messages_;  ///< other ranks', as far as they have arrived
  bool is_closing_ = false;
};

}  // namespace dmpc::nodes
