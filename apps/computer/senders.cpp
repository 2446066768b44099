#include "apps/computer/dmpc/computer.h"

namespace dmpc {

Senders from_each_other(std::uint32_t count) {
  return [count](std::uint32_t source, std::uint32_t target, std::uint32_t) { return source == target ? 0 : count; };
}

Senders from_previous(std::uint32_t count) {
  return [count](std::uint32_t source, std::uint32_t target, std::uint32_t node_count) {
    return (source + 1) % node_count == target ? count : 0;
  };
}

Senders from_node(std::uint32_t sender, std::uint32_t count) {
  return [sender, count](std::uint32_t source, std::uint32_t target, std::uint32_t) {
    return source == sender && target != sender ? count : 0;
  };
}

Senders to_node(std::uint32_t receiver, std::uint32_t count) {
  return [receiver, count](std::uint32_t source, std::uint32_t target, std::uint32_t) {
    return target == receiver && source != receiver ? count : 0;
  };
}

}  // namespace dmpc
