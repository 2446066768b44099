// A program that does nothing: only its presence matters.
#pragma once

#include <string>

#include "nodes/program.h"

namespace dmpc::nodes {

class SilentProgram final : public Program {
 public:
  void receive(const Packet& /*packet*/) override {}
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return ""; }
};

}  // namespace dmpc::nodes
