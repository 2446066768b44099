// What programs see of a computer and how a run ends, whatever drives the nodes: a thread each, a pool of threads, virtual time.
#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/runner.h"
#include "tests/nodes/scripted_machine.h"
#include "tests/nodes/toy_machine.h"
#include "tests/nodes/toy_programs.h"
#include "tests/support/complaint.h"

namespace dmpc::tests::runners_test {
namespace {

using namespace nodes;

/// Calls check(make) for each kind of computer, with which make(specifications) makes a runner; is_pool says whether it is a
/// pool.
template <class Check>
void on_each_computer(const Check& check) {
  std::vector<ComputerRequest> computers(6);
  const std::uint32_t pools[] = {1, 2, 3, 5};
  for (std::size_t i = 0; i < 4; ++i) {
    computers[i].pool_threads = pools[i];
  }
  computers[4].machine = toy_model(TopologyKind::torus);
  for (const ComputerRequest& computer : computers) {
    CAPTURE(computer.pool_threads.value_or(0));
    CAPTURE(computer.machine.has_value());
    check([&computer](const std::vector<NodeSpecification>& specifications) { return make_runner(specifications, computer); },
          computer.pool_threads.has_value());
  }
}

TEST_CASE("programs that are finished from the start end the run of any computer, of fewer nodes than threads, too") {
  on_each_computer([](const auto& make, bool is_pool) {
    for (const std::uint32_t count : {1U, 2U, 65U}) {
      const auto runner = make(equal_nodes(count, {}, making<ToyProgram>()));
      CHECK(runner->run({}) == RunEnd::finished);
      CHECK((!is_pool || runner->node(0).counters().quanta == 0));
    }
  });
}

TEST_CASE("a token goes round the ring of any computer") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    for (const std::uint32_t count : {1U, 2U, 3U, 65U}) {
      const auto runner = make(equal_nodes(count, TokenRound::mailbox, making<TokenRound>(20U)));
      CHECK(runner->run({}) == RunEnd::finished);
      for (std::uint32_t i = 0; i < count; ++i) {
        CHECK(program_of<TokenRound>(*runner, i).passed() == 20);
        CHECK(runner->node(i).counters().sent[1].packets == 20);
        CHECK(runner->node(i).counters().received[1].bytes == 20 * 12);
      }
    }
  });
}

TEST_CASE("every request is answered on any computer, with one credit or many") {
  on_each_computer([](const auto& make, bool is_pool) {
    for (const auto& [peers, window] : {std::pair{2U, 1U}, std::pair{5U, 1U}, std::pair{5U, 7U}, std::pair{24U, 1U}}) {
      const auto runner = make(equal_nodes(peers, Requester::mailbox(peers, window), making<Requester>(20U, window)));
      CHECK(runner->run({}) == RunEnd::finished);
      std::uint64_t refused = 0;
      for (std::uint32_t i = 0; i < peers; ++i) {
        CHECK(program_of<Requester>(*runner, i).all_right());
        CHECK(runner->node(i).counters().received[request].packets == 20 * (peers - 1));
        CHECK(runner->node(i).counters().received[reply].packets == 20 * (peers - 1));
        refused += runner->node(i).counters().refused;
      }
      CHECK((is_pool || refused > 0));  // in turns each answer may be there before the next question
    }
  });
}

TEST_CASE("packets that may wait arrive in order on any computer, overtaken by none, and before their sender sleeps") {
  std::vector<std::uint32_t> expected(Patient::count);
  std::iota(expected.begin(), expected.end(), 0);
  on_each_computer([&](const auto& make, bool /*is_pool*/) {
    for (const std::uint32_t hasty_one : {0U, 6U, 37U, 99U}) {
      auto specifications = equal_nodes(2, Patient::mailbox, making<Patient>(hasty_one));
      specifications[0].batching = {.kinds = 1U << 1U, .packets = 5};
      const auto runner = make(specifications);
      CHECK(runner->run({}) == RunEnd::finished);
      CHECK(program_of<Patient>(*runner, 1).received() == expected);
    }
  });
}

TEST_CASE("a node of any computer that puts work off, in case a packet comes, does it before it sleeps") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    for (const std::uint32_t nodes : {2U, 20U}) {  // whose own threads do not look again, and do
      CHECK(make(equal_nodes(nodes, {.small_slots = 1}, making<PutsOff>()))->run({}) == RunEnd::finished);
    }
  });
}

TEST_CASE("a stall ends the run of any computer with a report on every node") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    const std::string report = tests::complaint_of<DeadlockError>([&] { make(equal_nodes(3, {}, making<Waiter>()))->run({}); });
    CHECK((report.find("all nodes sleep") != std::string::npos || report.find("nothing is under way") != std::string::npos));
    CHECK(report.find("node 0 (finished): waits for Godot") != std::string::npos);
    CHECK(report.find("node 1: waits for Godot") != std::string::npos);
    CHECK(report.find("host: waits for Godot") != std::string::npos);
  });
}

TEST_CASE("an exception of a program ends the run of any computer, whoever sleeps, and comes out of it once") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    CHECK_THROWS_WITH_AS(make(equal_nodes(8, {}, making<Worker>(true)))->run({}), "the hundredth quantum", std::runtime_error);
    auto specifications = equal_nodes(8, {}, making<Waiter>());
    specifications[3].make_program = making<Worker>(true);
    CHECK_THROWS_WITH_AS(make(specifications)->run({}), "the hundredth quantum", std::runtime_error);
  });
}

TEST_CASE("a stop request ends workers and sleepers of any computer alike") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    auto specifications = equal_nodes(8, {}, making<Waiter>());
    specifications[0].make_program = making<Worker>(false);
    const auto runner = make(specifications);
    std::stop_source stop;
    std::jthread stopper([&stop] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      stop.request_stop();
    });
    CHECK(runner->run(stop.get_token()) == RunEnd::interrupted);
  });
}

TEST_CASE("a stop request before the start ends the run of any computer at once, and no other follows") {
  on_each_computer([](const auto& make, bool /*is_pool*/) {
    const auto runner = make(equal_nodes(4, {}, making<Worker>(false)));
    std::stop_source stop;
    stop.request_stop();
    CHECK(runner->run(stop.get_token()) == RunEnd::interrupted);
    CHECK(runner->node(0).counters().quanta < 100);
    CHECK_THROWS_AS(runner->run({}), core::InternalError);
  });
}

/// Adds up what it is told; each node's on its own, since several may tell at a time.
class PassedBytes final : public Observer {
 public:
  void ended(const Span& /*span*/, const Program& /*program*/) override {}
  void sent(const Passing& packet) override { bytes_sent[index_of(packet.node)] += packet.payload_bytes(); }
  void received(const Passing& packet) override { bytes_received[index_of(packet.node)] += packet.payload_bytes(); }

  std::array<std::size_t, 3> bytes_sent{}, bytes_received{};
};

TEST_CASE("bytes that never change are referred to in a pool and on a machine, else copied, and count and arrive alike") {
  const ComputerRequest threads, pool{.pool_threads = 1}, larger_pool{.pool_threads = 2}, machine{.machine = toy_model()},
      disturbed_pool{.chaos = Chaos{.seed = 1, .held_percent = 100}, .pool_threads = 2};
  for (const ComputerRequest& computer : {threads, disturbed_pool, pool, larger_pool, machine}) {
    CAPTURE(computer.pool_threads.value_or(0));
    auto specifications = disturbed(equal_nodes(3, {.small_slots = 3}, making<SendsLasting>()));
    specifications[0].batching = {.kinds = 1U << 1U, .packets = 10};
    PassedBytes passed;
    for (Observer* const observer : {static_cast<Observer*>(nullptr), static_cast<Observer*>(&passed)}) {
      const auto runner = make_runner(specifications, computer, observer);
      CHECK(runner->run({}) == RunEnd::finished);
      const auto& receiver = program_of<SendsLasting>(*runner, 1);
      CHECK(receiver.kinds == std::vector<PacketKind>{1, 2, 3});
      CHECK(receiver.is_whole);
      CHECK(receiver.is_in_place == (computer.immutable() == Immutable::is_referred_to));
      CHECK(runner->node(0).counters().sent[2].bytes == sizeof(PacketHeader) + 48);
      CHECK(runner->node(1).counters().received[2].bytes == sizeof(PacketHeader) + 48);
    }
    CHECK(passed.bytes_sent == std::array<std::size_t, 3>{56, 0, 0});
    CHECK(passed.bytes_received == std::array<std::size_t, 3>{0, 56, 0});
  }
  CHECK(threads.immutable() == Immutable::is_copied);
  CHECK(disturbed_pool.immutable() == Immutable::is_copied);
  CHECK(pool.immutable() == Immutable::is_referred_to);
  CHECK(machine.immutable() == Immutable::is_referred_to);
}

TEST_CASE("a memory is sealed before the run of any computer begins, and is as full on each") {
  const auto specifications = equal_nodes(4, TokenRound::mailbox, making<TokenRound>(1U));
  const auto threads = make_runner(specifications, {});
  CHECK(threads->node(0).memory().used()[Category::queues] == MemoryPlan(credit_table(4)).total());
  on_each_computer([&](const auto& make, bool /*is_pool*/) {
    const auto runner = make(specifications);
    for (std::uint32_t i = 0; i < 4; ++i) {
      CHECK(runner->node(i).memory().sealed());
      CHECK(runner->node(i).memory().used().bytes == threads->node(i).memory().used().bytes);
    }
  });
}

}  // namespace
}  // namespace dmpc::tests::runners_test
