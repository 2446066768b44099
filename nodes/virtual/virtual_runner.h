// Runs the node programs on a modelled machine, in virtual time, on the calling thread: equal runs, equal events.
//
// A discrete-event simulation, sequential and conservative: the least event by (time, source, sequence) happens next. A call of
// work() or receive() takes no virtual time while the real computer executes it; the operations that the program charges
// meanwhile are priced, and until they are finished no other packet reaches the program. The packets that it sent leave then, one
// after the other. Packets of an interrupt kind are served when they arrive: if the node is computing, that ends later by the
// same time.
//
// Messages between two nodes keep the order in which they were sent, in virtual time: a short one waits behind a long one until
// that has entered the network, and an interrupt's reply leaves before the packets of the quantum that it interrupts.
//
// Simplifications: a message that waits for its links blocks them for later messages only, not while its header advances, and a
// long message's handshake with its receiver is part of its latency. An interrupt delays a processor that is sending, but not the
// packets that it is sending.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "nodes/machine.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// Without threads, and independent of real clocks: several may run side by side. Otherwise as Runner.
class VirtualRunner final : public Runner {
 public:
  /// `specifications`: the nodes in order, then the host. `observer`, if given, gets events in virtual time.
  VirtualRunner(std::span<const NodeSpecification> specifications, const Machine& machine, Observer* observer = nullptr);
  ~VirtualRunner() override;

  RunEnd run(std::stop_token stop) override;
  Node& node(std::size_t index) override;
  Program& program(std::size_t index) override;
  std::vector<std::string> gather(const Report& report) override;

  std::optional<VirtualReport> virtual_report() const override;

 private:
  struct Implementation;
  template <bool is_watched>
  struct Simulation;

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dmpc::nodes
