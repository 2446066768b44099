#include "nodes/machine.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace dmpc::tests::machine_test {

namespace {

/// Classes of operations, as a program names them.
enum class Class : std::uint8_t { first, second, third };

}  // namespace

using nodes::Charges;
using nodes::Machine;

TEST_CASE("a machine that is told nothing costs nothing") {
  const Machine machine;
  Charges done;
  done[Class::third] = 1000;
  CHECK(machine.price_ps({}, done) == 0);
  CHECK(machine.cost_of_message(1'000'000).byte_ps == 0);
  CHECK(machine.has_contention);
  CHECK_FALSE(machine.has_memory_port);
  CHECK(machine.switching == nodes::Switching::circuit);
  CHECK(machine.uplinks == 1);
}

TEST_CASE("a message up to the limit is short, and any longer one is long") {
  const Machine machine{.short_bytes_max = 100};
  CHECK(&machine.cost_of_message(0) == &machine.short_message);
  CHECK(&machine.cost_of_message(100) == &machine.short_message);
  CHECK(&machine.cost_of_message(101) == &machine.long_message);
}

TEST_CASE("every operation since the last look has its price, and none before") {
  Machine machine;
  Charges before, after;
  std::uint64_t expected_ps = 0;
  for (std::size_t i = 0; i < nodes::charge_count; ++i) {
    machine.cost_ps[i] = std::uint64_t{1} << (4 * i);
    before.count[i] = 100 + i;
    after.count[i] = before.count[i] + i % 3;
    expected_ps += (i % 3) << (4 * i);
  }
  CHECK(machine.price_ps(before, after) == expected_ps);
  CHECK(machine.price_ps(after, after) == 0);
}

TEST_CASE("an hour of operations is priced without overflow") {
  Machine machine;
  machine.cost_ps[static_cast<std::size_t>(Class::second)] = 1'000'000'000;  // a millisecond
  Charges done;
  done[Class::second] = 3'600'000;
  CHECK(machine.price_ps({}, done) == 3'600'000'000'000'000);
}

TEST_CASE("what has been done may cost more than 64 bits hold: the difference is priced right") {
  Machine machine;
  machine.cost_ps[static_cast<std::size_t>(Class::second)] = 1'000'000'000'000;
  Charges before, after;
  before[Class::second] = 18'446'744;
  after[Class::second] = 18'446'746;
  CHECK(machine.price_ps(after) < machine.price_ps(before));
  CHECK(machine.price_ps(before, after) == 2'000'000'000'000);
}

TEST_CASE("the digest of a machine is the same number on every computer") {
  CHECK(Machine().digest() == 0xac00cd8b7e3b214b);
  CHECK(Machine{.topology = nodes::TopologyKind::torus, .short_bytes_max = 64, .hop_ns = 1, .service_ns = 2}.digest() ==
        0xb53d9c0e676f04e5);
}

TEST_CASE("every figure and switch of a machine changes its digest, and its name does not") {
  std::vector<Machine> machines(1);
  const auto add = [&machines](const auto& change) {
    machines.emplace_back();
    change(machines.back());
  };
  add([](Machine& machine) { machine.topology = nodes::TopologyKind::mesh; });
  add([](Machine& machine) { ++machine.uplinks; });
  add([](Machine& machine) { machine.switching = nodes::Switching::packet; });
  add([](Machine& machine) { ++machine.short_bytes_max; });
  add([](Machine& machine) { ++machine.short_message.send_ns; });
  add([](Machine& machine) { ++machine.short_message.latency_ns; });
  add([](Machine& machine) { ++machine.short_message.receive_ns; });
  add([](Machine& machine) { ++machine.short_message.byte_ps; });
  add([](Machine& machine) { ++machine.long_message.send_ns; });
  add([](Machine& machine) { ++machine.long_message.latency_ns; });
  add([](Machine& machine) { ++machine.long_message.receive_ns; });
  add([](Machine& machine) { ++machine.long_message.byte_ps; });
  add([](Machine& machine) { ++machine.hop_ns; });
  add([](Machine& machine) { ++machine.service_ns; });
  for (std::size_t i = 0; i < nodes::charge_count; ++i) {
    add([i](Machine& machine) { ++machine.cost_ps[i]; });
  }
  add([](Machine& machine) { machine.has_contention = false; });
  add([](Machine& machine) { machine.has_memory_port = true; });
  std::set<std::uint64_t> digests;
  for (const Machine& machine : machines) {
    digests.insert(machine.digest());
  }
  CHECK(digests.size() == machines.size());
  CHECK(Machine{.name = "another"}.digest() == Machine().digest());
}

TEST_CASE("what was charged is summed class by class, and what is new is found") {
  Charges sum, before;
  sum[Class::third] = before[Class::third] = 5;
  sum += Charges{};
  CHECK(charged_between(before, sum) == 0);
  sum += {.count = {1, 0, 2}};
  CHECK(sum.count[0] == 1);
  CHECK(sum[Class::third] == 7);
  CHECK(charged_between(before, sum) == 0b101);
  before.count.back() = 1;
  CHECK(charged_between({}, before) == (0b100 | 1U << (nodes::charge_count - 1)));
}

}  // namespace dmpc::tests::machine_test
