// What a run tells somebody who wants to see it happen: typed events, from the runner and from programs with a meter.
//
// One interface for all who look on (traces, reports), so that each point of a run is instrumented once. A run without an
// observer is asked once for each packet and quantum whether there is one, and never within a quantum.
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

/// Nanoseconds along a chain in which each link begins when the one before ends, from the start of a run to some moment: the
/// parts add up to that moment.
struct PathTimes {
  std::uint64_t computing_ns = 0;     ///< operations that programs charged
  std::uint64_t service_busy_ns = 0;  ///< others' requests served in the midst of that
  std::uint64_t sending_ns = 0;       ///< of messages
  std::uint64_t travelling_ns = 0;    ///< latency, hops and bytes, and behind messages to the same node
  std::uint64_t links_ns = 0;         ///< waiting for links that other messages held
  std::uint64_t receiving_ns = 0;     ///< of messages
  std::uint64_t serving_ns = 0;       ///< requests that were waited for, by an interrupt
  std::uint64_t messages = 0;         ///< that led from one node to another
  /// The same by the kinds of messages: all but computing and stolen.
  std::array<std::uint64_t, packet_kind_count> by_kind_ns{};

  std::uint64_t total_ns() const {
    return computing_ns + service_busy_ns + sending_ns + travelling_ns + links_ns + receiving_ns + serving_ns;
  }
  bool operator==(const PathTimes&) const = default;
};

/// The chain that leads to the end of a run.
struct CriticalPath {
  PathTimes times;
  /// What last led to the end: a program that was at work till then, or whose message was served till then.
  ProgramPoint from;
};

class Program;

/// What a processor is doing for a while.
enum class Activity : std::uint8_t {
  work,      ///< a quantum
  receive,   ///< the program takes a packet
  serve,     ///< the same by an interrupt, within another activity or while there is nothing to do (modelled machines)
  send,      ///< what it costs to send the packets of a quantum (modelled machines)
  take_over  ///< what it costs to take over a packet that has come while there was nothing to do (modelled machines)
};

/// An activity from its beginning to its end. Those of one node do not overlap, but that those of the kind `serve` lie within
/// others. Times are nanoseconds since the start of the run: virtual ones on a modelled machine, else those of the wall clock.
struct Span {
  NodeId node{};
  Activity activity = Activity::work;
  PacketKind packet = 0;  ///< of receive, serve and take_over
  /// Calls of the node's program are numbered. Of send it is that whose packets are sent, of take_over the last one before.
  std::uint64_t call = 0;
  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;  ///< what it takes by itself, without interrupts and packets that came meanwhile
  Charges before, after;     ///< operations charged until its begin and its end; equal except for calls of the program

  /// A call of the program that is no interrupt.
  bool is_own_call() const { return activity == Activity::work || activity == Activity::receive; }
  /// The classes of the operations that it was charged.
  ChargeBits charged() const { return charged_between(before, after); }
};

/// Where a message was when. What does not apply is 0.
struct MessageTimes {
  std::uint64_t sending_ns = 0;   ///< the sender's processor begins to send it
  std::uint64_t left_ns = 0;      ///< the sender's processor is done with it
  std::uint64_t entered_ns = 0;   ///< it enters the network (modelled machines)
  std::uint64_t links_ns = 0;     ///< how long it waited there for links that others held (modelled machines)
  std::uint64_t arrived_ns = 0;   ///< it is at its target (modelled machines)
  std::uint64_t received_ns = 0;  ///< the target's program takes it, or an interrupt's service begins
};

/// A packet leaves, or is received. Packets of one kind from one node to another are received in the order in which they were
/// sent, so that the two ends of each can be found again.
struct Passing {
  NodeId node{};  ///< the node that tells: the sender of what is sent, the receiver of what is received
  NodeId peer{};  ///< the other
  PacketKind kind = 0;
  std::uint64_t call = 0;  ///< of the node's program, in which it is sent or received
  std::span<const std::byte> payload;
  /// When it is sent, the first two; on a modelled machine all when it is received, else only the last.
  MessageTimes times;
  std::size_t immutable_bytes = 0;  ///< that follow `payload` where they are (modelled machines, nodes/packet.h)

  std::size_t payload_bytes() const { return payload.size() + immutable_bytes; }
  /// What many protocols say first, a number; 0 where there is none.
  std::uint32_t first_word() const {
    std::uint32_t word = 0;
    std::memcpy(&word, payload.data(), std::min(payload.size(), sizeof(word)));
    return word;
  }
};

/// What a call of a program has worked on. There may be several in a call, or none.
struct Worked {
  NodeId node{};
  std::uint32_t item = 0;   ///< by the program's numbering
  std::uint32_t depth = 1;  ///< how deep in it the call got last, by the program's reckoning
};

/// A node had nothing to do until a message came that gave it something. Told before whatever it does with that.
struct Waited {
  NodeId node{};
  NodeId peer{};        ///< who sent the message
  PacketKind kind = 0;  ///< of the message
  std::uint64_t begin_ns = 0, end_ns = 0;
  std::uint64_t own_ns = 0;  ///< without what was served to others meanwhile

  // Where paths are followed (modelled machines, Observer::follows_paths()), else 0.
  std::uint64_t left_ns = 0;               ///< the message's sender was done with it
  std::optional<PacketKind> request = {};  ///< the message answers one of this kind, by an interrupt
  ProgramPoint from;                       ///< what led to the end of the wait: nothing but messages lies between
};

/// Looks on. What a call sends, receives and works on is told before its span, which is told when it ends. Thread safety: what
/// one node tells comes one after the other; with threads, several nodes tell at a time.
class Observer {
 public:
  virtual ~Observer() = default;

  /// From the runner. `program` is the node's, between two calls.
  virtual void ended(const Span& /*span*/, const Program& /*program*/) {}
  virtual void sent(const Passing& /*packet*/) {}
  virtual void received(const Passing& /*packet*/) {}
  virtual void waited(const Waited& /*wait*/) {}
  /// From a program with a meter.
  virtual void worked(const Worked& /*worked*/) {}

  /// Whether a modelled machine is to say what led to the end of each wait, and to that of the run
  /// (VirtualReport::critical_path). Asked once, before the run.
  virtual bool follows_paths() const { return false; }
};

}  // namespace dmpc::nodes
