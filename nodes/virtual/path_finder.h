// The chain of causes that leads to whatever is going on, found while the run goes on: what the critical path was made of is
// known at its end, however long it was, from a bounded number of sums.
//
// Each node and each message under way carries the sums along its chain, and where a chain meets another the one that came later
// goes on: J. K. Hollingsworth, "Critical Path Profiling of Message Passing and Shared-Memory Programs", 1998.
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

/// Told by the simulation what goes on, in order. A node has two strands: its program, and the services of interrupts, which
/// follow one another. Memory: a strand, some 300 bytes, for each of them and for each message under way. Not thread-safe.
class PathFinder {
 public:
  /// `peer_count` = nodes + host.
  explicit PathFinder(std::size_t peer_count) : programs_(peer_count), services_(peer_count) {}

  // Of a node's program.
  void computes(NodeId node, std::uint64_t ns) { program(node).times.computing_ns += ns; }
  void loses(NodeId node, std::uint64_t service_busy_ns) { program(node).times.service_busy_ns += service_busy_ns; }
  void receives(NodeId node, PacketKind kind, std::uint64_t ns) { add(program(node).times, &PathTimes::receiving_ns, kind, ns); }
  /// `message`: its number, to be used again when it has been received. `left_ns`: when the sender is done with it.
  void sends(NodeId node, std::uint32_t message, PacketKind kind, std::uint64_t ns, std::uint64_t left_ns) {
    add(program(node).times, &PathTimes::sending_ns, kind, ns);
    put(message, {program(node).times, {node, left_ns}, {}});
  }
  /// It has nothing to do until the message comes or, if that is later, what it serves is done.
  void is_woken(NodeId node, std::uint32_t message, bool is_serving) {
    program(node) = is_serving ? services_[index_of(node)] : messages_[message];
    if (is_serving) {
      program(node).request.reset();  // what is waited for answers none
    }
  }

  // Of the services.
  /// `is_queued`: behind the service before.
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

  /// A message has been on its way, of which it waited `links_ns` for links.
  void travels(std::uint32_t message, PacketKind kind, std::uint64_t ns, std::uint64_t links_ns) {
    PathTimes& times = messages_[message].times;
    add(times, &PathTimes::travelling_ns, kind, ns - links_ns);
    add(times, &PathTimes::links_ns, kind, links_ns);
    ++times.messages;
  }

  /// What `wait` has of a node that has been woken.
  void describe(Waited& wait) const {
    const Strand& strand = programs_[index_of(wait.node)];
    wait.request = strand.request;
    wait.from = strand.from;
  }
  /// That of the first node whose program, or else whose services, were at work until the end; expects that there is one.
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
  /// A chain to where it is now.
  struct Strand {
    PathTimes times;
    ProgramPoint from;  ///< of a message: when a program last sent one, from which this came about by messages alone
    std::optional<PacketKind> request = {};  ///< of services: the last that was served
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
