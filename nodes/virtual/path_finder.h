// The chain of causes that leads to the current state, found during the run: the composition of the critical path is known at its
// end, for any length, from a bounded number of sums.
//
// Each node and each message in flight carries the sums along its chain, and where two chains meet the later one goes on: J. K.
// Hollingsworth, "Critical Path Profiling of Message Passing and Shared-Memory Programs", 1998.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/expect.h"
#include "nodes/node_id.h"
#include "nodes/observer.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// Called by the simulation, in order of events. A node has two strands: its program, and its services of interrupts, which
/// follow one another. Memory: a strand, some 300 bytes, for each of them and for each message in flight. Not thread-safe.
class PathFinder {
 public:
  /// `peer_count` = nodes + host.
  explicit PathFinder(std::size_t peer_count) : programs_(peer_count), services_(peer_count) {}

  // For a node's program.
  void computes(NodeId node, std::uint64_t ns) { program(node).times.computing_ns += ns; }
  void loses(NodeId node, std::uint64_t service_busy_ns) { program(node).times.service_busy_ns += service_busy_ns; }
  void receives(NodeId node, PacketKind kind, std::uint64_t ns) { add(program(node).times, &PathTimes::receiving_ns, kind, ns); }
  /// `message`: its number, to be reused when it has been received. `left_ns`: when the sender has finished sending it.
  void sends(NodeId node, std::uint32_t message, PacketKind kind, std::uint64_t ns, std::uint64_t left_ns) {
    add(program(node).times, &PathTimes::sending_ns, kind, ns);
    put(message, {program(node).times, {node, left_ns}, {}});
  }
  /// The node has nothing to do until the message arrives or, if that is later, the current service ends.
  void is_woken(NodeId node, std::uint32_t message, bool is_serving) {
    program(node) = is_serving ? services_[index_of(node)] : messages_[message];
    if (is_serving) {
      program(node).request.reset();  // the message that is waited for answers none
    }
  }

  // For services.
  /// `is_queued`: after the service before.
  void begins_service(NodeId node, std::uint32_t message, PacketKind kind, bool is_queued) {
    Strand& service = services_[index_of(node)];
    if (!is_queued) {
      service = messages_[message];
    }
    service.request = kind;
  }
  void serves(NodeId node, PacketKind kind, std::uint64_t ns) {
    add(services_[index_of(node)].times, &PathTimes::serving_ns, kind, ns);
  }
  void answers(NodeId node, std::uint32_t message, PacketKind kind, std::uint64_t ns) {
    add(services_[index_of(node)].times, &PathTimes::sending_ns, kind, ns);
    put(message, services_[index_of(node)]);
  }

  /// A message has travelled, of which time it waited `links_ns` for links.
  void travels(std::uint32_t message, PacketKind kind, std::uint64_t ns, std::uint64_t links_ns) {
    PathTimes& times = messages_[message].times;
    add(times, &PathTimes::travelling_ns, kind, ns - links_ns);
    add(times, &PathTimes::links_ns, kind, links_ns);
    ++times.messages;
  }

  /// Sets the members of `wait` for a node that has been woken.
  void describe(Waited& wait) const {
    const Strand& strand = programs_[index_of(wait.node)];
    wait.request = strand.request;
    wait.from = strand.from;
  }
  /// The path of the first node whose program, or otherwise whose services, were at work until the end; expects that there is
  /// one.
  CriticalPath path_to(std::uint64_t end_ns) const {
    for (std::uint32_t node = 0; node < programs_.size(); ++node) {
      if (programs_[node].times.total_ns() == end_ns) {
        return {programs_[node].times, {NodeId{node}, end_ns}};
      }
      if (services_[node].times.total_ns() == end_ns) {
        return {services_[node].times, services_[node].from};
      }
    }
    throw core::InternalError("some node was at work when the run ended");
  }

 private:
  /// A chain up to now.
  struct Strand {
    PathTimes times;
    ProgramPoint from;  ///< for a message: the last sending by a program from which it follows by messages alone
    std::optional<PacketKind> request = {};  ///< for services: the last that was served
  };

  Strand& program(NodeId node) { return programs_[index_of(node)]; }
  static void add(PathTimes& times, std::uint64_t PathTimes::*part, PacketKind kind, std::uint64_t ns) {
    times.*part += ns;
    times.by_kind_ns[kind] += ns;
  }
  void put(std::uint32_t message, const Strand& strand) {
    if (message >= messages_.size()) {
      messages_.resize(message + 1);
    }
    messages_[message] = strand;
  }

  std::vector<Strand> programs_, services_;  ///< by node
  std::vector<Strand> messages_;             ///< by number
};

}  // namespace dmpc::nodes
