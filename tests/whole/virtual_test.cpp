// Whole pictures in virtual time: the same film and the same counts as the reference renderer and the threads, and the same
// events again and again.
#include <doctest/doctest.h>

#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/trace/charge.h"
#include "dataflow/run.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_virtual_test {
namespace {

constexpr std::uint32_t virtual_node_counts[] = {1, 2, 5, 16};
constexpr nodes::TopologyKind topologies[] = {nodes::TopologyKind::hypercube, nodes::TopologyKind::torus,
                                              nodes::TopologyKind::fat_tree};

/// Slow messages, slower services: about what a machine of 1990 would be to a processor a hundred times as fast.
nodes::Machine slow_network(nodes::TopologyKind topology = nodes::TopologyKind::hypercube) {
  nodes::Machine machine{.name = "slow", .topology = topology};
  machine.short_message = {.send_ns = 160'000, .latency_ns = 50'000, .receive_ns = 160'000, .byte_ps = 200'000};
  machine.long_message = {.send_ns = 160'000, .latency_ns = 430'000, .receive_ns = 160'000, .byte_ps = 353'000};
  machine.hop_ns = 10'000;
  machine.service_ns = 200'000;
  for (std::size_t i = 0; i < machine.cost_ps.size(); ++i) {
    machine.cost_ps[i] = 1'000'000 + 100'001 * i;
  }
  return machine;
}

/// The film and all counts are the reference renderer's, and every node's time is accounted for.
template <class Report>
void check(const Subject& subject, const Report& report) {
  CHECK(outcome_of(report) == subject.outcome());
  REQUIRE(report.virtual_time);
  CHECK(report.virtual_time->nodes.size() == report.nodes.size() + 1);
  for (const nodes::VirtualTimes& times : report.virtual_time->nodes) {
    CHECK(times.total_ns() == report.virtual_time->total_ns);
  }
}

/// What requests for pages took of all processors, while they computed or waited.
std::uint64_t interrupted_ns_of(const svm::Report& report) {
  std::uint64_t sum_ns = 0;
  for (const nodes::VirtualTimes& times : report.virtual_time->nodes) {
    sum_ns += times.service_busy_ns + times.service_idle_ns;
  }
  return sum_ns;
}

/// Both of a run's hashes.
template <class Report>
std::vector<std::uint64_t> hashes(const Report& report) {
  return {report.virtual_time->run_hash(report.film.hash()), report.virtual_time->hash, report.virtual_time->events,
          report.virtual_time->total_ns, report.film.hash()};
}

/// What each of two threads gets when both call at one time.
template <class Function>
std::vector<std::vector<std::uint64_t>> side_by_side(const Function& function) {
  std::vector<std::vector<std::uint64_t>> results(2);
  {
    const std::jthread one([&] { results[0] = function(); }), other([&] { results[1] = function(); });
  }
  return results;
}

}  // namespace

TEST_CASE("virtual time: svm, replicated and dataflow give the reference's picture on any nodes and topology") {
  for (const core::Scene& scene : {mirrors_and_glass(), built_in("gears-1")}) {
    const Subject subject(scene, {20, 16}, {.page_size_bytes = 512});
    for (const std::uint32_t nodes : virtual_node_counts) {
      for (const nodes::TopologyKind topology : topologies) {
        CAPTURE(scene.name);
        CAPTURE(nodes);
        CAPTURE(name_of(topology));
        check(subject, run_svm(subject, {.computer = {.node_count = nodes, .machine = slow_network(topology)},
                                         .pages = {.cache_pages = 3}}));
        check(subject, run_replicated(subject, {.computer = {.node_count = nodes, .machine = slow_network(topology)}}));
        check(subject, run_dataflow(subject, {.computer = {.node_count = nodes, .machine = slow_network(topology)},
                                              .rays = {.topology = topology}}));
      }
    }
  }
}

TEST_CASE("virtual time: forest gives the reference's picture on any nodes and topology, and equal runs have equal events") {
  const Subject subject(mirrors_and_glass(), {20, 16}, {.page_size_bytes = 512, .structure = core::Structure::extents});
  for (const std::uint32_t nodes : virtual_node_counts) {
    for (const nodes::TopologyKind topology : topologies) {
      for (const std::uint32_t in_flight : {1U, 16U}) {
        CAPTURE(nodes);
        CAPTURE(name_of(topology));
        const svm::RunOptions options{.computer = {.node_count = nodes, .machine = slow_network(topology)},
                                      .pages = {.in_flight = in_flight}};
        const svm::Report report = run_forest(subject, options);
        check(subject, report);
        CHECK(hashes(report) == hashes(run_forest(subject, options)));
      }
    }
  }
}

TEST_CASE("virtual time: a refined picture is the same, and equal runs have equal events") {
  const Subject subject(mirrors_and_glass(), {.width = 16, .height = 16, .samples = 2, .refinement = {.error = 0.004}});
  const auto svm = [&] {
    return run_svm(subject, {.computer = {.node_count = 5, .machine = slow_network()}, .pages = {.cache_pages = 2}});
  };
  const auto dataflow = [&] { return run_dataflow(subject, {.computer = {.node_count = 5, .machine = slow_network()}}); };
  check(subject, svm());
  check(subject, dataflow());
  CHECK(svm().refinement.passes > 2);
  CHECK(hashes(svm()) == hashes(svm()));
  CHECK(hashes(dataflow()) == hashes(dataflow()));
}

TEST_CASE("virtual time: starved runs give the same picture") {
  const Subject subject(mirrors_and_glass(), {16, 16}, {.page_size_bytes = 512});
  for (const std::uint32_t nodes : virtual_node_counts) {
    CAPTURE(nodes);
    check(subject, run_svm(subject, {.computer = {.node_count = nodes, .machine = slow_network()},
                                     .pages = {.cache_pages = 1, .in_flight = 1}}));
    check(subject, run_svm(subject, {.computer = {.node_count = nodes, .machine = nodes::Machine{}},
                                     .pages = {.cache_pages = 1, .in_flight = 64}}));
    for (const std::uint32_t credits : {0U, 1U}) {
      const dataflow::RunOptions least{.computer = {.node_count = nodes, .machine = slow_network(nodes::TopologyKind::mesh)},
                                       .rays = {.ray_batch = 1, .ray_credits = credits, .queue_packets = 0}};
      check(subject, run_dataflow(subject, least));
    }
  }
}

TEST_CASE("virtual time: equal runs have equal events and films, one after the other and side by side") {
  const Subject subject(mirrors_and_glass(), {16, 16}, {.page_size_bytes = 512});
  const auto svm = [&] {
    return hashes(run_svm(subject, {.computer = {.node_count = 16, .machine = slow_network()}, .pages = {.cache_pages = 2}}));
  };
  const auto dataflow = [&] {
    return hashes(run_dataflow(subject, {.computer = {.node_count = 16, .machine = slow_network()}}));
  };
  CHECK(svm() == svm());
  CHECK(side_by_side(svm) == std::vector{svm(), svm()});
  CHECK(dataflow() == dataflow());
  CHECK(side_by_side(dataflow) == std::vector{dataflow(), dataflow()});
}

/// These numbers change with whatever changes the picture, the layout of records or what is charged for them, and with nothing
/// else.
TEST_CASE("virtual time: a fixed picture has one run hash for each strategy, on every computer and in every build type") {
  const Subject subject(mirrors_and_glass(), {16, 16}, {.page_size_bytes = 512});
  const auto run_hash = [](const auto& report) { return report.virtual_time->run_hash(report.film.hash()); };
  CHECK(run_hash(run_svm(subject, {.computer = {.node_count = 5, .machine = slow_network()}, .pages = {.cache_pages = 2}})) ==
        0x8318c07edb4b375f);
  CHECK(run_hash(run_replicated(subject, {.computer = {.node_count = 5, .machine = slow_network()}})) == 0x3b503fb7fb06ca91);
  CHECK(run_hash(run_dataflow(subject, {.computer = {.node_count = 5, .machine = slow_network()}})) == 0xab7c24d8fa1f2573);
}

TEST_CASE("virtual time: only homes are interrupted, by as many requests as there are faults") {
  const Subject subject(built_in("teapot-4"), {24, 24}, {.page_size_bytes = 512});
  const nodes::Machine machine = slow_network();
  const svm::Report report = run_svm(subject, {.computer = {.node_count = 8, .machine = machine}, .pages = {.cache_pages = 4}});
  const std::uint64_t service_busy_ns = interrupted_ns_of(report);
  const std::uint64_t service_ns = machine.short_message.receive_ns + machine.service_ns + machine.long_message.send_ns;
  CHECK(service_busy_ns == report.pages().faults * service_ns);
  CHECK(report.virtual_time->nodes.back().service_busy_ns + report.virtual_time->nodes.back().service_idle_ns == 0);
}

TEST_CASE("virtual time: where the host is home it alone is interrupted, and a page costs it what it would cost a node") {
  const Subject subject(built_in("teapot-4"), {24, 24}, {.page_size_bytes = 512});
  const nodes::Machine machine = slow_network();
  for (const std::uint32_t node_count : {1U, 8U}) {
    const svm::Report report = run_svm(subject, {.computer = {.node_count = node_count, .machine = machine},
                                                 .pages = {.cache_pages = 4, .homes = svm::PageHomes::host}});
    CHECK(outcome_of(report) == subject.outcome());
    const std::uint64_t service_ns = machine.short_message.receive_ns + machine.service_ns + machine.long_message.send_ns;
    const std::uint64_t interrupted_ns = interrupted_ns_of(report);
    const nodes::VirtualTimes& host = report.virtual_time->nodes.back();
    CHECK(report.pages().faults > 100);
    CHECK(interrupted_ns == report.pages().faults * service_ns);
    CHECK(host.service_busy_ns + host.service_idle_ns == interrupted_ns);
  }
}

TEST_CASE(
    "virtual time: to pass a request on costs a node of the tree its reception, the service and the message to its parent") {
  const Subject subject(built_in("teapot-4"), {24, 24}, {.page_size_bytes = 512});
  const nodes::Machine machine = slow_network();
  const svm::Report report = run_svm(
      subject, {.computer = {.node_count = 8, .machine = machine}, .pages = {.cache_pages = 4, .homes = svm::PageHomes::tree}});
  CHECK(outcome_of(report) == subject.outcome());
  const std::uint64_t passed = report.sent()[svm::number_of(svm::Kind::passed_request)].packets;
  const std::uint64_t taken_ns = machine.short_message.receive_ns + machine.service_ns;
  const std::uint64_t interrupted_ns = interrupted_ns_of(report);
  CHECK(passed > 100);
  CHECK(interrupted_ns ==
        report.pages().faults * (taken_ns + machine.long_message.send_ns) + passed * (taken_ns + machine.short_message.send_ns));
}

TEST_CASE("virtual time: one node alone computes what its operations cost") {
  const Subject subject(mirrors_and_glass(), {16, 16});
  const nodes::Machine machine = slow_network();
  const svm::Report report = run_svm(subject, {.computer = {.node_count = 1, .machine = machine}});
  nodes::Charges charges{core::charges_of(report.operations())};
  charges[core::Charge::home_lookup] = report.pages().home_hits;
  CHECK(report.virtual_time->nodes[0].computing_ns == machine.price_ps({}, charges) / 1000);
}

TEST_CASE("virtual time: a run that is stopped on the way says so and has no time to report") {
  const Subject subject(built_in("teapot-4"), {64, 64});
  std::stop_source source;
  svm::RunOptions options{.computer = {.node_count = 4, .machine = slow_network()}};
  options.watching.progress = [&](std::uint32_t, std::uint32_t) { source.request_stop(); };
  const svm::Report report = svm::run_svm(subject.database(), subject.settings(), options, source.get_token());
  CHECK(report.end == nodes::RunEnd::interrupted);
  CHECK_FALSE(report.virtual_time);
}

}  // namespace dmpc::tests::whole_virtual_test
