#include "apps/computer/options.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/frontend/machine/machines.h"
#include "core/trace/charge.h"

namespace dmpc::apps::computer_options_test {

namespace {

Vocabulary with_operations(const std::vector<OperationNeed>& operations) { return vocabulary_of({.operations = operations}); }

}  // namespace

TEST_CASE("a machine takes as many times as long for a program's operations as for its other arithmetic") {
  for (const MachineDescription& preset : machine_presets()) {
    ProgramOptions options;
    options.runner = RunnerKind::virtual_time;
    options.machine_name = preset.machine.name;
    choose_machine(options, with_operations({{"cheap", 1}, {"dear", 40}, {"free", 0}}));
    const auto tested = static_cast<std::size_t>(core::Charge::triangle_test);
    const double slowdown =
        static_cast<double>(preset.machine.cost_ps[tested]) / static_cast<double>(operation_costs_ps(1)[tested]);
    const nodes::Machine& machine = *options.computer.machine;
    CHECK(machine.cost_ps[0] == static_cast<std::uint64_t>(1000 * slowdown + 0.5));
    CHECK(machine.cost_ps[1] == static_cast<std::uint64_t>(40'000 * slowdown + 0.5));
    CHECK(machine.cost_ps[2] == 0);
    CHECK(machine.cost_ps[tested] == 0);
    CHECK(machine.topology == preset.machine.topology);
    CHECK(machine.name == preset.machine.name);
  }
}

TEST_CASE("a machine is wired otherwise where that is asked for, and says so") {
  ProgramOptions options;
  options.runner = RunnerKind::virtual_time;
  options.machine_name = "hdr";
  options.topology = nodes::TopologyKind::torus;
  choose_machine(options, {});
  CHECK(options.computer.machine->topology == nodes::TopologyKind::torus);
  CHECK(options.computer.machine->uplinks == 1);
  CHECK(options.computer.machine->name == "hdr as torus");
}

TEST_CASE("threads have no machine") {
  ProgramOptions options;
  choose_machine(options, with_operations({{"step", 1}}));
  CHECK(options.computer.model() == nullptr);
}

}  // namespace dmpc::apps::computer_options_test
