#include "nodes/virtual/virtual_runner.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "tests/nodes/scripted_machine.h"
#include "tests/nodes/toy_programs.h"
#include "tests/support/topologies.h"

namespace dmpc::tests::virtual_runner_test {
namespace {

using namespace nodes;

/// What interrupts are answered by.
constexpr PacketKind thanks = 4;

/// Nodes that compute, send letters of any kind and length to anybody, and answer the urgent ones and the pings.
std::vector<Script> random_scripts(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Script> scripts(2 + random() % 9);
  const auto letter = [&](PacketKind kind) {
    return Letter{static_cast<std::uint32_t>(random() % scripts.size()), kind, 12 + random() % 3 * 90};
  };
  const PacketKind kinds[] = {ping, urgent, 3};
  for (Script& script : scripts) {
    script.reactions = {{ping, {random() % 3, {letter(pong)}}}, {urgent, {random() % 2, {letter(thanks)}}}};
    for (std::uint64_t quanta = random() % 5; quanta > 0; --quanta) {
      Act act{random() % 300, {}};
      for (std::uint64_t letters = random() % 3; letters > 0; --letters) {
        act.letters.push_back(letter(kinds[random() % 3]));
      }
      script.quanta.push_back(act);
    }
  }
  return scripts;
}

Machine random_machine(std::uint64_t seed) {
  std::mt19937_64 random(seed + 1);
  Machine machine = toy_model(all_topologies[random() % std::size(all_topologies)]);
  machine.has_contention = random() % 4 != 0;
  for (std::uint64_t* cost : {&machine.short_message.latency_ns, &machine.long_message.latency_ns, &machine.hop_ns,
                              &machine.service_ns, &machine.long_message.send_ns, &machine.short_message.receive_ns}) {
    *cost = random() % 3 * (random() % 200'000);
  }
  return machine;
}

/// Urgent letters, those that an interrupt sent, and all others: each come from each sender in the order in which it sent them.
/// An interrupt is served before the others that an earlier call of the program has sent for the end of its quantum.
bool in_order(const std::vector<ScriptedProgram::Receipt>& receipts) {
  std::array<std::array<std::int64_t, 3>, 16> last;
  last.fill({-1, -1, -1});
  bool is_right = true;
  for (const ScriptedProgram::Receipt& receipt : receipts) {
    std::int64_t& before = last[receipt.source][receipt.kind == urgent ? 1 : receipt.kind == thanks ? 2 : 0];
    is_right = is_right && before < receipt.number;
    before = receipt.number;
  }
  return is_right;
}

/// Everything that must be equal in equal runs.
std::vector<std::uint64_t> fingerprint(const ScriptedRun& run) {
  const VirtualReport& report = run.report;
  std::vector<std::uint64_t> print{report.hash,       report.events,        report.total_ns,      report.links.messages,
                                   report.links.hops, report.links.wait_ns, report.links.busy_ns, report.links.bytes};
  for (const LinkUse& use : report.busiest_links) {
    print.insert(print.end(), {use.messages, use.bytes, use.busy_ns, use.wait_ns});
  }
  for (const VirtualTimes& times : report.nodes) {
    print.insert(print.end(), {times.computing_ns, times.sending_ns, times.receiving_ns, times.service_busy_ns,
                               times.service_idle_ns, times.waiting_ns[ping], times.end_ns});
  }
  for (const auto& receipts : run.receipts) {
    for (const ScriptedProgram::Receipt& receipt : receipts) {
      print.insert(print.end(), {receipt.source, receipt.kind, receipt.number});
    }
  }
  return print;
}

VirtualReport report_on(const Machine& machine) {
  std::vector<Script> scripts(4, {.quanta = {{3, {{2, urgent}, {2, ping, 100}, {2, ping, 101}}}, {2}}});
  scripts[2].reactions[urgent] = {1, {{0, pong}}};
  return run_scripts(scripts, machine).report;
}

std::uint64_t hash_of(const Machine& machine) { return report_on(machine).hash; }

/// The hash of a run with one letter that may be changed so that no time changes: the toy's short messages all cost the same but
/// for their bytes.
std::uint64_t hash_of(const Letter& letter) {
  Machine machine = toy_model();
  machine.short_message.byte_ps = 0;
  return run_scripts({{.quanta = {{0, {letter}}}}, {}, {}, {}}, machine).report.hash;
}

TEST_CASE("a virtual computer of nothing is refused") { CHECK_THROWS_AS(VirtualRunner({}, toy_model()), core::InternalError); }

TEST_CASE("another virtual run begins at time 0 on a machine as new: programs that do the same again have the same events") {
  constexpr std::uint32_t peers = 5, window = 2, count = 9;
  VirtualRunner runner(equal_nodes(peers, Requester::mailbox(peers, window), making<Requester>(count, window)), toy_model());
  runner.run({});
  const VirtualReport first = *runner.virtual_report();
  CHECK(first.total_ns > 0);
  for (std::uint32_t i = 0; i < peers; ++i) {
    program_of<Requester>(runner, i).ask(count);
  }
  CHECK(runner.run({}) == RunEnd::finished);
  const VirtualReport again = *runner.virtual_report();
  CHECK(again.hash == first.hash);
  CHECK(again.total_ns == first.total_ns);
  CHECK(again.events == first.events);
  CHECK(again.links.bytes == first.links.bytes);
  CHECK(again.nodes.at(2).total_ns() == first.nodes.at(2).total_ns());
  CHECK(runner.node(1).counters().sent[request].packets == std::uint64_t{count} * (peers - 1));
}

TEST_CASE("a packet without room in the target's mailbox is found out, small or bulk") {
  for (const std::uint64_t bytes : {short_bytes, long_bytes}) {
    auto specifications = specifications_of({{.quanta = {{0, {{1, ping, bytes}, {1, ping, bytes}}}}}, {}, {}});
    VirtualRunner roomy(specifications, toy_model());
    CHECK(roomy.run({}) == RunEnd::finished);
    MailboxCapacity& mailbox = specifications[1].mailbox;
    (bytes == short_bytes ? mailbox.small_slots : mailbox.bulk_slots) = 1;
    VirtualRunner narrow(specifications, toy_model());
    CHECK_THROWS_WITH_AS(narrow.run({}), doctest::Contains("credits leave room"), core::InternalError);
  }
}

TEST_CASE("a place in a mailbox is free again when its packet has been received") {
  auto specifications = specifications_of({{.quanta = {{0, {{1, ping}}}}, .reactions = {{pong, {0, {{1, ping}}}}}},
                                           {.reactions = {{ping, {0, {{2, pong}}}}}, .packets_awaited = 1},
                                           {}});
  specifications[1].mailbox.small_slots = 1;
  VirtualRunner runner(specifications, toy_model());
  CHECK(runner.run({}) == RunEnd::finished);
}

namespace {

/// The first node sends the host, which is all that remembers where it got it from, bytes that last.
class ImmutableSender final : public ToyProgram {
 public:
  static constexpr MailboxCapacity mailbox{.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 104};

  ImmutableSender(Node& node, std::span<const std::byte> immutable, bool is_in_place)
      : ToyProgram(node), immutable_(immutable), is_in_place_(is_in_place), is_sender_(index() == 0) {
    node.grant(host(), 0);
  }
  void receive(const Packet& packet) override {
    CHECK(packet.payload_bytes() == 4 + immutable_.size());
    CHECK((packet.behind(4).data() == immutable_.data()) == is_in_place_);
    CHECK(std::equal(immutable_.begin(), immutable_.end(), packet.behind(4).begin()));
  }
  bool work() override {
    if (std::exchange(is_sender_, false)) {
      const std::array<std::byte, 4> front{};
      std::vector<std::byte> room(front.begin(), front.end());
      room.insert(room.end(), immutable_.begin(), immutable_.end());
      CHECK((is_in_place_ ? node().try_send(host(), 0, ping, front, immutable_, room) : node().try_send(host(), 0, ping, room)));
    }
    return false;
  }
  bool finished() const override { return !is_sender_; }

 private:
  std::span<const std::byte> immutable_;
  bool is_in_place_;
  bool is_sender_;
};

}  // namespace

TEST_CASE("what lasts is handed over where it is, in virtual time, which is the same as of a copy") {
  const std::vector<std::byte> immutable(100, std::byte{9});
  std::vector<std::uint64_t> hashes;
  for (const bool is_in_place : {true, false}) {
    VirtualRunner runner(
        equal_nodes(2, ImmutableSender::mailbox, making<ImmutableSender>(std::span<const std::byte>(immutable), is_in_place)),
        toy_model(TopologyKind::crossbar));
    CHECK(runner.run({}) == RunEnd::finished);
    hashes.push_back(runner.virtual_report()->hash);
    CHECK(total(runner.node(1).counters().received).bytes == sizeof(PacketHeader) + 104);
  }
  CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("a packet longer than the target's bulk places is found out") {
  auto specifications = specifications_of({{.quanta = {{0, {{1, ping, long_bytes}}}}}, {}, {}});
  specifications[1].mailbox.bulk_payload_bytes = long_bytes - sizeof(PacketHeader) - 1;
  VirtualRunner runner(specifications, toy_model());
  CHECK_THROWS_AS(runner.run({}), core::InternalError);
}

TEST_CASE("in any run times add up, nothing is lost, and letters between two nodes keep their order") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const ScriptedRun run = run_scripts(random_scripts(seed), random_machine(seed));
    std::uint64_t sent = 0, received = 0;
    for (std::size_t i = 0; i < run.receipts.size(); ++i) {
      CHECK(run.report.nodes[i].total_ns() == run.report.total_ns);
      CHECK(in_order(run.receipts[i]));
      sent += total(run.counters[i].sent).packets;
      received += run.receipts[i].size();
    }
    CHECK(sent == received);
  }
}

TEST_CASE("equal runs have equal events, one after the other and side by side") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const auto again = [seed] { return fingerprint(run_scripts(random_scripts(seed), random_machine(seed))); };
    const std::vector<std::uint64_t> first = again();
    CHECK(again() == first);
    std::array<std::vector<std::uint64_t>, 2> beside;
    {
      std::jthread one([&] { beside[0] = again(); }), other([&] { beside[1] = again(); });
    }
    CHECK(beside[0] == first);
    CHECK(beside[1] == first);
  }
}

TEST_CASE("each cost of a machine changes the run's hash") {
  const std::uint64_t hash = hash_of(toy_model());
  CHECK(hash_of(toy_model()) == hash);
  const std::vector<std::function<void(Machine&)>> changes = {
      [](Machine& machine) { ++machine.short_message.send_ns; },
      [](Machine& machine) { ++machine.short_message.latency_ns; },
      [](Machine& machine) { ++machine.short_message.receive_ns; },
      [](Machine& machine) { machine.short_message.byte_ps += 100; },
      [](Machine& machine) { ++machine.long_message.send_ns; },
      [](Machine& machine) { ++machine.long_message.latency_ns; },
      [](Machine& machine) { ++machine.long_message.receive_ns; },
      [](Machine& machine) { machine.long_message.byte_ps += 100; },
      [](Machine& machine) { ++machine.hop_ns; },
      [](Machine& machine) { ++machine.service_ns; },
      [](Machine& machine) { ++machine.short_bytes_max; },
      [](Machine& machine) { machine.cost_ps[0] += 1000; },
      [](Machine& machine) { machine.has_contention = false; },
      [](Machine& machine) { machine.has_memory_port = true; },
      [](Machine& machine) { machine.topology = TopologyKind::fat_tree; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    Machine machine = toy_model();
    changes[i](machine);
    CHECK(hash_of(machine) != hash);
  }
}

TEST_CASE("the run's hash tells packets apart by target, kind and bytes, even where no time does") {
  const std::uint64_t hash = hash_of(Letter{1, ping, 20});
  CHECK(hash_of(Letter{1, ping, 20}) == hash);
  CHECK(hash_of(Letter{2, ping, 20}) != hash);
  CHECK(hash_of(Letter{1, pong, 20}) != hash);
  CHECK(hash_of(Letter{1, ping, 21}) != hash);
}

TEST_CASE("a fixed run has one hash on every computer and in every build type") {
  const VirtualReport report = report_on(toy_model(TopologyKind::hypercube));
  CHECK(report.total_ns == 409'137);
  CHECK(report.events == 60);
  CHECK(report.hash == 0x35105f52779bff4e);
  CHECK(report.machine_digest == 0x56eb9b29f606348e);
  CHECK(report.run_hash(0) == 0x70d862130a19acd8);
}

TEST_CASE("a run's hash is of its events, its machine and its product") {
  VirtualReport report = report_on(toy_model());
  CHECK(report.machine_digest == toy_model().digest());
  const std::uint64_t hash = report.run_hash(1);
  CHECK(report.run_hash(2) != hash);
  ++report.machine_digest;
  CHECK(report.run_hash(1) != hash);
  --report.machine_digest;
  ++report.hash;
  CHECK(report.run_hash(1) != hash);
}

TEST_CASE("the busiest links are listed, as many as there is room for") {
  const VirtualReport few = report_on(toy_model());
  CHECK(few.links_used == few.busiest_links.size());
  std::vector<Script> scripts(18);  // a crossbar of 17 nodes has 272 links
  for (std::uint32_t i = 0; i < 17; ++i) {
    scripts[i].quanta.push_back({});
    for (std::uint32_t j = 0; j < 17; ++j) {
      scripts[i].quanta.back().letters.push_back({j});
    }
  }
  const VirtualReport many = run_scripts(scripts).report;
  CHECK(many.links_used == 17 * 16);
  CHECK(many.busiest_links.size() == busiest_links_max);
}

}  // namespace
}  // namespace dmpc::tests::virtual_runner_test
