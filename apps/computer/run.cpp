// Runs a program that declares its packets, from its options to its results.
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/hosted_program.h"
#include "apps/computer/on_ranks.h"
#include "apps/computer/options.h"
#include "apps/computer/plan.h"
#include "apps/computer/program_main.h"
#include "apps/computer/program_observer.h"
#include "apps/computer/program_outputs.h"
#include "apps/computer/rank_rounds.h"
#include "apps/computer/record.h"
#include "apps/computer/vocabulary.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/computer_capacity.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/stopwatch.h"
#include "nodes/gathering.h"
#include "nodes/program.h"
#include "nodes/runner.h"

namespace dmpc::apps {
namespace {

std::vector<nodes::NodeSpecification> specifications(const ProgramPlan& plan, const AnyApplication& application) {
  std::vector<nodes::NodeSpecification> all;
  for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
    all.push_back({.plan = plan.memory(node),
                   .mailbox = plan.mailbox(node),
                   .make_program = [&plan, &application](nodes::Node& own) -> std::unique_ptr<nodes::Program> {
                     return std::make_unique<HostedProgram>(own, plan, application.make);
                   },
                   .held_bytes = plan.held_bytes()});
  }
  all.push_back({.plan = plan.host_memory(),
                 .mailbox = {},
                 .make_program = [](nodes::Node&) { return std::make_unique<nodes::IdleProgram>(); },
                 .held_bytes = plan.held_bytes()});
  return all;
}

const HostedProgram& hosted(nodes::Runner& runner, std::size_t index) {
  return static_cast<const HostedProgram&>(runner.program(index));
}

/// Makes the runner and each node's program; with ranks it waits for all of them.
std::unique_ptr<nodes::Runner> made_runner(const std::vector<nodes::NodeSpecification>& all, const ProgramOptions& options,
                                           ProgramObserver& observer, RankRounds* rounds) {
  const nodes::RankLinks* const links = options.computer.ranks;
  check_room(nodes::rank_memory(nodes::peers_of(all), links, links == nullptr ? 0 : links->rank()));
  const auto make = [&] { return nodes::make_runner(all, options.computer, observer.observer()); };
  if (rounds == nullptr) {
    return make();
  }
  std::unique_ptr<nodes::Runner> runner = rounds->apart(make);
  rounds->meet();
  return runner;
}

/// Returns which nodes wait for each other in a deadlock. To be called on all ranks.
std::vector<std::vector<Unanswered>> awaited_of_all(nodes::Runner& runner, const ProgramPlan& plan) {
  const auto reported = runner.gather([&](std::size_t index) {
    return index == plan.node_count() ? std::string() : flat_bytes(hosted(runner, index).node().awaited());
  });
  std::vector<std::vector<Unanswered>> awaited;
  for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
    awaited.push_back(reported[node].empty() ? std::vector<Unanswered>() : unanswered_from(reported[node]));
  }
  return awaited;
}

/// Returns whether the run completed. In a deadlock rank 0 throws the nodes' descriptions and a cycle; other ranks return false.
bool run_to_end(nodes::Runner& runner, const ProgramPlan& plan, const Interrupt& interrupt, bool is_first) {
  try {
    if (runner.run(interrupt.token()) == nodes::RunEnd::interrupted) {
      throw Interrupted{};
    }
    return true;
  } catch (const nodes::DeadlockError& error) {
    const std::string circle = circle_text(awaited_of_all(runner, plan));
    return is_first ? throw nodes::DeadlockError(error.what() + circle) : false;
  }
}

/// Returns the programs' outcomes on rank 0. To be called on all ranks.
std::vector<std::string> gather_outcomes(ProgramRecord& record, nodes::Runner& runner, const ProgramPlan& plan,
                                         const AnyApplication& application) {
  std::vector<std::string> outcomes;
  nodes::gather_nodes(
      runner, plan.node_count(),
      [&](std::size_t index, nodes::FlatWriter& reported) {
        const HostedProgram& program = hosted(runner, index);
        reported.put(runner.node(index).counters());
        reported.put(program.charges());
        reported.put_all(program.node().used_bytes());
        reported.put_bytes(program.outcome(application.outcome));
      },
      [&](std::uint32_t node, nodes::FlatReader& reported) {
        ProgramNode& own = record.nodes.emplace_back();
        own.counters = reported.take<nodes::NodeCounters>();
        own.charges = reported.take<nodes::Charges>();
        own.memory = plan.memory(node);
        own.used_bytes = reported.take_all<std::size_t>();
        outcomes.emplace_back(reported.take_bytes());
      });
  return outcomes;
}

/// Checks that every packet that has an answer was answered by the end.
void check_answers(const ProgramRecord& record, const ProgramPlan& plan) {
  const std::vector<PacketNeed>& packets = plan.needs().packets;
  const nodes::TrafficByKind sent = record.sum().counters.sent;
  for (Index packet = 0; packet < packets.size(); ++packet) {
    if (const auto answer = plan.answer_of(packet)) {
      const std::uint64_t unanswered = sent[packet].packets - sent[*answer].packets;
      if (unanswered != 0) {
        throw ProgramError(counted(unanswered, "packet") + " '" + packets[packet].name + "' had no answer '" +
                           packets[*answer].name + "' when all nodes had finished: answer each of them");
      }
    }
  }
}

/// Runs the plan; with ranks, this rank's part.
int run_plan(const ProgramCall& call, const ProgramOptions& options, const ProgramPlan& plan, const AnyApplication& application,
             const Interrupt& interrupt, RankRounds* rounds) {
  const ProgramOutputs outputs = outputs_of(options);
  const bool is_first = rounds == nullptr || rounds->is_first();
  if (is_first) {
    check_outputs(options, outputs);
  }
  const Vocabulary vocabulary = vocabulary_of(plan.needs());
  ProgramObserver observer(options, vocabulary, {.node_count = plan.node_count()});
  const std::vector<nodes::NodeSpecification> all = specifications(plan, application);
  const auto runner = made_runner(all, options, observer, rounds);
  ProgramRecord record{.name = call.name, .options = options, .vocabulary = vocabulary};
  Stopwatch stopwatch;
  if (!run_to_end(*runner, plan, interrupt, is_first)) {
    return 0;
  }
  record.wall_seconds = stopwatch.lap();
  const std::vector<std::string> outcomes = gather_outcomes(record, *runner, plan, application);
  const auto add = [&observer](std::string_view seen, const nodes::ClockDrift& clock) { observer.add(seen, clock); };
  record.ranks = nodes::gather_rank_figures(*runner, all, options.computer.ranks, add, [&observer] { return observer.seen(); });
  nodes::expect_nothing_lost(record.ranks);
  if (!is_first) {
    return 0;
  }
  record.network = runner->virtual_report();
  const auto end = [&] {
    if (record.network) {
      record.add(*record.network);
    }
    observer.take(record);
    check_answers(record, plan);
    record.result = application.result(outcomes);
    return end_program(record, outputs);
  };
  return rounds == nullptr ? end() : rounds->apart(end);
}

ProgramPlan plan_of(const AnyApplication& application, const ProgramOptions& options) {
  if (!application.needs) {
    throw ProgramError("it declares no needs: Application::needs is a function of the number of nodes");
  }
  return {application.needs(options.computer.node_count), options.computer};
}

int run_program_on_ranks(const ProgramCall& call, ProgramOptions& options, const AnyApplication& application,
                         const Interrupt& interrupt) {
  std::optional<ProgramPlan> plan;
  const auto needs = [&]() -> RankNeeds {
    plan.emplace(plan_of(application, options));
    return {.payload_bytes_max = plan->payload_bytes_max(), .alike = {{"needs of the program", hash_text(plan->digest())}}};
  };
  return run_on_ranks(options, call, needs,
                      [&](RankRounds& rounds) { return run_plan(call, options, *plan, application, interrupt, &rounds); });
}

int run_program(const ProgramCall& call, ProgramOptions& options, const AnyApplication& application, const Interrupt& interrupt) {
  if (options.runner == RunnerKind::mpi) {
    return run_program_on_ranks(call, options, application, interrupt);
  }
  const ProgramPlan plan = plan_of(application, options);
  choose_machine(options, vocabulary_of(plan.needs()));
  return run_plan(call, options, plan, application, interrupt, nullptr);
}

}  // namespace
}  // namespace dmpc::apps

namespace dmpc {

int run_any(int count, const char* const* words, const AnyApplication& application) {
  apps::ProgramOptions options;
  return apps::run_main(
      count, words,
      {.description = application.description,
       .declare = [&](apps::OptionSet set) { apps::add_options(set, options, application.options); },
       .runner = options.runner,
       .act = [&](const apps::ProgramCall& call,
                  apps::Interrupt& interrupt) { return apps::run_program(call, options, application, interrupt); }});
}

}  // namespace dmpc
