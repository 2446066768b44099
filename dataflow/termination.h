// The proof that no ray is left anywhere: Safra's algorithm on a ring (E. W. Dijkstra, "Shmuel Safra's version of termination
// detection", EWD 998, 1987).
//
// A token goes round the ring host -> node N-1 -> ... -> node 0 -> host, held by each member until it is passive. It sums how
// many ray packets the members have sent and not received. The sum alone proves nothing: a packet may have made a member active
// behind the token's back. Hence colours: whoever receives a ray packet turns black, a black member blackens the token it hands
// on and is white again. The host has the proof when a token comes back white to a white, passive host and its sum and the host's
// own balance make 0. Else it starts another round.
//
// The algorithm asks for no order of delivery and no bound on delays. What may not happen: a passive member sends a ray packet
// without having received one. Credits and film packets wake no passive member and are not counted.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// What goes round the ring.
struct Token {
  std::int64_t balance = 0;    ///< ray packets sent minus received by the members that it has visited in this round
  std::uint32_t is_black = 0;  ///< 1: some of them may have been woken after its visit, or before it by one visited earlier
  std::uint32_t padding = 0;
  constexpr bool operator==(const Token&) const = default;
};
static_assert(sizeof(Token) == 16 && std::is_trivially_copyable_v<Token>);

/// To whom `member` hands the token; the host is node_count.
constexpr nodes::NodeId next_on_ring(nodes::NodeId member, std::uint32_t node_count) {
  const std::uint32_t index = nodes::index_of(member);
  return nodes::NodeId{index == 0 ? node_count : index - 1};
}

/// One member's part. It decides nothing about packets: it is told of each ray packet sent and received, and asked for the token
/// whenever the member is passive. Belongs to one program.
class Termination {
 public:
  /// The host: it holds the token from the start, one that proves nothing.
  static Termination initiator() { return Termination(true); }
  /// A node.
  static Termination member() { return Termination(false); }

  /// Tell of every ray packet that leaves, whoever its target is.
  void ray_packet_sent() { ++balance_; }
  /// Tell of every ray packet that arrives (EWD 998, rules 0 and 3).
  void ray_packet_received() {
    --balance_;
    is_black_ = true;
  }

  /// Takes the token of the member before.
  void take(const Token& token) {
    core::expect(!holds_token_, "one token goes round the ring");
    token_ = token;
    holds_token_ = true;
  }

  bool holds_token() const { return holds_token_; }

  /// Asks a *passive* member: the token to be handed to next_on_ring(), or nothing if it holds none, or, on the host, if the end
  /// is proved (is_terminated()). Rules 1, 2, 4, 5 and 7 of EWD 998.
  std::optional<Token> hand_on() {
    if (!holds_token_) {
      return std::nullopt;
    }
    if (is_initiator_) {
      return judge();
    }
    const Token next{token_.balance + balance_, token_.is_black != 0 || is_black_ ? 1U : 0U};
    give_up_token();
    return next;
  }

  /// Only the host can know: no ray is left anywhere, and no ray packet is under way. For good.
  bool is_terminated() const { return is_terminated_; }

  /// The host's: rays will be sent again. Requires is_terminated().
  void begin_again() {
    core::expect(is_terminated_ && holds_token_, "what begins again has ended");
    is_terminated_ = false;
    is_black_ = true;
  }

  /// Ray packets that this member has sent minus those that it has received. Over all members the sum is 0 at the end.
  std::int64_t balance() const { return balance_; }
  bool is_black() const { return is_black_; }
  const Token& token() const { return token_; }

 private:
  explicit Termination(bool is_initiator) : is_initiator_(is_initiator), holds_token_(is_initiator), is_black_(is_initiator) {}

  /// The host's judgement on a round that has come back: the end, or a new round.
  std::optional<Token> judge() {
    is_terminated_ = is_terminated_ || (!is_black_ && token_.is_black == 0 && token_.balance + balance_ == 0);
    if (is_terminated_) {
      return std::nullopt;
    }
    give_up_token();
    return Token{};
  }

  void give_up_token() {
    token_ = {};
    holds_token_ = false;
    is_black_ = false;
  }

  std::int64_t balance_ = 0;
  Token token_;
  bool is_initiator_;
  bool holds_token_;
  bool is_black_;  ///< the host starts black: its first token comes from no round
  bool is_terminated_ = false;
};

}  // namespace dmpc::dataflow
