#include "apps/computer/plan.h"

#include <algorithm>
#include <string>
#include <utility>

#include "apps/computer/declared.h"
#include "apps/frontend/system/digest.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/units.h"
#include "nodes/runner.h"
#include "nodes/threads/delayed_packets.h"

namespace dmpc::apps {
namespace {

static_assert(small_bytes_max == nodes::small_payload_bytes && packets_max == nodes::packet_kind_count &&
              operations_max == nodes::charge_count);

/// Limits above any real computer's; with them sums of all that a run needs stay below 2^64.
constexpr std::size_t packet_bytes_max = std::size_t{1} << 30, memory_bytes_max = std::size_t{1} << 40,
                      node_bytes_max = std::size_t{1} << 44;

}  // namespace

ProgramPlan::ProgramPlan(Needs needs, const nodes::ComputerRequest& computer)
    : needs_(std::move(needs)),
      node_count_(computer.node_count),
      chaos_(computer.chaos),
      stack_bytes_(computer.stack_reserve_bytes),
      answers_(needs_.packets.size()),
      requests_(needs_.packets.size()),
      mailboxes_(node_count_) {
  check_names();
  check_sizes();
  match_answers();
  count_places();
  check_memory(computer);
}

void ProgramPlan::check_names() const {
  check_different(needs_.packets, "packets");
  check_different(needs_.memory, "pieces of memory");
  check_count(needs_.packets.size(), packets_max, "packets");
  check_operations(needs_.operations, operations_max);
}

void ProgramPlan::check_sizes() const {
  for (const PacketNeed& packet : needs_.packets) {
    if (packet.bytes_max > packet_bytes_max) {
      throw core::UsageError("the packet " + own_name(packet.name) + " has up to " + std::to_string(packet.bytes_max) +
                             " bytes: expected at most " + std::to_string(packet_bytes_max));
    }
  }
  for (const MemoryNeed& memory : needs_.memory) {
    if (memory.bytes > memory_bytes_max) {
      throw core::UsageError("the memory " + own_name(memory.name) + " has " + std::to_string(memory.bytes) +
                             " bytes: expected at most " + std::to_string(memory_bytes_max));
    }
  }
}

void ProgramPlan::match_answers() {
  for (Index answer = 0; answer < needs_.packets.size(); ++answer) {
    const PacketNeed& need = needs_.packets[answer];
    if (need.answers.empty() == !need.senders) {
      throw core::UsageError("the packet " + own_name(need.name) + " has " +
                             (need.senders ? "senders and answers another" : "no senders and answers none") +
                             ": expected one of both");
    }
    if (need.senders) {
      continue;
    }
    const auto asked = std::find_if(needs_.packets.begin(), needs_.packets.end(),
                                    [&](const PacketNeed& request) { return request.name == need.answers && request.senders; });
    const auto request = static_cast<Index>(asked - needs_.packets.begin());
    if (asked == needs_.packets.end() || answers_[request]) {
      throw core::UsageError("the packet " + own_name(need.name) + " answers " + own_name(need.answers) +
                             ": expected a packet that has senders, and no other answer");
    }
    answers_[request] = answer;
    requests_[answer] = request;
  }
}

std::uint32_t ProgramPlan::places(std::uint32_t source, std::uint32_t target, Index packet) const {
  return needs_.packets[packet].senders(source, target, node_count_);
}

/// Every packet in flight has a slot at its target: requests up to the sender's limit in flight, an answer in its request's slot.
/// A packet with a short payload uses a small slot, even if it could have had a larger payload.
void ProgramPlan::count_places() {
  std::vector<std::uint64_t> small(node_count_), bulk(node_count_);
  const auto add = [&](std::uint32_t node, Index packet, std::uint64_t count) {
    small[node] += count;
    bulk[node] += is_small(packet) ? 0 : count;
  };
  for (std::uint32_t source = 0; source < node_count_; ++source) {
    for (std::uint32_t target = 0; target < node_count_; ++target) {
      std::uint64_t pair = 0;
      for (Index packet = 0; packet < needs_.packets.size(); ++packet) {
        if (requests_[packet]) {
          continue;
        }
        const std::uint32_t count = places(source, target, packet);
        pair += count;
        add(target, packet, count);
        if (answers_[packet]) {
          add(source, *answers_[packet], count);
        }
      }
      if (2 * pair > nodes::credits_max) {
        throw core::UsageError("node " + std::to_string(source) + " may have " + std::to_string(pair) +
                               " packets under way to node " + std::to_string(target) + ": expected at most " +
                               std::to_string(nodes::credits_max / 2));
      }
    }
  }
  const std::size_t longest = payload_bytes_max();
  for (std::uint32_t node = 0; node < node_count_; ++node) {
    mailboxes_[node] = {.small_slots = static_cast<std::uint32_t>(small[node]),
                        .bulk_slots = static_cast<std::uint32_t>(bulk[node]),
                        .bulk_payload_bytes = longest};
  }
  held_bytes_ = chaos_ ? nodes::DelayedPackets::room_bytes(longest) : 0;
}

std::size_t ProgramPlan::payload_bytes_max() const {
  return core::max_over(needs_.packets, small_bytes_max, &PacketNeed::bytes_max);
}

std::uint64_t ProgramPlan::digest() const {
  Digest digest;
  for (const PacketNeed& packet : needs_.packets) {
    digest.add(packet.name);
    digest.add(std::uint64_t{packet.bytes_max});
    digest.add(packet.answers);
  }
  for (const OperationNeed& operation : needs_.operations) {
    digest.add(operation.name);
  }
  for (const MemoryNeed& memory : needs_.memory) {
    digest.add(memory.name);
    digest.add(std::uint64_t{memory.bytes});
  }
  for (std::uint32_t source = 0; source < node_count_; ++source) {
    for (std::uint32_t target = 0; target < node_count_; ++target) {
      for (Index packet = 0; packet < needs_.packets.size(); ++packet) {
        digest.add(std::uint64_t{requests_[packet] ? 0 : places(source, target, packet)});
      }
    }
  }
  return digest.value();
}

/// Chaos may reduce credits that return with answers, but not the fixed total of packets without answers.
std::uint32_t ProgramPlan::credits(std::uint32_t source, std::uint32_t target, Index packet) const {
  const std::uint32_t count = requests_[packet] ? 0 : places(source, target, packet);
  return chaos_ && answers_[packet] ? nodes::shrunk_credits(*chaos_, count, static_cast<std::uint32_t>(packet)) : count;
}

nodes::MemoryPlan ProgramPlan::memory(std::uint32_t node) const {
  nodes::MemoryPlan plan = memory_beside_program(mailboxes_[node]) + rights();
  for (const MemoryNeed& need : needs_.memory) {
    plan[ProgramMemory::declared] += core::round_up(need.bytes, nodes::LocalMemory::alignment);
  }
  return plan;
}

nodes::MemoryPlan ProgramPlan::host_memory() const { return memory_beside_program({}); }

nodes::MemoryPlan ProgramPlan::memory_beside_program(const nodes::MailboxCapacity& mailbox) const {
  return nodes::memory_beside_program(mailbox, node_count_ + 1, held_bytes_, stack_bytes_);
}

void ProgramPlan::check_memory(const nodes::ComputerRequest& computer) const {
  std::size_t most = 0;
  for (std::uint32_t node = 0; node < node_count_; ++node) {
    most = std::max(most, memory(node).total());
  }
  if (most > node_bytes_max) {
    throw core::CapacityError("a node takes " + std::to_string(most) + " bytes: ask for other nodes, or declare less");
  }
  if (computer.node_memory_bytes && most > *computer.node_memory_bytes) {
    throw core::CapacityError("--node-memory=" + std::to_string(*computer.node_memory_bytes) + ": a node takes " +
                              std::to_string(most) + " bytes; ask for as many, or for other nodes");
  }
}

}  // namespace dmpc::apps
