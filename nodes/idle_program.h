// The host's program where nodes need no host.
#pragma once

#include <string>

#include "core/base/expect.h"
#include "nodes/program.h"

namespace dmpc::nodes {

class IdleProgram final : public Program {
 public:
  void receive(const Packet& /*packet*/) override { core::expect(false, "nobody sends the host anything"); }
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return "nothing to do"; }
};

}  // namespace dmpc::nodes
