#include "nodes/ranks/counting_talk.h"

#include <optional>

#include "core/base/expect.h"
#include "nodes/ranks/outbox.h"
#include "nodes/ranks/placement.h"

namespace dmpc::nodes {

bool CountingTalk::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
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

bool CountingTalk::send_packets() {
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

/// The order matters: nodes that sleep have put into the outbox what they had, and while all do only what this thread brings
/// wakes them.
void CountingTalk::count_if_quiet() {
  if (is_to_count() && outbox_->is_drained()) {
    const Counts counts{traffic_.packets_sent, traffic_.packets_received, nodes_->unfinished_count()};
    waves_.count(links_->rank(), counts);
    links_->say_to_all(Item::counts, bytes_of(counts));
  }
  if (const std::optional<Counts> still = waves_.end_wave()) {
    nodes_->end(still->unfinished == 0 ? Ending::finished : Ending::stalled);
  }
}

void CountingTalk::close_account() {
  const RankLinks::Sent sent = links_->take_sent();
  traffic_.frames_sent = sent.frames;
  traffic_.bytes_sent = sent.bytes;
  traffic_.waves = waves_.waves();
}

void CountingTalk::expect_nothing_lost() const {
  nodes_->expect_nothing_lies_about();
  std::uint64_t sent = 0, received = 0;
  for (const auto& processor : nodes_->processors()) {
    sent += total(processor->node.counters().sent).packets;
    received += total(processor->node.counters().received).packets;
  }
  core::expect(sent + traffic_.packets_received == received + traffic_.packets_sent, "packets sent are packets received");
}

}  // namespace dmpc::nodes
