#include "apps/computer/hosted_program.h"

#include "apps/computer/bounded_charge.h"
#include "apps/computer/declared.h"

namespace dmpc::apps {
namespace {

std::string with_name(const std::string& what, const std::string& name) { return what + " '" + name + "'"; }

}  // namespace

HostedNode::HostedNode(nodes::Node& node, const ProgramPlan& plan)
    : node_(node), plan_(plan), rights_(plan.rights().in(node.memory())), used_bytes_(plan.needs().memory.size()) {
  for (std::uint32_t target = 0; target < plan.node_count(); ++target) {
    for (Index packet = 0; packet < plan.needs().packets.size(); ++packet) {
      const std::uint32_t count = plan.credits(id(), target, packet);
      rights(target, packet) = static_cast<std::uint16_t>(count);
      node.grant(nodes::NodeId{target}, channel_of(packet), count);
    }
  }
}

std::uint16_t& HostedNode::rights(std::uint32_t target, Index packet) const {
  return rights_[target * plan_.needs().packets.size() + packet];
}

void HostedNode::check(std::uint32_t target, Index packet, std::size_t payload_bytes) const {
  if (packet >= plan_.needs().packets.size() || target >= node_count()) {
    throw ProgramError("packet " + std::to_string(packet) + " to node " + std::to_string(target) + ": there are " +
                       std::to_string(plan_.needs().packets.size()) + " packets and " + std::to_string(node_count()) + " nodes");
  }
  const PacketNeed& need = plan_.needs().packets[packet];
  if (payload_bytes > need.bytes_max) {
    throw ProgramError(with_name("a packet", need.name) + " of " + std::to_string(payload_bytes) + " bytes: at most " +
                       std::to_string(need.bytes_max) + " are declared");
  }
}

std::uint32_t HostedNode::sendable(std::uint32_t target, Index packet) const {
  check(target, packet, 0);
  return plan_.request_of(packet) ? 0 : rights(target, packet);
}

bool HostedNode::try_send(std::uint32_t target, Index packet, std::span<const std::byte> payload) {
  check(target, packet, payload.size());
  if (plan_.request_of(packet)) {
    throw ProgramError(with_name("the packet", plan_.needs().packets[packet].name) + " is an answer: answer() sends it");
  }
  if (rights(target, packet) == 0) {
    ++node_.counters().refused;
    return false;
  }
  --rights(target, packet);
  node_.send_reserved(nodes::NodeId{target}, channel_of(packet), static_cast<nodes::PacketKind>(packet), payload);
  return true;
}

void HostedNode::answer(std::uint32_t target, Index packet, std::span<const std::byte> payload) {
  check(target, packet, payload.size());
  if (!plan_.request_of(packet) || rights(target, packet) == 0) {
    throw ProgramError(with_name("the packet", plan_.needs().packets[packet].name) + " to node " + std::to_string(target) +
                       " answers nothing that came from there");
  }
  --rights(target, packet);
  node_.grant(nodes::NodeId{target}, channel_of(packet));
  node_.send_reserved(nodes::NodeId{target}, channel_of(packet), static_cast<nodes::PacketKind>(packet), payload);
}

void HostedNode::charge(Index operation, std::uint64_t count) {
  if (operation >= plan_.needs().operations.size()) {
    throw ProgramError("operation " + std::to_string(operation) +
                       " is charged: " + std::to_string(plan_.needs().operations.size()) + " are declared");
  }
  charge_within_bounds(charges_.count[operation], count, own_name(plan_.needs().operations[operation].name));
}

void HostedNode::take_note(const nodes::Packet& packet) {
  const std::uint32_t source = nodes::index_of(packet.source);
  if (const auto answer = plan_.answer_of(packet.kind)) {
    ++rights(source, *answer);
  } else if (const auto request = plan_.request_of(packet.kind)) {
    ++rights(source, *request);
    node_.grant(packet.source, channel_of(*request));
  }
}

std::vector<Unanswered> HostedNode::awaited() const {
  std::vector<Unanswered> all;
  for (std::uint32_t target = 0; target < node_count(); ++target) {
    for (Index packet = 0; packet < plan_.needs().packets.size(); ++packet) {
      const auto answer = plan_.answer_of(packet);
      if (const std::uint32_t count = plan_.credits(id(), target, packet) - rights(target, packet); answer && count > 0) {
        all.push_back({target, plan_.needs().packets[*answer].name, count});
      }
    }
  }
  return all;
}

std::vector<Unanswered> HostedNode::owed() const {
  std::vector<Unanswered> all;
  for (std::uint32_t target = 0; target < node_count(); ++target) {
    for (Index packet = 0; packet < plan_.needs().packets.size(); ++packet) {
      if (plan_.request_of(packet) && rights(target, packet) > 0) {
        all.push_back({target, plan_.needs().packets[packet].name, rights(target, packet)});
      }
    }
  }
  return all;
}

std::byte* HostedNode::allocate_bytes(Index memory, std::size_t bytes) {
  const std::vector<MemoryNeed>& needs = plan_.needs().memory;
  if (memory >= needs.size()) {
    throw ProgramError("memory " + std::to_string(memory) + " is asked for: " + std::to_string(needs.size()) +
                       " pieces are declared");
  }
  const std::size_t declared = bytes_of<std::byte>(needs[memory].bytes), left = declared - used_bytes_[memory];
  if (bytes > left) {
    throw ProgramError(with_name("the memory", needs[memory].name) + " has " + std::to_string(left) + " of " +
                       std::to_string(declared) + " bytes left: " + std::to_string(bytes) + " are asked for");
  }
  if (node_.memory().sealed()) {
    throw ProgramError(with_name("the memory", needs[memory].name) + " is asked for after the start");
  }
  used_bytes_[memory] += bytes;
  return node_.memory().allocate<std::byte>(ProgramMemory::declared, bytes).data();
}

HostedProgram::HostedProgram(nodes::Node& node, const ProgramPlan& plan, const Make& make)
    : node_(node, plan), program_(call_program(node_.id(), "make()", [&] { return made(make, node_); })) {}

std::unique_ptr<dmpc::Program> HostedProgram::made(const Make& make, Node& node) {
  std::unique_ptr<dmpc::Program> program = make(node);
  if (program == nullptr) {
    throw ProgramError("what it returned is no program");
  }
  return program;
}

void HostedProgram::receive(const nodes::Packet& packet) {
  node_.take_note(packet);
  call_program(node_.id(), "receive()", [&] {
    program_->receive({.source = nodes::index_of(packet.source), .kind = packet.kind, .payload = packet.payload});
  });
}

}  // namespace dmpc::apps
