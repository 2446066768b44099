// Runs the node programs on a modelled machine, in virtual time, on the calling thread: equal runs, equal events.
//
// A discrete-event simulation, sequential and conservative: the least event by (time, source, sequence) happens next. A call of
// work() or receive() takes no virtual time while the host executes it; the operations that the program charges meanwhile are
// priced, and until they are done no other packet reaches the program. What it sent leaves then, one packet after the other.
// Packets of an interrupt kind are served when they arrive: if the node is computing, that ends later by as much.
//
// Messages between two nodes keep the order in which they were sent, in virtual time: a short one waits behind a long one until
// that has entered the network, and an interrupt's reply leaves before the packets of the quantum that it interrupts.
//
// Simplifications: a message that waits for its links blocks them for later messages only, not while its header advances, and
// what a long message asks of its receiver beforehand is part of its latency. A processor that is sending is delayed by an
// interrupt, but not the packets that it is sending.
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

/// No thread of its own, no clock of the host's: several may run side by side. As Runner otherwise.
class VirtualRunner final : public Runner {
 public:
  /// `specifications`: the nodes in order, then the host, last. `observer`, if there is one, is told what happens, in virtual
  /// time.
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
