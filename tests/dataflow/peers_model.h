// What models of dataflow's protocols have alike: three nodes and a host, and packets between each two of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "dataflow/termination.h"

namespace dmpc::tests {

inline constexpr std::size_t model_nodes = 3;
inline constexpr std::size_t model_host = model_nodes;
inline constexpr std::size_t model_peers = model_nodes + 1;
/// The host has two children, of which one has the third node.
inline constexpr dataflow::TerminationTree model_tree{.node_count = model_nodes, .branches = 2};

struct ModelFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void hold(bool condition, const char* sentence) {
  if (!condition) {
    throw ModelFailure(std::string("violated: ") + sentence);
  }
}

constexpr std::uint8_t narrow(std::size_t index) { return static_cast<std::uint8_t>(index); }

inline std::string peer_name(std::size_t peer) { return peer == model_host ? "host" : "node " + std::to_string(peer); }

/// Packets on one way, in the order sent. A `Message` is a kind and three numbers, a byte each.
template <class Message, std::size_t capacity>
struct ModelChannel {
  static_assert(sizeof(Message) == 4);

  std::array<Message, capacity> messages{};
  std::uint8_t size = 0;

  void add(const Message& message) {
    hold(size < capacity, "a mailbox has room for everything that credits allow");
    messages[size++] = message;
  }
  Message take(std::size_t place) {
    const Message message = messages[place];
    std::copy(messages.begin() + static_cast<std::ptrdiff_t>(place) + 1, messages.begin() + size,
              messages.begin() + static_cast<std::ptrdiff_t>(place));
    messages[--size] = {};
    return message;
  }
};

/// By sender, then by target.
template <class Channel>
using ModelChannels = std::array<std::array<Channel, model_peers>, model_peers>;

/// Calls visit(message) for each that is under way.
template <class Channel, class Visit>
void for_each_message(const ModelChannels<Channel>& channels, Visit visit) {
  for (const auto& row : channels) {
    for (const Channel& channel : row) {
      std::for_each(channel.messages.begin(), channel.messages.begin() + channel.size, visit);
    }
  }
}

/// Every byte that tells what is under way from anything else.
template <class Channel>
void append_messages(std::string& bytes, const ModelChannels<Channel>& channels) {
  for (const auto& row : channels) {
    for (const Channel& channel : row) {
      bytes += static_cast<char>(channel.size);
      bytes.append(reinterpret_cast<const char*>(channel.messages.data()), 4 * std::size_t{channel.size});
    }
  }
}

/// What a peer that holds the token comes to: calls send(state, target, token) for whom it goes to, then visit(state, whether the
/// end is not proved).
template <class State, class Send, class Visit>
void hand_on_token(const State& state, std::size_t peer, Send send, Visit visit) {
  if (!state.member[peer].termination.holds_token()) {
    return;
  }
  State next = state;
  auto& termination = next.member[peer].termination;
  const auto handover = termination.hand_on();
  for (std::uint32_t i = 0; handover && i < handover->count; ++i) {
    send(next, nodes::index_of(handover->first) + i, handover->token);
  }
  visit(next, !termination.is_terminated());
}

}  // namespace dmpc::tests
