// Packets between the nodes of several ranks, and termination detection over the ranks.
//
// Every rank counts, twice (F. Mattern, "Algorithms for distributed termination detection", Distributed Computing 2, 1987: four
// counters).
//
// A rank counts for a wave while all its nodes sleep and its outbox is empty, and for the next one only when it has the counts of
// all in this one. Counts only grow; so if two successive waves have equal sums, each rank's are equal, and no rank has sent or
// received anything from its first count to its second; all first counts were made before all second ones. If as many packets
// were received as sent, none was in flight in between, and nothing can arrive any more. There is no timeout, and no rank asks
// another: each informs all others, computes the same sums, and knows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "nodes/mailbox.h"
#include "nodes/processors.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/outbox.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_report.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {

/// The counts of one rank, or of all together.
struct Counts {
  std::uint64_t sent = 0, received = 0;  ///< packets, to and from other ranks
  std::uint64_t unfinished = 0;          ///< programs

  bool operator==(const Counts&) const = default;
};

/// One rank's view. Thread safety: none.
class CountingWaves {
 public:
  explicit CountingWaves(std::size_t rank_count) : ranks_(rank_count) {}

  /// Whether this rank has counted for the current wave.
  bool has_counted(std::size_t rank) const { return ranks_[rank].waves > wave_; }
  /// Sets a rank's counts for its next wave.
  void count(std::size_t rank, const Counts& counts) {
    Rank& one = ranks_.at(rank);
    core::expect(one.waves <= wave_ + 1, "nobody is two waves ahead");
    one.said[one.waves++ % one.said.size()] = counts;
  }

  /// Ends the wave if all have counted. Returns the final counts if termination is detected.
  std::optional<Counts> end_wave() {
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank) {
      if (!has_counted(rank)) {
        return std::nullopt;
      }
    }
    const Counts sum = sum_of_wave();
    const bool are_still = wave_ > 0 && sum == last_ && sum.sent == sum.received;
    ++wave_;
    last_ = sum;
    return are_still ? std::optional(sum) : std::nullopt;
  }
  /// Waves that have ended.
  std::uint64_t waves() const { return wave_; }

 private:
  struct Rank {
    std::uint64_t waves = 0;  ///< in which it has counted
    std::array<Counts, 2> said;
  };

  Counts sum_of_wave() const {
    Counts sum;
    for (const Rank& rank : ranks_) {
      const Counts& said = rank.said[wave_ % rank.said.size()];
      sum.sent += said.sent;
      sum.received += said.received;
      sum.unfinished += said.unfinished;
    }
    return sum;
  }

  std::vector<Rank> ranks_;
  std::uint64_t wave_ = 0;
  Counts last_;
};

/// Items: packet, counts. Thread safety: belongs to one thread at a time.
class CountingTalk {
 public:
  /// The arguments outlive this. `outbox` has what nodes here send to nodes elsewhere; there are `node_count` nodes and the host.
  CountingTalk(RankLinks& links, NodeThreads& nodes, Mailbox& outbox, std::uint32_t node_count)
      : links_(&links), nodes_(&nodes), outbox_(&outbox), node_count_(node_count), waves_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    if (header.item == Item::packet) {
      ++traffic_.packets_received;
      if (!is_closing_) {
        NodeThreads::Bringing(*nodes_).bring(NodeId{header.target}, header.packet, bytes);
      }
      return true;
    }
    if (header.item == Item::counts) {
      waves_.count(rank, value_of<Counts>(bytes));
      return true;
    }
    return false;
  }

  /// Moves packets from the outbox into frames, as far as there is space. A full link delays the others, but not for long: what
  /// arrives at a rank has a reserved slot there, so frames are always taken. Returns whether there was anything.
  bool send_packets() {
    const std::uint64_t before = traffic_.packets_sent;
    outbox_->drain_while([this](const Packet& packet) {
      const auto target = value_of<TargetIndex>(packet.payload.first(sizeof(TargetIndex)));
      const std::span<const std::byte> payload = packet.payload.subspan(sizeof(TargetIndex));
      const ItemHeader header{.target = target,
                              .packet = {.bytes = static_cast<std::uint32_t>(payload.size()),
                                         .source = static_cast<std::uint16_t>(index_of(packet.source)),
                                         .kind = packet.kind}};
      const bool has_room = links_->put(rank_of(target, node_count_, links_->rank_count()), header, payload);
      traffic_.packets_sent += has_room ? 1 : 0;
      return has_room;
    });
    return traffic_.packets_sent > before;
  }

  /// Counts if all is quiet here, and ends the run if it is everywhere. The order matters: nodes that sleep have put everything
  /// into the outbox, and while all do, only what this thread brings wakes them.
  void count_if_quiet() {
    if (is_to_count() && outbox_->is_drained()) {
      const Counts counts{traffic_.packets_sent, traffic_.packets_received, nodes_->unfinished_count()};
      waves_.count(links_->rank(), counts);
      links_->say_to_all(Item::counts, bytes_of(counts));
    }
    if (const std::optional<Counts> still = waves_.end_wave()) {
      nodes_->end(still->unfinished == 0 ? Ending::finished : Ending::stalled);
    }
  }

  /// Whether there is something new to count.
  bool is_to_count() const { return nodes_->all_sleep() && !waves_.has_counted(links_->rank()); }

  /// To be called when the nodes here stop: packets that still arrive are dropped.
  void close() { is_closing_ = true; }
  /// To be called when all know how the run has ended, before the next two.
  void close_account() {
    const RankLinks::Sent sent = links_->take_sent();
    traffic_.frames_sent = sent.frames;
    traffic_.bytes_sent = sent.bytes;
    traffic_.waves = waves_.waves();
  }

  const RankTraffic& traffic() const { return traffic_; }
  /// Expects that everything that was sent here or arrived here was received here or sent on.
  void expect_nothing_lost() const {
    nodes_->expect_nothing_lies_about();
    expect_all_received(nodes_->processors(), traffic_.packets_received, traffic_.packets_sent);
  }

 private:
  RankLinks* links_;
  NodeThreads* nodes_;
  Mailbox* outbox_;
  std::uint32_t node_count_;
  CountingWaves waves_;
  RankTraffic traffic_;
  bool is_closing_ = false;
};

}  // namespace dmpc::nodes
