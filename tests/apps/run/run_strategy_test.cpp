#include "apps/run/run_strategy.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/frontend/machine/machine_file.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::run_strategy_test {

using core::operator""_KiB;

namespace {

std::uint64_t film_hash(const RenderOptions& options) { return account_of(*Rendered(options).report).film.hash(); }

}  // namespace

TEST_CASE("every strategy renders the same film") {
  const std::uint64_t hash = film_hash(small(Strategy::svm));
  for (const Strategy strategy : {Strategy::replicated, Strategy::dataflow}) {
    CHECK(film_hash(small(strategy)) == hash);
  }
}

TEST_CASE("every option of the computer reaches the run") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow}) {
    RenderOptions options = small(strategy);
    options.computer = {.node_count = 5, .node_memory_bytes = 900_KiB, .chaos = nodes::chaos_of(7)};
    const Rendered rendered(options);
    const Account account = account_of(*rendered.report);
    CHECK(account.nodes.size() == 5);
    CHECK(account.node_memory_max_bytes <= 900_KiB);
    CHECK(account.chaos.value().seed == 7);
    CHECK(account.film.hash() == film_hash(small(strategy)));
  }
}

TEST_CASE("every option of dataflow reaches the run") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays = {.balance = {.balance = dataflow::Balance::equal_size}, .ray_batch = 3, .ray_credits = 2, .queue_packets = 7};
  const Rendered rendered(options);
  const auto& report = std::get<dataflow::Report>(*rendered.report);
  CHECK(report.plan.ray_batch == 3);
  CHECK(report.plan.ray_credits == 2);
  CHECK(report.plan.queue_packets == 7);
  CHECK(report.predicted.empty());
}

TEST_CASE("regions are mapped onto the topology that was asked for") {
  const auto corners_on = [](nodes::TopologyKind topology) {
    RenderOptions options = small(Strategy::dataflow);
    options.computer.node_count = 8;
    options.rays.topology = topology;
    const Rendered rendered(options);
    std::vector<core::Corner> corners;
    for (const dataflow::NodeReport& node : std::get<dataflow::Report>(*rendered.report).nodes) {
      corners.push_back(node.region.low);
    }
    return corners;
  };
  CHECK(corners_on(nodes::TopologyKind::mesh) != corners_on(nodes::TopologyKind::hypercube));
}

TEST_CASE("a modelled machine renders the film of threads, with every strategy") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow}) {
    const Rendered rendered(modelled(strategy));
    const Account account = account_of(*rendered.report);
    CHECK(account.film.hash() == film_hash(small()));
    REQUIRE(account.virtual_time);
    CHECK(account.virtual_time->total_ns > 0);
  }
}

TEST_CASE("a modelled machine's nodes work on 16 pixels, or a bundle of them, whatever travels, unless told otherwise") {
  const auto in_flight = [](const RenderOptions& options) {
    const Rendered rendered(options);
    return std::get<svm::Report>(*rendered.report).plan.in_flight;
  };
  RenderOptions options = modelled();
  CHECK(in_flight(options) == 16);
  CHECK(in_flight(modelled(Strategy::forest)) == 16);
  CHECK(in_flight(modelled(Strategy::replicated)) == 1);
  CHECK(in_flight(small()) == 64);
  options.pages.bundles_on_machines = true;
  CHECK(in_flight(options) == 16);
  options.pages.bundles_on_machines = false;
  options.pages.in_flight = 5;
  CHECK(in_flight(options) == 5);
}

TEST_CASE("the machine asked for is read, and regions are mapped onto its topology") {
  const auto chosen = [](const RunnerOptions& runner) {
    StrategyOptions options{.runner = runner};
    choose_machine(options);
    return options;
  };
  CHECK_FALSE(chosen({}).computer.machine);
  RunnerOptions runner{.kind = RunnerKind::virtual_time};
  CHECK(chosen(runner).computer.machine.value().name == "ipsc2");
  runner.machine_name = "paragon";
  CHECK(chosen(runner).rays.topology == nodes::TopologyKind::mesh);
  CHECK(chosen(runner).computer.machine.value().has_contention);
  CHECK_FALSE(chosen(runner).computer.machine.value().has_memory_port);
  runner.machine_name = "abacus";
  CHECK_THROWS_AS(chosen(runner), core::InputError);
}

TEST_CASE("links that do not contend let no message wait") {
  nodes::Machine machine = find_machine_preset("ipsc2")->machine;
  const auto wait_ns = [&] {
    RenderOptions options = small();
    options.computer.node_count = 8;
    const Rendered rendered(on_machine(options, machine));
    return account_of(*rendered.report).virtual_time->links.wait_ns;
  };
  CHECK(wait_ns() > 0);
  machine.has_contention = false;
  CHECK(wait_ns() == 0);
}

TEST_CASE("dataflow's defaults are those that the help tells") {
  const Rendered rendered(small(Strategy::dataflow));
  const auto& plan = std::get<dataflow::Report>(*rendered.report).plan;
  CHECK(plan.ray_batch == dataflow::rays_in(4_KiB));
  CHECK(plan.ray_credits == 64 / plan.node_count());
  CHECK(plan.queue_packets == 256);
}

TEST_CASE("a memory that is too small is bad input, and one that is scarce is worth a note") {
  RenderOptions options = small(Strategy::dataflow);
  options.computer.node_memory_bytes = 304_KiB;
  CHECK_FALSE(Rendered(options).notes.empty());
  options.computer.node_memory_bytes = 1_KiB;
  CHECK_THROWS_AS(Rendered{options}, core::InputError);
}

TEST_CASE("a run that is stopped before it starts reports that it was interrupted") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow}) {
    std::stop_source source;
    source.request_stop();
    for (const RenderOptions& options : {small(strategy), modelled(strategy)}) {
      CHECK(account_of(*Rendered(options, source.get_token()).report).end == nodes::RunEnd::interrupted);
    }
  }
}

}  // namespace dmpc::apps::run_strategy_test
