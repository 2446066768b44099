#include "nodes/observers/exchange_profile.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "tests/nodes/scripted_machine.h"
#include "tests/support/topologies.h"

namespace dmpc::tests::exchange_profile_test {
namespace {

using namespace nodes;

std::uint64_t sum_of(std::span<const std::uint64_t> row) { return std::accumulate(row.begin(), row.end(), std::uint64_t{0}); }

/// Node 0 sends node 3 three letters, node 1 sends the host one; all but pongs count.
struct Letters {
  explicit Letters(TopologyKind kind)
      : profile({.node_count = 4, .topology = kind, .pair_kinds = 1U << ping, .number_count = 8}) {
    std::vector<Script> scripts(5);
    scripts[0].quanta = {{1, {{3, ping}, {3, ping, long_bytes}}}, {90, {{3, ping}}}};
    scripts[1].quanta = {{5, {{4, pong}}}};
    run = run_scripts(scripts, toy_model(kind), &profile);
  }
  std::uint64_t pairs(std::uint32_t receiver, std::uint32_t sender) const {
    return sum_of(profile.pairs().row(receiver * 5 + sender));
  }

  ExchangeProfile profile;
  ScriptedRun run;
};

/// Works off a level, quantum by quantum.
class LevelProgram final : public ToyProgram {
 public:
  using ToyProgram::ToyProgram;
  void receive(const Packet& /*packet*/) override {}
  bool work() override { return --level_ > 0; }
  bool finished() const override { return level_ == 0; }
  Levels levels() const override { return {{"rays queued", level_}}; }
  Charges charges() const override {
    Charges charges;
    charges.count[0] = 3 * (4 - level_);
    return charges;
  }
  std::string describe() const override { return ""; }

 private:
  std::uint64_t level_ = 4;
};

}  // namespace

TEST_CASE("packets that count are counted by pair, and by the number with which they begin") {
  const Letters letters(TopologyKind::crossbar);
  CHECK(letters.pairs(3, 0) == 3);
  CHECK(letters.pairs(0, 3) == 0);
  CHECK(letters.pairs(4, 1) == 0);
  for (const std::uint32_t number : {0U, 1U, 2U}) {
    CHECK(sum_of(letters.profile.numbers().row(number)) == 1);
  }
  CHECK(letters.profile.numbers().row(3).empty());
}

TEST_CASE("what each link carried over time adds up to what the machine says that it carried, whatever its topology") {
  for (const TopologyKind kind : all_topologies) {
    CAPTURE(name_of(kind));
    const Letters letters(kind);
    REQUIRE_FALSE(letters.run.report.busiest_links.empty());
    for (const LinkUse& link : letters.run.report.busiest_links) {
      CAPTURE(link.from);
      CAPTURE(link.to);
      CHECK(sum_of(letters.profile.link_bytes(link.from, link.to)) == link.bytes);
    }
  }
}

TEST_CASE("a link that carried nothing, and a memory port, have no row") {
  const Letters letters(TopologyKind::crossbar);
  CHECK(letters.profile.link_bytes("node 2", "node 1").empty());
  CHECK(letters.profile.link_bytes("memory 0", "node 0").empty());
}

TEST_CASE("levels of all nodes are added up, each as it stood until it changed") {
  std::vector<NodeSpecification> specifications;
  for (int i = 0; i < 3; ++i) {
    specifications.push_back({least_plan(3, ScriptedProgram::mailbox), ScriptedProgram::mailbox, making<LevelProgram>(), 0, 0});
  }
  ExchangeProfile profile({.node_count = 2});
  VirtualRunner runner(specifications, toy_model(), &profile);
  REQUIRE(runner.run({}) == RunEnd::finished);
  REQUIRE(profile.level_names() == std::vector<std::string>{"rays queued"});
  const std::vector<std::uint64_t> sums = profile.level_sums(0);
  CHECK(profile.levels().step_ns() == 1024);
  CHECK(sums[2] == 6);  // after 3 us 3 are left, of each of two nodes
  CHECK(sums[4] == 6);
  CHECK(sums[7] == 4);
  CHECK(sums[20] == 0);
}

}  // namespace dmpc::tests::exchange_profile_test
