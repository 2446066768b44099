// Between start and end no node's thread allocates.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/nodes/toy_machine.h"
#include "tests/support/allocation_guard.h"

namespace dmpc::tests::runner_allocation_test {
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

std::uint64_t allocated_by(const ProgramMaker& maker, const std::optional<nodes::Chaos>& chaos = std::nullopt,
                           const std::optional<std::uint32_t>& pool_threads = std::nullopt) {
  auto specifications = disturbed(equal_nodes(8, TokenRound::mailbox, maker));
  std::transform(specifications.begin(), specifications.end(), specifications.begin(), watched);
  nodes::ThreadsRunner runner(specifications, chaos, nullptr, pool_threads);
  return allocated_in_run(runner);
}

TEST_CASE("from start to end no thread of a node allocates or frees, the runner's code included") {
  CHECK(allocated_by(making<TokenRound>(50U)) == 0);
}

TEST_CASE("the threads of a pool allocate as little, in turns, sleeps and chaos") {
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    CHECK(allocated_by(making<TokenRound>(50U), std::nullopt, threads) == 0);
    CHECK(allocated_by(making<TokenRound>(50U), nodes::Chaos{.seed = 1, .slow_node_percent = 50}, threads) == 0);
  }
}

TEST_CASE("packets held back take nothing but the node's own memory") {
  CHECK(allocated_by(making<TokenRound>(50U), nodes::Chaos{.seed = 1, .slow_node_percent = 50}) == 0);
}

TEST_CASE("a program that allocates is found out") { CHECK(allocated_by(making<Spendthrift>(50U)) > 0); }

}  // namespace
}  // namespace dmpc::tests::runner_allocation_test
