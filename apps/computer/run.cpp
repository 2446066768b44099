// Runs a program that declares its packets: from its options to what came of it.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/hosted_program.h"
#include "apps/computer/options.h"
#include "apps/computer/plan.h"
#include "apps/computer/program_main.h"
#include "apps/computer/program_page.h"
#include "apps/computer/program_watch.h"
#include "apps/computer/record.h"
#include "apps/line/number_text.h"
#include "apps/system/attempts.h"
#include "apps/system/interrupt.h"
#include "apps/system/memory_room.h"
#include "apps/system/output_set.h"
#include "apps/system/stopwatch.h"
#include "nodes/runner.h"
#include "nodes/standstill.h"

namespace dmpc::apps {
namespace {

OutputSet<ProgramRecord> outputs_of(const ProgramOptions& options) {
  OutputSet<ProgramRecord> outputs;
  if (options.stats) {
    outputs.add("--stats", *options.stats, check_output_path,
                [](const ProgramRecord& record, std::ostream& stream) { stream << stats_json(record); });
  }
  if (options.trace) {
    outputs.add("--trace", *options.trace, check_output_path, write_trace);
  }
  if (options.report) {
    outputs.add("--report", *options.report, check_output_path, html::write_program_page);
  }
  return outputs;
}

std::vector<nodes::NodeSpecification> specifications(const ProgramPlan& plan, const AnyApplication& application) {
  std::vector<nodes::NodeSpecification> all;
  std::uint64_t bytes = plan.host_memory().total();
  for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
    all.push_back({.plan = plan.memory(node),
                   .mailbox = plan.mailbox(node),
                   .make_program = [&plan, &application](nodes::Node& own) -> std::unique_ptr<nodes::Program> {
                     return std::make_unique<HostedProgram>(own, plan, application.make);
                   },
                   .held_bytes = plan.held_bytes()});
    bytes += all.back().plan.total();
  }
  check_memory_room(bytes, counted(plan.node_count(), "node"));
  all.push_back({.plan = plan.host_memory(),
                 .mailbox = {},
                 .make_program = [](nodes::Node&) { return std::make_unique<IdleProgram>(); },
                 .held_bytes = plan.held_bytes()});
  return all;
}

/// Each packet that has an answer was answered, by the end.
void check_answers(const ProgramRecord& record) {
  const std::vector<PacketNeed>& packets = record.plan.needs().packets;
  for (Index packet = 0; packet < packets.size(); ++packet) {
    if (const auto answer = record.plan.answer_of(packet)) {
      const std::uint64_t unanswered = sent(record, packet).packets - sent(record, *answer).packets;
      if (unanswered != 0) {
        throw ProgramError(counted(unanswered, "packet") + " '" + packets[packet].name + "' had no answer '" +
                           packets[*answer].name + "' when all nodes had finished: answer each of them");
      }
    }
  }
}

void take_programs(ProgramRecord& record, nodes::Runner& runner, const AnyApplication& application) {
  std::vector<const dmpc::Program*> own;
  for (std::uint32_t node = 0; node < record.plan.node_count(); ++node) {
    const auto& program = static_cast<const HostedProgram&>(runner.program(node));
    record.programs.push_back(&program);
    record.counters.push_back(&runner.node(node).counters());
    own.push_back(&program.program());
  }
  check_answers(record);
  record.result = application.result(own);
}

/// Whether it came to its end. If all stand still, throws what each node says, and who waits for whom.
bool run_to_end(nodes::Runner& runner, const ProgramPlan& plan, const Interrupt& interrupt) {
  try {
    return runner.run(interrupt.token()) == nodes::RunEnd::finished;
  } catch (const nodes::StandstillError& error) {
    std::vector<std::vector<Unanswered>> awaited;
    for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
      awaited.push_back(static_cast<const HostedProgram&>(runner.program(node)).node().awaited());
    }
    throw nodes::StandstillError(error.what() + circle_text(awaited));
  }
}

int run_program(const std::string& name, ProgramOptions& options, const AnyApplication& application, Interrupt& interrupt) {
  const OutputSet<ProgramRecord> outputs = outputs_of(options);
  check_outputs(inputs_of(options), outputs.names());
  check_page_room(options);
  if (!application.needs) {
    throw ProgramError("it declares no needs: Application::needs is a function of the number of nodes");
  }
  const ProgramPlan plan(application.needs(options.computer.node_count), options.computer);
  choose_machine(options, plan.needs().operations);
  ProgramWatch watch(options, plan.node_count());
  const auto runner = nodes::make_runner(specifications(plan, application), options.computer, watch.observer());
  ProgramRecord record{.name = name, .options = options, .plan = plan};
  Stopwatch stopwatch;
  if (!run_to_end(*runner, plan, interrupt)) {
    throw Interrupted{};
  }
  record.wall_seconds = stopwatch.lap();
  record.virtual_time = runner->virtual_report();
  take_programs(record, *runner, application);
  watch.take(record);
  Attempts attempts(std::cerr, name);
  outputs.write(record, attempts);
  attempts.make([&] { print_result(record.result, summary(record), options); });
  return attempts.status();
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
       .act = [&](const std::string& name,
                  apps::Interrupt& interrupt) { return apps::run_program(name, options, application, interrupt); }});
}

}  // namespace dmpc
