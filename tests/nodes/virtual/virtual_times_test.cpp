// Programs so small that their times can be told on paper.
#include "nodes/virtual/virtual_times.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "tests/nodes/scripted_machine.h"

namespace dmpc::tests::virtual_times_test {
namespace {

using namespace nodes;

constexpr std::uint64_t operation_ns = 1000;

/// From a message's first byte in the network to its last.
std::uint64_t passage_ns(const Machine& machine, std::uint64_t bytes, std::uint32_t hops) {
  return hops * machine.hop_ns + bytes * machine.cost_of_message(bytes).byte_ps / 1000;
}
/// From the call of send to the message's arrival.
std::uint64_t arrival_ns(const Machine& machine, std::uint64_t bytes, std::uint32_t hops) {
  const MessageCost& cost = machine.cost_of_message(bytes);
  return cost.send_ns + cost.latency_ns + passage_ns(machine, bytes, hops);
}
/// From the call of send to the end of the receive.
std::uint64_t one_way_ns(const Machine& machine, std::uint64_t bytes, std::uint32_t hops) {
  return arrival_ns(machine, bytes, hops) + machine.cost_of_message(bytes).receive_ns;
}
/// What an interrupt takes of its node that is answered by one letter.
std::uint64_t service_ns(const Machine& machine, std::uint64_t operations, std::uint64_t reply_bytes) {
  return machine.cost_of_message(short_bytes).receive_ns + machine.service_ns + operations * operation_ns +
         machine.cost_of_message(reply_bytes).send_ns;
}

/// Sends one letter in its only quantum.
Script sends(const Letter& letter, std::uint64_t operations = 0) { return {.quanta = {{operations, {letter}}}}; }

/// Nodes 1 .. count send a letter to the host at the start: all by way of node 0.
std::vector<Script> all_to_host(std::uint32_t count, std::uint64_t bytes) {
  std::vector<Script> scripts(count + 2, sends({.target = count + 1, .bytes = bytes}));
  scripts.front() = {};
  scripts.back() = {};
  return scripts;
}

TEST_CASE("a ping-pong takes twice what a message takes, over each number of hops, short and long") {
  struct Case {
    TopologyKind topology;
    std::uint32_t target, hops;  // from node 0 of 8
  };
  const std::vector<Case> cases = {
      {TopologyKind::crossbar, 7, 1},  {TopologyKind::hypercube, 1, 1}, {TopologyKind::hypercube, 3, 2},
      {TopologyKind::hypercube, 6, 2}, {TopologyKind::hypercube, 7, 3}, {TopologyKind::mesh, 3, 3},
      {TopologyKind::mesh, 7, 4},      {TopologyKind::torus, 3, 1},     {TopologyKind::torus, 7, 2},
      {TopologyKind::fat_tree, 3, 2},  {TopologyKind::fat_tree, 4, 4}};
  for (const std::uint64_t bytes : {short_bytes, long_bytes}) {
    for (const auto& [topology, target, hops] : cases) {
      CAPTURE(name_of(topology));
      CAPTURE(target);
      const Machine machine = toy_model(topology);
      std::vector<Script> scripts(9);
      scripts[0] = {.quanta = {{0, {{target, ping, bytes}}}}, .packets_awaited = 1};
      scripts[target].reactions[ping] = {0, {{0, pong, bytes}}};
      CHECK(run_scripts(scripts, machine).report.total_ns == 2 * one_way_ns(machine, bytes, hops));
    }
  }
}

TEST_CASE("what is computed before a packet leaves and after it came is added to its way") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({sends({.target = 1}, 5), {.reactions = {{ping, {3}}}}, {}});
  CHECK(run.report.total_ns == one_way_ns(machine, short_bytes, 1) + 8 * operation_ns);
  CHECK(run.report.nodes[0].computing_ns == 5 * operation_ns);
  CHECK(run.report.nodes[1].computing_ns == 3 * operation_ns);
}

TEST_CASE("a message of a node to itself passes no link") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({sends({.target = 0}), {}});
  const MessageCost& cost = machine.short_message;
  CHECK(run.report.total_ns == cost.send_ns + cost.latency_ns + cost.receive_ns);
  CHECK(run.report.links.messages == 0);
}

TEST_CASE("a message of the most bytes that are short is short, and one byte more makes it long") {
  const Machine machine = toy_model();
  for (const std::uint64_t bytes : {99U, 100U, 101U, 102U}) {
    const MessageCost& cost = bytes <= 100 ? machine.short_message : machine.long_message;
    CHECK(run_scripts({sends({1, ping, bytes}), {}, {}}).report.total_ns ==
          cost.send_ns + cost.latency_ns + machine.hop_ns + bytes * cost.byte_ps / 1000 + cost.receive_ns);
  }
}

TEST_CASE("messages over one link arrive one after the other, or at once without contention") {
  for (const std::uint32_t count : {1U, 2U, 9U}) {
    Machine machine = toy_model();
    const std::uint64_t passage = passage_ns(machine, long_bytes, 2);
    const std::uint64_t held = passage_ns(machine, long_bytes, 1);  // the host's link, before which the next ones' headers wait
    const std::uint64_t enters = machine.long_message.send_ns + machine.long_message.latency_ns;
    const ScriptedRun run = run_scripts(all_to_host(count, long_bytes), machine);
    CHECK(run.report.total_ns == enters + machine.hop_ns + count * held + machine.long_message.receive_ns);
    CHECK(run.report.links.wait_ns == held * count * (count - 1) / 2);

    machine.has_contention = false;
    const ScriptedRun free = run_scripts(all_to_host(count, long_bytes), machine);
    CHECK(free.report.total_ns == enters + passage + count * machine.long_message.receive_ns);
    CHECK(free.report.links.wait_ns == 0);
  }
}

TEST_CASE("a message reserves its links when it enters the network, not when it is sent") {
  const Machine machine = toy_model();
  std::vector<Script> scripts(4);
  scripts[1] = sends({.target = 3, .bytes = long_bytes});  // is sent first and enters later
  scripts[2] = sends({.target = 3, .bytes = short_bytes});
  const ScriptedRun run = run_scripts(scripts, machine);
  CHECK(run.receipts[3].front().source == 2);
  CHECK(run.report.links.wait_ns == 0);
}

TEST_CASE("messages between two nodes keep their order even when a short one follows a long one") {
  for (const bool has_contention : {true, false}) {
    Machine machine = toy_model();
    machine.has_contention = has_contention;
    const ScriptedRun run = run_scripts({{.quanta = {{0, {{1, ping, long_bytes}, {1, pong, short_bytes}}}}}, {}, {}}, machine);
    REQUIRE(run.receipts[1].size() == 2);
    CHECK(run.receipts[1][0].kind == ping);
    CHECK(run.receipts[1][1].kind == pong);
  }
}

TEST_CASE("an urgent message does not overtake a long one that the same node sent before") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({{.quanta = {{0, {{1, ping, long_bytes}, {1, urgent, short_bytes}}}}}, {}, {}}, machine);
  REQUIRE(run.receipts[1].size() == 2);
  CHECK(run.receipts[1][0].kind == ping);
  CHECK(run.receipts[1][1].kind == urgent);
}

TEST_CASE("packets of one quantum leave at its end, one after the other, and each costs its sender") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({{.quanta = {{5, {{1}, {2}, {3}}}}}, {}, {}, {}, {}});
  for (std::uint32_t i = 0; i < 3; ++i) {
    CHECK(run.end_ns(1 + i) == 5 * operation_ns + i * machine.short_message.send_ns + one_way_ns(machine, short_bytes, 1));
  }
  CHECK(run.report.nodes[0].sending_ns == 3 * machine.short_message.send_ns);
  CHECK(run.end_ns(0) == 5 * operation_ns + run.report.nodes[0].sending_ns);
}

TEST_CASE("an interrupt makes a computation end later by what it takes, and the packet of that quantum leave later") {
  const Machine machine = toy_model();
  const auto scripts = [](bool interrupts) {
    Script computes = sends({.target = 2}, 100);
    computes.reactions[urgent] = {2, {{0, pong, long_bytes}}};
    return std::vector<Script>{interrupts ? sends({1, urgent}) : Script{}, computes, {}, {}};
  };
  const std::uint64_t service = service_ns(machine, 2, long_bytes);
  const ScriptedRun calm = run_scripts(scripts(false)), service_busy = run_scripts(scripts(true));
  CHECK(calm.report.nodes[1].service_busy_ns == 0);
  CHECK(service_busy.report.nodes[1].service_busy_ns == service);
  CHECK(service_busy.report.nodes[1].computing_ns == calm.report.nodes[1].computing_ns);
  CHECK(service_busy.end_ns(1) == calm.end_ns(1) + service);
  CHECK(service_busy.end_ns(2) == calm.end_ns(2) + service);
  const std::uint64_t reply = arrival_ns(machine, long_bytes, 1) - machine.long_message.send_ns;
  CHECK(service_busy.end_ns(0) == arrival_ns(machine, short_bytes, 1) + service + reply + machine.long_message.receive_ns);
}

TEST_CASE("interrupts are served in the order of their coming, one after the other") {
  const Machine machine = toy_model();
  Script serves = sends({.target = 3}, 1000);
  serves.reactions[urgent] = {2, {}};
  Script asks = sends({1, urgent});
  serves.reactions[urgent].letters = {{0, pong}, {2, pong}};  // the second answer to 0 and to 2 ends each service
  const ScriptedRun run = run_scripts({asks, serves, asks, {}, {}});
  const std::uint64_t service = service_ns(machine, 2, short_bytes) + machine.short_message.send_ns;
  CHECK(run.report.nodes[1].service_busy_ns == 2 * service);
  const std::uint64_t begin = arrival_ns(machine, short_bytes, 1), way = one_way_ns(machine, short_bytes, 1);
  CHECK(run.end_ns(2) == begin + 2 * service + way - machine.short_message.send_ns);
  CHECK(run.end_ns(0) == run.end_ns(2) - machine.short_message.send_ns);
  CHECK(run.receipts[1][0].source == 0);
  CHECK(run.receipts[1][1].source == 2);
}

TEST_CASE("a node with nothing to do serves at once, and what comes meanwhile begins after the service") {
  const Machine machine = toy_model();
  const std::vector<Script> scripts = {
      {.quanta = {{0, {{1, urgent}, {1, ping}}}}}, {.reactions = {{urgent, {2, {{0, pong}}}}, {ping, {3}}}}, {}};
  const ScriptedRun run = run_scripts(scripts);
  const std::uint64_t arrival = arrival_ns(machine, short_bytes, 1), service = service_ns(machine, 2, short_bytes);
  const VirtualTimes& served = run.report.nodes[1];
  CHECK(served.service_idle_ns == service);
  CHECK(served.service_busy_ns == 0);
  CHECK(served.waiting_ns[ping] == arrival);
  CHECK(served.receiving_ns == machine.short_message.receive_ns);
  CHECK(run.end_ns(1) == arrival + service + machine.short_message.receive_ns + 3 * operation_ns);
  CHECK(run.end_ns(0) == arrival + service + one_way_ns(machine, short_bytes, 1) - machine.short_message.send_ns);
}

TEST_CASE("a home that does nothing else serves one request after the other, as fast as its processor can") {
  constexpr std::uint32_t requesters = 3, requests = 5;
  const Machine machine = toy_model();
  const Script asks{.quanta = {{0, std::vector<Letter>(requests, Letter{0, urgent})}}};
  const Script serves{.reactions = {{urgent, {2, {{4, pong, long_bytes}}}}}};
  const std::vector<Script> scripts{serves, asks, asks, asks, {}};
  const ScriptedRun run = run_scripts(scripts, machine);
  const std::uint64_t service = service_ns(machine, 2, long_bytes), replies = requesters * requests;
  CHECK(run.report.nodes[0].service_idle_ns == replies * service);
  CHECK(run.report.nodes[0].service_busy_ns == 0);
  const std::uint64_t last_reply = arrival_ns(machine, short_bytes, 1) + replies * service;
  CHECK(run.report.total_ns == last_reply + one_way_ns(machine, long_bytes, 1) - machine.long_message.send_ns);
}

TEST_CASE("a run lasts until its last service is over") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({sends({1, urgent}), {.reactions = {{urgent, {2}}}}, {}});
  const std::uint64_t service = service_ns(machine, 2, short_bytes) - machine.short_message.send_ns;
  CHECK(run.report.total_ns == arrival_ns(machine, short_bytes, 1) + service);
  CHECK(run.report.nodes[1].service_idle_ns == service);
  CHECK(run.report.nodes[1].end_ns == arrival_ns(machine, short_bytes, 1));
}

TEST_CASE("receiving costs a busy node at the arrival, and the packet is received when the quantum is over") {
  const Machine machine = toy_model();
  Script busy = sends({.target = 2}, 100);
  busy.quanta.push_back({50});
  busy.reactions[ping] = {7};
  const ScriptedRun run = run_scripts({sends({.target = 1}), busy, {}, {}});
  const std::uint64_t receive = machine.short_message.receive_ns, send = machine.short_message.send_ns;
  CHECK(run.end_ns(1) == (100 + 7 + 50) * operation_ns + receive + send);
  CHECK(run.end_ns(2) == 100 * operation_ns + receive + one_way_ns(machine, short_bytes, 1));
  CHECK(run.report.nodes[1].receiving_ns == receive);
}

TEST_CASE("rates are summed in picoseconds: what is less than a nanosecond is not lost") {
  Machine machine = toy_model();
  machine.cost_ps[0] = 300;
  for (const std::uint64_t quanta : {1U, 3U, 4U, 100U}) {
    const ScriptedRun run = run_scripts({{.quanta = std::vector<Act>(quanta, Act{1})}, {}}, machine);
    CHECK(run.report.nodes[0].computing_ns == quanta * 300 / 1000);
  }
}

TEST_CASE("waiting is charged to the kind of packet that ended it") {
  const Machine machine = toy_model();
  const ScriptedRun run = run_scripts({sends({.target = 1}), {}, sends({1, pong}, 100), {}});
  const VirtualTimes& waiter = run.report.nodes[1];
  const std::uint64_t first = arrival_ns(machine, short_bytes, 1), second = first + 100 * operation_ns;
  CHECK(waiter.waiting_ns[ping] == first);
  CHECK(waiter.waiting_ns[pong] == second - first - machine.short_message.receive_ns);
  CHECK(waiter.end_ns == 0);
  CHECK(waiter.total_ns() == run.report.total_ns);
}

TEST_CASE("a node that never has anything to do is at its end from the start") {
  const ScriptedRun run = run_scripts({{.quanta = {{5}}}, {}, {}});
  CHECK(run.report.total_ns == 5 * operation_ns);
  CHECK(run.report.nodes[0].end_ns == 0);
  CHECK(run.report.nodes[1].end_ns == run.report.total_ns);
}

TEST_CASE("a total is the sum of its parts") {
  VirtualTimes times{.computing_ns = 1, .sending_ns = 2, .receiving_ns = 4, .service_busy_ns = 8, .service_idle_ns = 16};
  times.waiting_ns[0] = 32;
  times.waiting_ns[packet_kind_count - 1] = 64;
  times.end_ns = 128;
  CHECK(times.total_ns() == 255);
  CHECK(VirtualTimes{}.total_ns() == 0);
}

}  // namespace
}  // namespace dmpc::tests::virtual_times_test
