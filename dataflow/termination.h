// The proof that no ray is left anywhere: Safra's counts and colours (E. W. Dijkstra, "Shmuel Safra's version of termination
// detection", EWD 998, 1987), gathered up a tree in place of once round a ring, so that a round takes as many steps as the tree
// is deep, not as there are nodes.
//
// In a round each member that is called calls its children, and when they have all told and it is passive, it tells its parent
// how many ray packets it and those below it have sent and not received, and whether one of them is black: whoever receives a
// ray packet turns black, and who has told is white again. When all have told, the host, which is the root, begins another round,
// unless all, itself too, were white and the sum is 0. What follows the end (Finish, Done, Stop) goes along the same tree.
//
// Why that proves the end: all have told the round before when the host begins a round. Who is white has received no ray packet
// from that moment until it told, so its balance is that of the moment and what it has sent since. The sum of all is therefore
// what was under way at that moment and what has been sent since before its sender told: none of either, if it is 0. Who told was
// passive, and no packet is left that could wake it.
//
// The algorithm asks for no order of delivery and no bound on delays. What may not happen: a passive member sends a ray packet
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

/// What goes along the tree: down it calls, and says nothing; up it tells.
struct Token {
  std::int64_t balance = 0;    ///< ray packets sent minus received by the member that tells and those below it
  std::uint32_t is_black = 0;  ///< 1: some of them may have been woken since the round before
  std::uint32_t padding = 0;
  constexpr bool operator==(const Token&) const = default;
};
static_assert(sizeof(Token) == 16 && std::is_trivially_copyable_v<Token>);

/// A member among those that it speaks to.
struct TreePlace {
  nodes::NodeId parent;           ///< without meaning for the host
  std::uint32_t first_child = 0;  ///< its index; the others follow
  std::uint32_t child_count = 0;
};

/// The members' tree, laid out as heaps are: the host at place 0, node i at place i + 1.
struct TerminationTree {
  std::uint32_t node_count = 0;
  std::uint32_t branches = 4;  ///< children a member has at most

  TreePlace place_of(nodes::NodeId member) const {
    const std::uint32_t index = nodes::index_of(member);
    const std::uint32_t place = index == node_count ? 0 : index + 1;
    const std::uint32_t above = place == 0 ? 0 : (place - 1) / branches;
    const std::uint32_t first_child = place * branches;
    return {.parent = nodes::NodeId{above == 0 ? node_count : above - 1},
            .first_child = first_child,
            .child_count = std::clamp(node_count, first_child, first_child + branches) - first_child};
  }
  /// Packets of the tree that may be in a member's mailbox: what its children tell, or what its parent calls.
  std::uint32_t packets_max(nodes::NodeId member) const { return std::max(place_of(member).child_count, 1U); }
};

/// To whom a member hands a token: one copy to each of `count` members from `first` on.
struct TokenHandover {
  Token token;
  nodes::NodeId first;
  std::uint32_t count = 1;
};

/// One member's part. It decides nothing about packets: it is told of each ray packet sent and received, and asked for the token
/// whenever the member is passive. Belongs to one program.
class Termination {
 public:
  /// The host: it is called from the start.
  static Termination initiator(const TerminationTree& tree) { return {tree.place_of(nodes::NodeId{tree.node_count}), true}; }
  /// A node.
  static Termination member(nodes::NodeId node, const TerminationTree& tree) { return {tree.place_of(node), false}; }

  /// Tell of every ray packet that leaves, whoever its target is.
  void ray_packet_sent() { ++balance_; }
  /// Tell of every ray packet that arrives (EWD 998, rules 0 and 3).
  void ray_packet_received() {
    --balance_;
    is_black_ = true;
  }

  /// Takes the parent's call, or what a child tells.
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

  /// Is called and has not called its children, or knows what they tell.
  bool holds_token() const { return is_called_ || is_reported_; }

  /// Asks a *passive* member: what is to be handed on, or nothing if it holds no token, or, on the host, if the end is proved
  /// (is_terminated()).
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

  /// Only the host can know: no ray is left anywhere, and no ray packet is under way. For good.
  bool is_terminated() const { return is_terminated_; }

  /// The host's: rays will be sent again. Requires is_terminated().
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
  /// Children that have been called and have not told.
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

  /// The host's judgement on a round: the end, or another.
  std::optional<TokenHandover> judge() {
    const Token all = give_up_token();
    is_terminated_ = all == Token{};
    return is_terminated_ ? std::nullopt : std::optional(call_children());
  }

  /// The round is over for this member.
  Token give_up_token() {
    is_called_ = is_reported_ = false;
    is_black_ = false;
    return std::exchange(token_, {});
  }

  TreePlace place_;
  std::int64_t balance_ = 0;
  Token token_;                ///< what children have told so far
  std::uint32_t awaited_ = 0;  ///< children that have not told
  bool is_initiator_;
  bool is_black_ = false;
  bool is_called_;
  bool is_reported_ = false;
  bool is_terminated_ = false;
};

}  // namespace dmpc::dataflow
