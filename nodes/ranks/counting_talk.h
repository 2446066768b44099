// What goes between the nodes of several ranks, and how the ranks find out that nothing does any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/mailbox.h"
#include "nodes/ranks/counting_waves.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_report.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {

/// Items: packet, counts. Thread safety: belongs to one thread at a time.
class CountingTalk {
 public:
  /// All of it outlives this. `outbox` has what nodes here send to nodes elsewhere, of `node_count` in all and the host.
  CountingTalk(RankLinks& links, NodeThreads& nodes, Mailbox& outbox, std::uint32_t node_count)
      : links_(&links), nodes_(&nodes), outbox_(&outbox), node_count_(node_count), waves_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  /// Out of the outbox into frames, as far as there is room. A way that is full holds the others up, but not for long: what
  /// arrives at a rank has its place there, so frames are always taken. Returns whether there was anything.
  bool send_packets();
  /// Counts if all is quiet here, and ends the run if it is everywhere.
  void count_if_quiet();
  /// There is something new to count.
  bool is_to_count() const { return nodes_->all_sleep() && !waves_.has_counted(links_->rank()); }

  /// The nodes here stop: packets that still come are for nobody.
  void close() { is_closing_ = true; }
  /// All were told how the run has ended. Call it before the next two.
  void close_account();
  const RankTraffic& traffic() const { return traffic_; }
  /// What was sent here or came here was received here or left.
  void expect_nothing_lost() const;

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
