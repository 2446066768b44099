#include "apps/computer/options.h"

#include <cmath>
#include <utility>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/run/option_words.h"
#include "apps/frontend/show/trace/perfetto.h"
#include "apps/frontend/table/table_options.h"
#include "core/base/expect.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

using core::UsageError;

void add_computer_group(OptionSet& options, ProgramOptions& program) {
  options.begin_group("The computer");
  options.add_number(nodes_word.option, program.computer.node_count, 1, program_nodes_max, "8; of ranks as their processors",
                     "Number of nodes, each with its own memory");
  options.add_text(
      node_memory_word.option, "SIZE [what it takes]",
      [&program](const std::string& text) {
        program.computer.node_memory_bytes = parse_size_bytes(text, node_memory_word.option);
      },
      "Limit of each node's memory, such as 256KiB; an error if the program takes more");
  options.add_choice<RunnerKind>(
      "--runner", program.runner,
      {{"threads", RunnerKind::threads},
       {"pool", RunnerKind::pool},
       {"virtual", RunnerKind::virtual_time},
       {"mpi", RunnerKind::mpi}},
      "threads: one thread per node. pool: a few threads run all nodes in turn. virtual: a model of a machine with its own time, "
      "the same in every run. mpi: threads of all processes that mpirun or srun started");
  options.add_number("--pool-threads", program.computer.pool_threads, 1, program_nodes_max, "as many as processors; mpi none",
                     "Threads that run all nodes of a process in turn (pool; with mpi in place of one thread per node)");
  options.add_text(
      "--machine", "MACHINE|FILE.json [ipsc2]", [&program](const std::string& name) { program.machine_name = name; },
      "Machine to model (virtual): " + machine_preset_names() + " or a file such as dmpc machine prints");
  options.add_choice<nodes::TopologyKind>("--topology", program.topology, topology_choices(), "the machine's",
                                          "Topology of the machine, in place of its own (virtual)");
  options.add_text(
      "--chaos", "SEED [calm]", [&program](const std::string& text) { program.chaos_seed = parse_seed(text, "--chaos"); },
      "Disturb the computer with this seed (threads): late and reordered packets, slow nodes and links, few credits");
}

void check_runner(const OptionSet& options, const ProgramOptions& program) {
  const auto refuse = [&](const char* option, const std::string& reason) {
    if (options.is_given(option)) {
      throw UsageError(std::string(option) + " does not go with --runner=" + name_of(program.runner) + ": " + reason);
    }
  };
  if (program.is_modelled()) {
    refuse("--chaos", "chaos disturbs threads only");
  } else {
    const std::string reason = program.runner == RunnerKind::mpi ? "ranks run on a real machine" : "threads model no machine";
    refuse("--machine", reason);
    refuse("--topology", reason);
  }
  if (program.runner == RunnerKind::threads) {
    refuse("--pool-threads", "each node has a thread of its own");
  } else if (program.is_modelled()) {
    refuse("--pool-threads", "a model has no threads");
  }
  if (program.trace) {
    check_trace_path(*program.trace);
  }
}

/// Returns the ratio of the machine's time for arithmetic to that of a core of today, measured by triangle tests, which are
/// mostly floating-point multiplications and additions.
double slowdown_of(const nodes::Machine& machine) {
  constexpr auto arithmetic = static_cast<std::size_t>(core::Charge::triangle_test);
  return static_cast<double>(machine.cost_ps[arithmetic]) / static_cast<double>(operation_costs_ps(1)[arithmetic]);
}

/// Returns the requested machine, with a renderer's prices.
nodes::Machine asked_machine(const ProgramOptions& options) {
  nodes::Machine machine = load_machine(options.machine_name).machine;
  if (options.topology && *options.topology != machine.topology) {
    machine.topology = *options.topology;
    machine.uplinks = 1;
    machine.name += " as " + std::string(name_of(machine.topology));
  }
  return machine;
}

}  // namespace

void add_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own) {
  add_computer_options(options, program, own);
  add_closer_look(options, program);
}

void add_computer_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own) {
  if (!own.empty()) {
    options.begin_group("The program");
  }
  for (const NumberOption& option : own) {
    core::expect(option.value != nullptr, "an option has a value to be set");
    options.add_number(option.name, *option.value, option.least, option.most, std::to_string(*option.value), option.description);
  }
  add_computer_group(options, program);
}

void add_closer_look(OptionSet options, ProgramOptions& program) {
  options.begin_group("Diagnostics");
  options.add_path("--stats", "FILE.json", program.stats, "Write all counters");
  options.add_path("--trace", "FILE.pftrace", program.trace,
                   "Write a timeline of what each node did, and its messages, for ui.perfetto.dev");
  add_report_option(options, program.report, "with counters, losses, traffic and what each node was busy with over time");
  options.add_flag("--quiet", program.quiet, "Print no closing lines");
  options.check_in_the_end([options, &program] {
    check_runner(options, program);
    program.is_node_count_given = options.is_given("--nodes");
    choose_pool(program.runner, program.computer);
    if (program.chaos_seed) {
      program.computer.chaos = nodes::chaos_of(*program.chaos_seed);
    }
  });
}

void choose_machine(ProgramOptions& options, const Vocabulary& vocabulary) {
  if (!options.is_modelled()) {
    return;
  }
  nodes::Machine& machine = options.computer.machine.emplace(asked_machine(options));
  const double slowdown = slowdown_of(machine);
  const auto given_ps = std::exchange(machine.cost_ps, {});
  for (const NamedOperation& operation : vocabulary.operations) {
    machine.cost_ps.at(operation.charge) = static_cast<std::uint64_t>(std::llround(operation.nanoseconds * 1000 * slowdown));
  }
  for (const NamedOperation& operation : vocabulary.of_pages) {
    machine.cost_ps.at(operation.charge) = given_ps.at(operation.charge);
  }
}

}  // namespace dmpc::apps
