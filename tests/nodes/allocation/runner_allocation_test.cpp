// Between start and end no node's thread allocates.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "tests/nodes/toy_machine.h"
#include "tests/support/allocation_guard.h"

namespace dmpc::tests {
namespace {

/// Passes the token, and allocates once when node 1 has it.
class Spendthrift final : public TokenRound {
 public:
  using TokenRound::TokenRound;
  bool work() override {
    if (index() == 1 && passed() == 1) {
      kept_.push_back(1);
    }
    return TokenRound::work();
  }

 private:
  std::vector<int> kept_;
};

std::uint64_t allocated_by(const ProgramMaker& maker) {
  auto specifications = equal_nodes(8, TokenRound::mailbox, maker);
  for (nodes::NodeSpecification& specification : specifications) {
    specification = watched(specification);
  }
  nodes::ThreadsRunner runner(specifications);
  const Allocations before = watched_allocations();
  static_cast<void>(runner.run({}));
  const Allocations after = watched_allocations();
  return after.allocated - before.allocated + after.freed - before.freed;
}

TEST_CASE("from start to end no thread of a node allocates or frees, the runner's code included") {
  CHECK(allocated_by(making<TokenRound>(50U)) == 0);
}

TEST_CASE("a program that allocates is found out") { CHECK(allocated_by(making<Spendthrift>(50U)) > 0); }

}  // namespace
}  // namespace dmpc::tests
