// Detection that no ray is left anywhere: Safra's counts and colours (E. W. Dijkstra, "Shmuel Safra's version of termination
// detection", EWD 998, 1987), gathered up a tree instead of once round a ring, so that a round takes as many steps as the tree
// has levels.
//
// In a round each member that is called calls its children, and when all have reported and it is passive, it reports to its
// parent how many ray packets it and those below it have sent and not received, and whether one of them is black: a member turns
// black when it receives a ray packet, and white when it has reported. When all have reported, the host, which is the root,
// begins another round, unless all, including itself, were white and the sum is 0. The messages after the end (Finish, Done,
// Stop) go along the same tree.
//
// Why that proves the end: all have reported in the round before when the host begins a round. A white member has received no ray
// packet from that moment until its report, so its balance is that of the moment plus what it has sent since. The sum is
// therefore the number of packets in flight at that moment and of those sent since, before their senders' reports: none of
// either, if it is 0. Each member was passive at its report, and no packet is left that could wake it.
//
// The algorithm requires no order of delivery and no bound on delays. What must not happen: a passive member sends a ray packet
// without having received one. Credits and film packets wake no passive member and are not counted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// The message along the tree: a call, without content, downwards; a report upwards.
struct Token {
  std::int64_t balance = 0;    ///< ray packets sent minus received by the reporting member and those below it
  std::uint32_t is_black = 0;  ///< 1: some of them may have been woken since the round before
  std::uint32_t padding = 0;
  constexpr bool operator==(const Token&) const = default;
};
static_assert(sizeof(Token) == 16 && std::is_trivially_copyable_v<Token>);

/// A member's neighbours in the tree.
struct TreePlace {
  nodes::NodeId parent;           ///< meaningless for the host
  std::uint32_t first_child = 0;  ///< its index; the others follow
  std::uint32_t child_count = 0;
};

/// The members' tree, laid out like a heap: the host at place 0, node i at place i + 1.
struct TerminationTree {
  std::uint32_t node_count = 0;
  std::uint32_t branches = 4;  ///< maximum number of children of a member

  TreePlace place_of(nodes::NodeId member) const {
    const std::uint32_t index = nodes::index_of(member);
    const std::uint32_t place = index == node_count ? 0 : index + 1;
    const std::uint32_t above = place == 0 ? 0 : (place - 1) / branches;
    const std::uint32_t first_child = place * branches;
    return {.parent = nodes::NodeId{above == 0 ? node_count : above - 1},
            .first_child = first_child,
            .child_count = std::clamp(node_count, first_child, first_child + branches) - first_child};
  }
  /// Packets of the tree that may be in a member's mailbox: its children's reports, or its parent's call.
  std::uint32_t packets_max(nodes::NodeId member) const { return std::max(place_of(member).child_count, 1U); }
};

/// The recipients of a token: one copy to each of `count` members from `first` on.
struct TokenHandover {
  Token token;
  nodes::NodeId first;
  std::uint32_t count = 1;
};

/// One member's part. It sends no packets: it is called for each ray packet sent and received, and asked for the token whenever
/// the member is passive. Belongs to one program.
class Termination {
 public:
  /// The host: it has the token at the start.
  static Termination initiator(const TerminationTree& tree) { return {tree.place_of(nodes::NodeId{tree.node_count}), true}; }
  /// A node.
  static Termination member(nodes::NodeId node, const TerminationTree& tree) { return {tree.place_of(node), false}; }

  /// To be called for every ray packet that is sent, to any target.
  void ray_packet_sent() { ++balance_; }
  /// To be called for every ray packet that arrives (EWD 998, rules 0 and 3).
  void ray_packet_received() {
    --balance_;
    is_black_ = true;
  }

  /// Takes the parent's call, or a child's report.
  void take(const Token& token) {
    core::expect(!holds_token(), "a member is called once a round, and each child tells once");
    if (awaited_ == 0) {
      is_called_ = true;
      return;
    }
    token_.balance += token.balance;
    token_.is_black |= token.is_black;
    is_reported_ = --awaited_ == 0;
  }

  /// Whether it is called and has not called its children, or has their reports.
  bool holds_token() const { return is_called_ || is_reported_; }

  /// To be called for a *passive* member: what is to be passed on, or nothing if it holds no token, or, on the host, if the end
  /// is detected (is_terminated()).
  std::optional<TokenHandover> hand_on() {
    if (is_called_ && place_.child_count > 0) {
      return call_children();
    }
    if (!holds_token()) {
      return std::nullopt;
    }
    token_.balance += balance_;
    token_.is_black |= is_black_ ? 1U : 0U;
    return is_initiator_ ? judge() : notify_parent();
  }

  /// Only on the host: no ray is left anywhere, and no ray packet is in flight. Stable.
  bool is_terminated() const { return is_terminated_; }

  /// On the host: rays will be sent again. Requires is_terminated().
  void begin_again() {
    core::expect(is_terminated_, "what begins again has ended");
    is_terminated_ = false;
    is_called_ = true;
  }

  /// Ray packets that this member has sent minus those that it has received. Over all members the sum is 0 at the end.
  std::int64_t balance() const { return balance_; }
  const TreePlace& place() const { return place_; }
  bool is_black() const { return is_black_; }
  bool is_called() const { return is_called_; }
  /// Children that have been called and have not reported.
  std::uint32_t awaited() const { return awaited_; }
  const Token& token() const { return token_; }

 private:
  Termination(const TreePlace& place, bool is_initiator) : place_(place), is_initiator_(is_initiator), is_called_(is_initiator) {}

  TokenHandover call_children() {
    is_called_ = false;
    awaited_ = place_.child_count;
    return {.token = {}, .first = nodes::NodeId{place_.first_child}, .count = place_.child_count};
  }

  TokenHandover notify_parent() { return {.token = give_up_token(), .first = place_.parent}; }

  /// The host's decision on a round: the end, or another.
  std::optional<TokenHandover> judge() {
    const Token all = give_up_token();
    is_terminated_ = all == Token{};
    return is_terminated_ ? std::nullopt : std::optional(call_children());
  }

  /// Ends the round for this member.
  Token give_up_token() {
    is_called_ = is_reported_ = false;
    is_black_ = false;
    return std::exchange(token_, {});
  }

  TreePlace place_;
  std::int64_t balance_ = 0;
  Token token_;                ///< sum of the children's reports so far
  std::uint32_t awaited_ = 0;  ///< children that have not reported
  bool is_initiator_;
  bool is_black_ = false;
  bool is_called_;
  bool is_reported_ = false;
  bool is_terminated_ = false;
};

}  // namespace dmpc::dataflow
