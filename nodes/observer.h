// Events of a run for observers: typed events, from the runner and from programs with a meter.
//
// There is one interface for all observers (traces, reports), so that each point of a run is instrumented once. A run without an
// observer tests for it once for each packet and quantum, and never within a quantum.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "nodes/charge.h"
#include "nodes/node_id.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// A moment of a node's program.
struct ProgramPoint {
  NodeId node{};
  std::uint64_t time_ns = 0;
};

/// The parts of a chain in which each link begins when the one before ends, from the start of a run to some moment, in
/// nanoseconds: they add up to that moment.
struct PathTimes {
  std::uint64_t computing_ns = 0;     ///< operations that programs charged
  std::uint64_t service_busy_ns = 0;  ///< others' requests served during that
  std::uint64_t sending_ns = 0;       ///< sending messages
  std::uint64_t travelling_ns = 0;    ///< latency, hops and bytes, and waiting behind messages to the same node
  std::uint64_t links_ns = 0;         ///< waiting for links held by other messages
  std::uint64_t receiving_ns = 0;     ///< receiving messages
  std::uint64_t serving_ns = 0;       ///< requests that were waited for, served by an interrupt
  std::uint64_t messages = 0;         ///< number of messages that led from one node to another
  /// All parts except computing and service by kinds of messages.
  std::array<std::uint64_t, packet_kind_count> by_kind_ns{};

  std::uint64_t total_ns() const {
    return computing_ns + service_busy_ns + sending_ns + travelling_ns + links_ns + receiving_ns + serving_ns;
  }
  bool operator==(const PathTimes&) const = default;
};

/// The chain of causes that leads to the end of a run.
struct CriticalPath {
  PathTimes times;
  /// The last cause: a program that was at work until the end, or whose message was served until the end.
  ProgramPoint from;
};

class Program;

/// The activity of a processor.
enum class Activity : std::uint8_t {
  work,      ///< a quantum
  receive,   ///< the program takes a packet
  serve,     ///< a packet taken by an interrupt, during another activity or while idle (modelled machines)
  send,      ///< the cost of sending a quantum's packets (modelled machines)
  take_over  ///< the cost of taking a packet that arrived while idle (modelled machines)
};

/// An activity with its begin and end. Those of one node do not overlap, except that those of kind `serve` lie within others.
/// Times are nanoseconds since the start of the run: virtual on a modelled machine, otherwise wall clock.
struct Span {
  NodeId node{};
  Activity activity = Activity::work;
  PacketKind packet = 0;  ///< for receive, serve and take_over
  /// The number of the call of the node's program. For send the call whose packets are sent, for take_over the last one before.
  std::uint64_t call = 0;
  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;       ///< its own duration, without interrupts and packets that arrived meanwhile
  std::uint64_t received_ns = 0;  ///< taking those packets (modelled machines)
  bool is_in_idle = false;        ///< for serve: the node had nothing else to do
  Charges before, after;          ///< operations charged until its begin and its end; equal except for calls of the program

  /// Whether it is a call of the program and no interrupt.
  bool is_own_call() const { return activity == Activity::work || activity == Activity::receive; }
  /// The classes of operations charged during it.
  ChargeBits charged() const { return charged_between(before, after); }
  /// Taking the packets that arrived meanwhile, as a span of its own over the same time.
  Span taking_packets() const {
    return {.node = node, .activity = Activity::take_over, .begin_ns = begin_ns, .end_ns = end_ns, .own_ns = received_ns};
  }
};

/// Times of a message. What does not apply is 0.
struct MessageTimes {
  std::uint64_t sending_ns = 0;   ///< the sender's processor begins to send it
  std::uint64_t left_ns = 0;      ///< the sender's processor has finished sending it
  std::uint64_t entered_ns = 0;   ///< it enters the network (modelled machines)
  std::uint64_t links_ns = 0;     ///< time spent there waiting for links held by others (modelled machines)
  std::uint64_t arrived_ns = 0;   ///< it is at its target (modelled machines)
  std::uint64_t received_ns = 0;  ///< the target's program takes it, or an interrupt's service begins
};

/// A packet is sent or received. Packets of one kind from one node to another are received in the order in which they were sent,
/// so that the two ends of each can be matched.
struct Passing {
  NodeId node{};  ///< the reporting node: the sender of a sent packet, the receiver of a received one
  NodeId peer{};  ///< the other node
  PacketKind kind = 0;
  std::uint64_t call = 0;  ///< the node's program's call in which it is sent or received
  std::span<const std::byte> payload;
  /// For a sent packet the first two; for a received one all on a modelled machine, otherwise only the last.
  MessageTimes times;
  std::size_t immutable_bytes = 0;  ///< that follow `payload` by address (nodes/packet.h)

  std::size_t payload_bytes() const { return payload.size() + immutable_bytes; }
  /// The first word of the payload, which many protocols use as a number; 0 if there is none.
  std::uint32_t first_word() const {
    std::uint32_t word = 0;
    std::memcpy(&word, payload.data(), std::min(payload.size(), sizeof(word)));
    return word;
  }
};

/// The item on which a call of a program has worked. A call may report several, or none.
struct Worked {
  NodeId node{};
  std::uint32_t item = 0;   ///< in the program's numbering
  std::uint32_t depth = 1;  ///< the last depth that the call reached in it, as defined by the program
};

/// A node had nothing to do until a message came that gave it something. Reported before it acts on that.
struct Waited {
  NodeId node{};
  NodeId peer{};        ///< who sent the message
  PacketKind kind = 0;  ///< the message's
  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;  ///< without services for others meanwhile

  // Set if paths are followed (modelled machines, Observer::follows_paths()), otherwise 0.
  std::uint64_t left_ns = 0;               ///< when the message's sender had finished sending it
  std::optional<PacketKind> request = {};  ///< the kind that the message answers, by an interrupt
  ProgramPoint from;                       ///< the cause of the wait's end: only messages lie between
};

/// Observes a run. What a call sends, receives and works on is reported before its span, which is reported when it ends. Thread
/// safety: reports of one node are sequential; with threads, several nodes report at a time.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Called by the runner. `program` is the node's, between two calls.
  virtual void ended(const Span& /*span*/, const Program& /*program*/) {}
  virtual void sent(const Passing& /*packet*/) {}
  virtual void received(const Passing& /*packet*/) {}
  virtual void waited(const Waited& /*wait*/) {}
  /// Called by a program with a meter.
  virtual void worked(const Worked& /*worked*/) {}

  /// Whether a modelled machine is to find the cause of the end of each wait, and of the run (VirtualReport::critical_path).
  /// Called once, before the run.
  virtual bool follows_paths() const { return false; }
};

}  // namespace dmpc::nodes
