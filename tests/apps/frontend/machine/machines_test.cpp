#include "apps/frontend/machine/machines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/trace/charge.h"
#include "core/trace/work.h"

namespace dmpc::apps::machines_test {

namespace {

using core::Charge;

const nodes::Machine& machine(std::string_view name) {
  const MachineDescription* const preset = find_machine_preset(name);
  REQUIRE(preset != nullptr);
  return preset->machine;
}

std::uint64_t cost_ps(std::string_view name, Charge charge) { return machine(name).cost_ps[static_cast<std::size_t>(charge)]; }

/// From the call of send to the return of a receive that was waiting, without bytes and links.
std::uint64_t alpha_ns(const nodes::MessageCost& cost) { return cost.send_ns + cost.latency_ns + cost.receive_ns; }

}  // namespace

TEST_CASE("there are eleven machines, found by their names and by no others") {
  CHECK(machine_preset_names() == "ipsc2, ipsc2-1994, ipsc860, paragon, cm5, cs2, myrinet, fdr, gigabit, hdr, ndr");
  REQUIRE(machine_presets().size() == 11);
  for (std::size_t i = 0; i < machine_names.size(); ++i) {
    CHECK(machine_presets()[i].machine.name == machine_names[i]);
    CHECK(machine(machine_names[i]).name == machine_names[i]);
    CHECK_FALSE(machine_presets()[i].title.empty());
  }
  for (const std::string name : {"", "ipsc", "IPSC2", "ipsc2 ", "ideal"}) {
    CHECK(find_machine_preset(name) == nullptr);
  }
}

TEST_CASE("every figure of every machine has a source and a certainty, or is told to be another one's") {
  for (const MachineDescription& preset : machine_presets()) {
    REQUIRE(preset.sources.size() == sourced_keys.size());
    for (std::size_t i = 0; i < sourced_keys.size(); ++i) {
      const auto& [key, source] = preset.sources[i];
      CAPTURE(preset.machine.name);
      CAPTURE(key);
      CHECK(key == sourced_keys[i]);
      const bool is_no_figure =
          source == "one class of messages" || source == "as a long message" || source == "no tree of switches";
      const bool is_certain_to_a_degree = source.find("high") != std::string::npos ||
                                          source.find("medium") != std::string::npos || source.find("low") != std::string::npos;
      CHECK((is_certain_to_a_degree || is_no_figure));
    }
  }
}

TEST_CASE("the price of a cached look-up is told to be fitted on the iPSC/2, and carried over everywhere else") {
  for (const MachineDescription& preset : machine_presets()) {
    CAPTURE(preset.machine.name);
    const auto source = std::find_if(preset.sources.begin(), preset.sources.end(), [](const auto& keyed) {
                          return keyed.first == "cached_lookup";
                        })->second;
    const bool is_fitted_here = source.find("fitted to") == 0;
    CHECK(is_fitted_here == (preset.machine.name.find("ipsc2") == 0));
    CHECK(is_fitted_here !=
          (source.find("carried over by the slowdown: not measured on this machine, low") != std::string::npos));
  }
}

TEST_CASE("a machine's name is told with what is special about its links") {
  nodes::Machine cm5 = machine("cm5");
  CHECK(name_with_links(cm5) == "cm5");
  cm5.has_memory_port = true;
  CHECK(name_with_links(cm5) == "cm5 with memory ports");
  cm5.has_contention = false;
  CHECK(name_with_links(cm5) == "cm5 without contention");
}

TEST_CASE("a message of the iPSC/2 takes what the 1994 paper and its handbooks say") {
  const nodes::Machine& ipsc2 = machine("ipsc2");
  CHECK(ipsc2.topology == nodes::TopologyKind::hypercube);
  CHECK(alpha_ns(ipsc2.cost_of_message(100)) == 370'000);
  CHECK(alpha_ns(ipsc2.cost_of_message(101)) == 750'000);
  const auto byte_us = 1e-6 * static_cast<double>(ipsc2.long_message.byte_ps);
  const auto alpha_us = 1e-3 * static_cast<double>(alpha_ns(ipsc2.long_message));
  CHECK(1024 / (alpha_us + 1024 * byte_us) == doctest::Approx(0.9).epsilon(0.05));  // MB a second in messages of 1 KB
  CHECK(1 / byte_us == doctest::Approx(2.8).epsilon(0.03));                         // and at most
}

TEST_CASE("the machines of 1988 to 1993 with routers of their own make circuits, trees of switches pass packets on") {
  for (const std::string name : {"ipsc2", "ipsc860", "paragon"}) {
    CHECK(machine(name).switching == nodes::Switching::circuit);
    CHECK(machine(name).uplinks == 1);
  }
  for (const std::string name : {"cm5", "cs2", "myrinet", "fdr", "gigabit", "hdr", "ndr"}) {
    CHECK(machine(name).switching == nodes::Switching::packet);
    CHECK(machine(name).topology == nodes::TopologyKind::fat_tree);
    CHECK(machine(name).uplinks == (name == "cm5" ? 2 : 4));
  }
}

TEST_CASE("an empty message to a neighbour takes what is published, its hops among it") {
  const auto neighbour_us = [](const nodes::Machine& of, std::uint64_t hops) {
    return 1e-3 * static_cast<double>(alpha_ns(of.short_message) + hops * of.hop_ns);
  };
  CHECK(neighbour_us(machine("ipsc860"), 1) >= 65);
  CHECK(neighbour_us(machine("ipsc860"), 1) <= 75);
  for (const std::string name : {"fdr", "hdr", "ndr"}) {
    CHECK(neighbour_us(machine(name), 2) >= 1.0);
    CHECK(neighbour_us(machine(name), 2) <= 1.3);
  }
  CHECK(neighbour_us(machine("myrinet"), 2) == doctest::Approx(3.2));
}

TEST_CASE("every machine takes time for messages and contends for links") {
  for (const MachineDescription& preset : machine_presets()) {
    CAPTURE(preset.machine.name);
    for (const std::uint64_t bytes : {8U, 2000U}) {
      const nodes::MessageCost& cost = preset.machine.cost_of_message(bytes);
      CHECK(cost.send_ns > 0);
      CHECK(cost.latency_ns > 0);
      CHECK(cost.receive_ns > 0);
      CHECK(cost.byte_ps > 0);
    }
    CHECK(preset.machine.hop_ns > 0);
    CHECK(preset.machine.has_contention);
    CHECK_FALSE(preset.machine.has_memory_port);
  }
}

TEST_CASE("operations keep their measured proportions on every machine") {
  for (const MachineDescription& preset : machine_presets()) {
    CAPTURE(preset.machine.name);
    const std::uint64_t slowdown = cost_ps(preset.machine.name, Charge::cell_step) / core::measured_prices.cell_step_ps;
    CHECK(slowdown > 0);
    CHECK((preset.machine.cost_ps == operation_costs_ps(slowdown)) == (preset.machine.name != "ipsc2-1994"));
  }
  CHECK(cost_ps("hdr", Charge::shading) == core::measured_prices.shading_ps);
  CHECK(cost_ps("ipsc2", Charge::cached_lookup) > cost_ps("ipsc2", Charge::home_lookup));
}

TEST_CASE("the iPSC/860 computes seven times as fast as the iPSC/2, and nothing is slower than that") {
  const auto step_ps = [](std::string_view name) { return static_cast<double>(cost_ps(name, Charge::cell_step)); };
  CHECK(step_ps("ipsc2") / step_ps("ipsc860") == doctest::Approx(7).epsilon(0.001));
  for (const MachineDescription& preset : machine_presets()) {
    CHECK(step_ps(preset.machine.name) <= step_ps("ipsc2"));
  }
}

TEST_CASE("ipsc2-1994 is the iPSC/2 but for its prices, which are those fitted to the article's voxels") {
  nodes::Machine priced = machine("ipsc2");
  const auto set_price = [&priced](Charge charge, std::uint64_t factor, std::uint64_t measured_ps) {
    priced.cost_ps[static_cast<std::size_t>(charge)] = factor * measured_ps;
  };
  const core::WorkPrices& measured = core::measured_prices;
  const std::uint64_t walk = 8'386, rays = 33'985;
  set_price(Charge::cell_step, walk, measured.cell_step_ps);
  set_price(Charge::bvh_node_read, walk, measured.bvh_node_read_ps);
  for (std::size_t i = 0; i < 3; ++i) {  // a reference that is read has its polygon tested: one operation, of both prices
    const Charge test = std::array{Charge::triangle_test, Charge::sphere_test, Charge::cone_test}[i];
    set_price(test, walk, measured.bvh_node_read_ps + measured.primitive_test_ps[i]);
  }
  set_price(Charge::ray_setup, rays, measured.ray_ps);
  set_price(Charge::shading, rays, measured.shading_ps);
  set_price(Charge::cached_lookup, 5'150, operation_costs_ps(1)[static_cast<std::size_t>(Charge::cached_lookup)]);
  CHECK(priced.digest() == machine("ipsc2-1994").digest());
  CHECK(cost_ps("ipsc2-1994", Charge::cell_step) == 62'895'000);
  CHECK(cost_ps("ipsc2-1994", Charge::triangle_test) == 154'302'400);
  CHECK(cost_ps("ipsc2-1994", Charge::ray_setup) == 1'869'175'000);
  CHECK(cost_ps("ipsc2-1994", Charge::shading) == 5'675'495'000);
  CHECK(cost_ps("ipsc2-1994", Charge::cached_lookup) == 16'274'000);
  CHECK(cost_ps("ipsc2-1994", Charge::page_install) == cost_ps("ipsc2", Charge::page_install));
}

TEST_CASE("a machine whose prices are for other structures than a run's is told, and which machine has prices for it") {
  using core::Structure;
  CHECK(price_note(machine("ipsc2"), Structure::grid).empty());
  CHECK(price_note(machine("hdr"), Structure::extents).empty());
  CHECK(price_note(machine("ipsc2-1994"), Structure::voxels).empty());
  CHECK(price_note(machine("hdr"), Structure::voxels) ==
        "hdr has prices for other structures (grid, extents) than voxels, so virtual times may be far off; ipsc2-1994 has prices "
        "for voxels");
  CHECK(price_note(machine("ipsc2-1994"), Structure::grid) ==
        "ipsc2-1994 has prices for other structures (voxels) than grid, so virtual times may be far off; ipsc2 has prices for "
        "grid");
  CHECK_FALSE(price_note(machine("ipsc2-1994"), Structure::extents).empty());
  CHECK(price_note(nodes::Machine(), Structure::voxels).empty());  // it does not say
}

}  // namespace dmpc::apps::machines_test
