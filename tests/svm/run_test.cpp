#include "svm/run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <stop_token>

#include "core/picture/heat_kind.h"
#include "svm/pages/observers/miss_curve.h"
#include "svm/pages/observers/optimum.h"
#include "tests/support/built_scene.h"
#include "tests/support/priced_machine.h"

namespace svm_run_test {

using namespace dmpc;
using tests::BuiltScene;

namespace {

/// Nothing in the order of references depends on the cache.
svm::RunOptions fixed_order(std::uint32_t node_count) {
  svm::RunOptions options;
  options.computer.node_count = node_count;
  options.pages.work_item_side = 0;
  options.pages.in_flight = 1;
  return options;
}

svm::Report recorded_run(const BuiltScene& small, std::uint32_t node_count) {
  svm::RunOptions options = fixed_order(node_count);
  options.pages.record_references = true;
  return svm::run_svm(small.database, small.settings, options, {});
}

}  // namespace

TEST_CASE("a host that assigns the work gives every item, and no node another, on threads and on a modelled machine") {
  const BuiltScene small("teapot-4", 1024, 30);
  const std::uint64_t film = svm::run_svm(small.database, small.settings, {}, {}).film.hash();
  for (const bool is_modelled : {false, true}) {
    svm::RunOptions options{.computer = {.node_count = 4},
                            .pages = {.in_flight = 1, .work_item_side = 3, .work_donor = svm::WorkDonor::host}};
    options.computer.machine = is_modelled ? std::optional(nodes::Machine{}) : std::nullopt;
    const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
    CHECK(report.film.hash() == film);
    CHECK(report.items_assigned == 100);
    CHECK(report.work().items_given == 0);
    CHECK(report.work().items_taken == 100);
    CHECK(report.work().items_asked == 104);
  }
}

TEST_CASE("where the host is home it serves every fault, and nodes find nothing at home") {
  const BuiltScene small("teapot-4", 512, 30);
  const std::uint64_t film = svm::run_svm(small.database, small.settings, {}, {}).film.hash();
  for (const std::uint32_t nodes : {1U, 2U, 5U, 8U}) {
    for (const svm::Replacement replacement : {svm::Replacement::lru, svm::Replacement::fifo}) {
      const svm::RunOptions options{.computer = {.node_count = nodes},
                                    .pages = {.cache_pages = 5, .homes = svm::PageHomes::host, .replacement = replacement}};
      const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
      CHECK(report.film.hash() == film);
      CHECK(report.pages().home_hits == 0);
      CHECK(report.pages().served == 0);
      CHECK(report.pages().faults > 50);
      CHECK(report.host_pages_served == report.pages().faults);
      for (const svm::NodeReport& node : report.nodes) {
        CHECK(node.memory_used.bytes == node.memory_planned.bytes);
      }
    }
  }
}

TEST_CASE(
    "in a tree somebody above serves every fault, and where there are no more nodes than the host's children it is the host") {
  const BuiltScene small("teapot-4", 512, 30);
  const std::uint64_t film = svm::run_svm(small.database, small.settings, {}, {}).film.hash();
  for (const std::uint32_t nodes : {1U, 2U, svm::tree_arity, 5U, 16U}) {
    const svm::RunOptions options{.computer = {.node_count = nodes}, .pages = {.cache_pages = 5, .homes = svm::PageHomes::tree}};
    const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
    CAPTURE(nodes);
    CHECK(report.film.hash() == film);
    CHECK(report.pages().home_hits == 0);
    CHECK(report.pages().faults > 50);
    CHECK(report.pages().served + report.host_pages_served == report.pages().faults);
    CHECK((report.pages().served == 0) == (nodes <= svm::tree_arity));
    for (const svm::NodeReport& node : report.nodes) {
      CHECK(node.memory_used.bytes == node.memory_planned.bytes);
    }
  }
}

TEST_CASE("a star is what a tree of the host and its children is, to the nanosecond") {
  const BuiltScene small("teapot-4", 512, 24);
  const auto run_hash = [&](std::uint32_t nodes, svm::PageHomes homes) {
    const svm::RunOptions options{.computer = {.node_count = nodes, .machine = nodes::Machine{}},
                                  .pages = {.cache_pages = 5, .homes = homes}};
    return svm::run_svm(small.database, small.settings, options, {}).virtual_time->hash;
  };
  CHECK(run_hash(svm::tree_arity, svm::PageHomes::tree) == run_hash(svm::tree_arity, svm::PageHomes::host));
  CHECK(run_hash(7, svm::PageHomes::tree) != run_hash(7, svm::PageHomes::host));
}

TEST_CASE("resident pages are found as those at home are, and at most one a node is fetched where they are all others") {
  const BuiltScene small("teapot-4", 512, 40);
  const std::uint64_t film = svm::run_svm(small.database, small.settings, {}, {}).film.hash();
  const auto pages = static_cast<std::uint32_t>(small.database.page_count());
  for (const svm::PageHomes homes : {svm::PageHomes::spread, svm::PageHomes::host, svm::PageHomes::tree}) {
    CAPTURE(name_of(homes));
    svm::RunOptions options = fixed_order(4);
    options.pages.homes = homes;
    options.pages.replacement = svm::Replacement::fifo;
    options.pages.cache_pages = pages / 4;
    const svm::Report without = svm::run_svm(small.database, small.settings, options, {});
    options.pages.resident_percent = 50;
    const svm::Report with = svm::run_svm(small.database, small.settings, options, {});
    CHECK(without.film.hash() == film);
    CHECK(with.film.hash() == film);
    CHECK(with.pages().home_hits > without.pages().home_hits);
    CHECK(with.pages().faults != without.pages().faults);
    options.pages.cache_pages = pages;
    options.pages.resident_percent = 100;
    const svm::Report all = svm::run_svm(small.database, small.settings, options, {});
    CHECK(all.film.hash() == film);
    CHECK((homes == svm::PageHomes::spread || all.pages().faults <= 4));
    for (const svm::NodeReport& node : all.nodes) {
      CHECK(node.memory_used.bytes == node.memory_planned.bytes);
    }
  }
}

TEST_CASE("with the same frames, references in a fixed order fault at the host as often as stack distances say") {
  const BuiltScene small("teapot-4", 512, 24);
  svm::RunOptions options = fixed_order(3);
  options.pages.homes = svm::PageHomes::host;
  options.pages.record_references = true;
  const svm::Report recorded = svm::run_svm(small.database, small.settings, options, {});
  options.pages.record_references = false;
  options.pages.cache_pages = 6;
  const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
  for (std::size_t node = 0; node < 3; ++node) {
    const svm::MissCurve curve(recorded.nodes[node].references.pages());
    CHECK(report.nodes[node].program.pages.faults == curve.misses(6));
  }
}

TEST_CASE("one worker renders all of a picture from the memories of all nodes, which serve its pages") {
  const BuiltScene small("rings-2", 512, 24);
  core::Operations reference;
  const std::uint64_t hash = small.reference(reference).hash();
  svm::RunOptions options;
  options.computer.node_count = 5;
  options.pages.worker_count = 1;
  options.pages.cache_pages = 3;
  const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
  CHECK(report.film.hash() == hash);
  CHECK(report.nodes[0].program.work.pixels_rendered == 24 * 24);
  CHECK(report.nodes[0].program.work.items_asked == 0);
  CHECK(report.nodes[0].program.pages.faults > 0);
  for (std::size_t node = 1; node < 5; ++node) {
    CHECK(report.nodes[node].program.work.pixels_rendered == 0);
    CHECK(report.nodes[node].counters.sent[svm::number_of(svm::Kind::page_reply)].packets > 0);
  }
}

TEST_CASE("svm and replicated give the reference renderer's film and its counts of rays") {
  const BuiltScene small("rings-2", 512, 24);
  core::Operations reference;
  const std::uint64_t hash = small.reference(reference).hash();
  for (const std::uint32_t nodes : {1U, 3U, 8U}) {
    svm::RunOptions options;
    options.computer.node_count = nodes;
    const svm::Report replicated = svm::run_replicated(small.database, small.settings, options, {});
    options.pages.cache_pages = 1;
    const svm::Report paged = svm::run_svm(small.database, small.settings, options, {});
    CHECK(replicated.film.hash() == hash);
    CHECK(paged.film.hash() == hash);
    CHECK(replicated.operations().rays == reference.rays);
    CHECK(paged.operations().rays == reference.rays);
    CHECK(paged.operations().cell_steps == reference.cell_steps);
  }
}

TEST_CASE("a node uses exactly the memory of its plan, category by category, with real tasks") {
  const BuiltScene small("balls-2", 1024, 8);
  svm::RunOptions options;
  options.computer.node_count = 3;
  for (const bool count_pages : {false, true}) {
    options.pages.count_pages = count_pages;
    for (const svm::NodeReport& node : svm::run_svm(small.database, small.settings, options, {}).nodes) {
      CHECK(node.memory_used.bytes == node.memory_planned.bytes);
    }
  }
  for (const svm::NodeReport& node : svm::run_replicated(small.database, small.settings, {}, {}).nodes) {
    CHECK(node.memory_used.bytes == node.memory_planned.bytes);
  }
}

TEST_CASE("the smallest memory that is named renders the picture") {
  const BuiltScene small("tetra-4", 512, 16);
  svm::RunOptions options;
  options.computer.node_count = 5;
  core::Operations operations;
  const svm::Plan plan = svm::plan_of(*svm::svm_strategy(), small.database, small.settings, options);
  options.computer.node_memory_bytes = svm::smallest_node_memory_bytes(plan.request);
  const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
  CHECK(report.film.hash() == small.reference(operations).hash());
  CHECK(report.plan.frames == 1);
  CHECK(report.plan.in_flight == 1);
  *options.computer.node_memory_bytes -= 1;
  CHECK_THROWS_AS(svm::run_svm(small.database, small.settings, options, {}), core::InputError);
}

TEST_CASE("a tracer of one's own may stand in for the grid in replicated") {
  const BuiltScene small("balls-2", 1024, 12);
  struct OtherTracer {
    core::LocalRecords records;
    core::DatabaseHeader header;
    core::Traced trace(const core::Ray& ray, core::Cursor& cursor, core::Operations& operations) {
      return core::trace(ray, cursor, records, header, {}, operations);
    }
    const std::byte* find(core::Address address) { return records.find(address); }
  };
  svm::RunOptions options;
  options.computer.node_count = 2;
  const auto make_tracer = [&](std::uint32_t index, std::span<const std::byte> copy) {
    CHECK(index < 2);
    CHECK(copy.size() == small.database.bytes().size());
    CHECK(copy.data() != small.database.bytes().data());
    return OtherTracer{core::LocalRecords(copy), small.settings.header};
  };
  options.tracer_is_own = true;
  core::Operations operations;
  const svm::Report report = svm::run_replicated(small.database, small.settings, options, {}, make_tracer);
  CHECK(report.film.hash() == small.reference(operations).hash());
}

TEST_CASE("one node counts on a pool what it counts on a thread of its own, and has as much memory") {
  const BuiltScene small("rings-2", 512, 24);
  const svm::Report threads = svm::run_svm(small.database, small.settings, {.computer = {.node_count = 1}}, {});
  const svm::Report pool = svm::run_svm(small.database, small.settings, {.computer = {.node_count = 1, .pool_threads = 1}}, {});
  CHECK(pool.film.hash() == threads.film.hash());
  CHECK(nodes::total(pool.sent()).packets == nodes::total(threads.sent()).packets);
  CHECK(pool.nodes[0].memory_used.bytes == threads.nodes[0].memory_used.bytes);
}

TEST_CASE("a run that is stopped on the way says so and has not every pixel") {
  const BuiltScene small("balls-3", 1024, 64);
  std::stop_source source;
  // On one thread the host has its turns among the nodes': it asks in time on a busy machine, too.
  svm::RunOptions options{.computer = {.node_count = 2, .pool_threads = 1}};
  options.watching.progress = [&](std::uint32_t, std::uint32_t) { source.request_stop(); };
  const svm::Report report = svm::run_svm(small.database, small.settings, options, source.get_token());
  CHECK(report.end == nodes::RunEnd::interrupted);
  CHECK(report.work().pixels_rendered < 64 * 64);
}

TEST_CASE("recording changes neither film nor counters, and does not depend on the cache") {
  const BuiltScene small("balls-2", 512, 24);
  const svm::Report recorded = recorded_run(small, 3);
  svm::RunOptions options = fixed_order(3);
  const svm::Report plain = svm::run_svm(small.database, small.settings, options, {});
  CHECK(recorded.film.hash() == plain.film.hash());
  CHECK(recorded.pages().references == plain.pages().references);
  CHECK(recorded.pages().faults == plain.pages().faults);
  CHECK(plain.nodes[0].references.pages().empty());
  options.pages.record_references = true;
  options.pages.cache_pages = 2;
  options.pages.replacement = svm::Replacement::random;
  const svm::Report starved = svm::run_svm(small.database, small.settings, options, {});
  for (std::size_t i = 0; i < starved.nodes.size(); ++i) {
    const auto one = recorded.nodes[i].references.pages(), other = starved.nodes[i].references.pages();
    CHECK(std::equal(one.begin(), one.end(), other.begin(), other.end()));
  }
}

TEST_CASE("one node has every page at home and records nothing") {
  CHECK(recorded_run(BuiltScene("balls-2", 1024, 8), 1).nodes[0].references.pages().empty());
}

TEST_CASE("under every replacement policy the film is the same and no node misses less than the optimum") {
  const BuiltScene small("rings-2", 512, 24);
  const svm::Report recorded = recorded_run(small, 4);
  for (std::size_t policy = 0; policy < svm::policy_kinds().size(); ++policy) {
    const auto replacement = static_cast<svm::Replacement>(policy);
    CAPTURE(svm::name_of(replacement));
    svm::RunOptions options = fixed_order(4);
    options.pages.cache_pages = 8;
    options.pages.replacement = replacement;
    const svm::Report report = svm::run_svm(small.database, small.settings, options, {});
    CHECK(report.film.hash() == recorded.film.hash());
    for (std::size_t i = 0; i < report.nodes.size(); ++i) {
      const svm::Optimum optimum(recorded.nodes[i].references.pages());
      CHECK(optimum.misses(8) <= report.nodes[i].program.pages.faults);
      CHECK(report.nodes[i].memory_used.bytes == report.nodes[i].memory_planned.bytes);
    }
  }
}

TEST_CASE("the host may forget the database once it is distributed, and the film is the same") {
  core::Operations reference;
  const std::uint64_t hash = BuiltScene("rings-2", 512, 24).reference(reference).hash();
  for (const svm::Strategy* const strategy : {svm::svm_strategy(), svm::replicated_strategy()}) {
    BuiltScene small("rings-2", 512, 24);
    int times = 0;
    svm::RunOptions options;
    options.watching.distributed = [&] {
      ++times;
      small.database.forget_records();
      small.database.forget_primitives();
    };
    const svm::Report report = strategy == svm::svm_strategy() ? svm::run_svm(small.database, small.settings, options, {})
                                                               : svm::run_replicated(small.database, small.settings, options, {});
    CHECK(report.film.hash() == hash);
    CHECK(times == 1);
  }
  BuiltScene small("rings-2", 512, 24);
  svm::RunOptions options{.pages = {.homes = svm::PageHomes::host}};
  options.watching.distributed = [&] { small.database.forget_records(); };
  CHECK(svm::run_svm(small.database, small.settings, options, {}).film.hash() == hash);
}

TEST_CASE("nobody is told to forget the database where modelled nodes, or a pool's, refer to it") {
  const nodes::ComputerRequest modelled{.node_count = 3, .machine = nodes::Machine{}}, pool{.node_count = 3, .pool_threads = 2};
  for (const svm::Strategy* const strategy : {svm::svm_strategy(), svm::replicated_strategy()}) {
    for (const nodes::ComputerRequest& computer : {modelled, pool}) {
      const BuiltScene small("rings-2", 512, 8);
      svm::RunOptions options{.computer = computer};
      options.watching.distributed = [] { FAIL("the nodes have no copies"); };
      const svm::Report report = svm::run_by(*strategy, small.database, small.settings, options, {});
      for (const svm::NodeReport& node : report.nodes) {
        CHECK(node.memory_used.bytes == node.memory_planned.bytes);
      }
    }
  }
}

/// What a run counts if nothing depends on its schedule.
struct Counted {
  explicit Counted(const svm::Report& report) : film(report.film.hash()) {
    for (const svm::NodeReport& node : report.nodes) {
      const svm::PageCounters& of = node.program.pages;
      pages.push_back({of.references, of.home_hits, of.cache_hits, of.misses, of.faults, of.evictions, of.served});
      memory.push_back(node.memory_used.bytes);
      for (const nodes::TrafficByKind* const traffic : {&node.counters.sent, &node.counters.received}) {
        for (const nodes::Traffic& kind : *traffic) {
          packets.push_back({kind.packets, kind.bytes});
        }
      }
    }
  }
  bool operator==(const Counted&) const = default;

  std::uint64_t film;
  std::vector<std::array<std::uint64_t, 7>> pages;
  std::vector<std::array<std::uint64_t, 2>> packets;
  std::vector<std::array<std::size_t, nodes::category_count>> memory;
};

TEST_CASE("nodes of a pool, which refer to pages, count what nodes with copies count: references, faults, bytes, memory") {
  const BuiltScene small("rings-2", 512, 24);
  for (const svm::PageHomes homes : {svm::PageHomes::spread, svm::PageHomes::host}) {
    svm::RunOptions options = fixed_order(5);
    options.pages.cache_pages = 8;
    options.pages.homes = homes;
    const Counted copying(svm::run_svm(small.database, small.settings, options, {}));
    for (const std::uint32_t threads : {1U, 3U}) {
      options.computer.pool_threads = threads;
      CHECK(Counted(svm::run_svm(small.database, small.settings, options, {})) == copying);
    }
    options.computer.chaos = nodes::chaos_of(3);
    CHECK(Counted(svm::run_svm(small.database, small.settings, options, {})).pages == copying.pages);
  }
}

TEST_CASE(
    "who walks in a bundle does not depend on who renders it, and what is looked up and avoided is what single rays look up") {
  const BuiltScene small("teapot-4", 1024, 30);
  const auto run = [&](const svm::RunOptions& options, bool bundles) {
    core::RenderSettings settings = small.settings;
    settings.skips.bundles = bundles;
    return svm::run_svm(small.database, settings, options, {});
  };
  const svm::Report one = run({.computer = {.node_count = 1}}, true);
  const core::Operations expected = one.operations();
  CHECK(expected.bundles > 0);
  CHECK(expected.rays_in_bundles > expected.bundles);
  for (const std::uint32_t nodes : {2U, 5U}) {
    const svm::Report many = run({.computer = {.node_count = nodes}, .pages = {.cache_pages = 3, .in_flight = 32}}, true);
    CHECK(many.film.hash() == one.film.hash());
    // Submaps cut items, so that bundles are others, except for one node.
    CHECK(many.operations().rays == expected.rays);
  }
  const svm::Report again = run({.computer = {.node_count = 1}, .pages = {.in_flight = 16}}, true);
  CHECK(again.pages().references == one.pages().references);
  CHECK(again.operations().skipped.bundles == expected.skipped.bundles);
  CHECK(again.operations().bvh_node_reads == expected.bvh_node_reads);

  const svm::Report alone = run({.computer = {.node_count = 1}}, false);
  CHECK(alone.film.hash() == one.film.hash());
  CHECK(alone.operations().bundles == 0);
  const auto by_rays = static_cast<double>(one.pages().references + expected.skipped.bundles);
  CHECK(by_rays == doctest::Approx(static_cast<double>(alone.pages().references)).epsilon(0.02));
  CHECK(one.pages().references * 3 < alone.pages().references);
}

TEST_CASE("nodes of a modelled machine trace bundles if they are asked to: the same light, fewer look-ups, each time alike") {
  const BuiltScene small("teapot-4", 512, 40);
  const auto run = [&](bool bundles, std::uint32_t nodes) {
    return svm::run_svm(small.database, small.settings,
                        {.computer = {.node_count = nodes, .machine = tests::priced_machine()},
                         .pages = {.cache_pages = 8, .in_flight = 16, .bundles_on_machines = bundles}},
                        {});
  };
  const svm::Report on_threads = svm::run_svm(small.database, small.settings, {.computer = {.node_count = 4}}, {});
  for (const std::uint32_t nodes : {1U, 4U}) {
    const svm::Report alone = run(false, nodes), together = run(true, nodes), again = run(true, nodes);
    CHECK(together.film.hash() == on_threads.film.hash());
    CHECK(together.operations().rays == alone.operations().rays);
    CHECK(together.operations().rays_in_bundles > together.operations().bundles);
    CHECK(alone.operations().bundles == 0);
    CHECK(together.pages().references < alone.pages().references);
    CHECK(together.virtual_time->events < alone.virtual_time->events);
    CHECK(together.virtual_time->hash == again.virtual_time->hash);
  }
}

TEST_CASE("bundles are refused where they could not be traced") {
  const BuiltScene small("teapot-4", 1024, 30);
  const svm::RunOptions right{.computer = {.node_count = 2, .machine = nodes::Machine{}}, .pages = {.bundles_on_machines = true}};
  CHECK(svm::plan_of(*svm::svm_strategy(), small.database, small.settings, right).pixels_a_task == 16);
  std::array<svm::RunOptions, 4> wrong;
  wrong.fill(right);
  wrong[0].computer.machine.reset();
  wrong[1].pages.in_flight = 15;
  wrong[2].pages.count_pages = true;
  constexpr std::array kinds{core::HeatKind::references};
  nodes::HeatMap heat(900, kinds);
  wrong[3].watching.heat = &heat;
  for (const svm::RunOptions& options : wrong) {
    CHECK_THROWS_AS(svm::plan_of(*svm::svm_strategy(), small.database, small.settings, options), core::UsageError);
  }
  CHECK_THROWS_AS(svm::plan_of(*svm::replicated_strategy(), small.database, small.settings, right), core::UsageError);
  const BuiltScene tiny("teapot-4", 1024, 3);
  CHECK_THROWS_AS(svm::plan_of(*svm::svm_strategy(), tiny.database, tiny.settings, right), core::UsageError);
  core::RenderSettings without = small.settings;
  without.skips.bundles = false;
  CHECK_THROWS_AS(svm::plan_of(*svm::svm_strategy(), small.database, without, right), core::UsageError);
}

TEST_CASE("heat maps, references, distinct pages and, unless asked, modelled machines have rays that walk alone") {
  const BuiltScene small("tetra-3", 1024, 16);
  const auto bundles = [&](const svm::RunOptions& options) {
    const svm::Plan plan = svm::plan_of(*svm::svm_strategy(), small.database, small.settings, options);
    return plan.pixels_a_task;
  };
  CHECK(bundles({.computer = {.node_count = 2}}) == 16);
  CHECK(bundles({.computer = {.node_count = 2}, .pages = {.in_flight = 15}}) == 1);
  CHECK(bundles({.computer = {.node_count = 2}, .pages = {.count_pages = true}}) == 1);
  CHECK(bundles({.computer = {.node_count = 2, .machine = nodes::Machine{}}, .pages = {.in_flight = 64}}) == 1);
  constexpr std::array kinds{core::HeatKind::references};
  nodes::HeatMap heat(256, kinds);
  CHECK(bundles({.computer = {.node_count = 2}, .watching = {.heat = &heat}}) == 1);
}

}  // namespace svm_run_test
