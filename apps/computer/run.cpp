// From a program's command line to its exit status.
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/hosted_program.h"
#include "apps/computer/options.h"
#include "apps/computer/plan.h"
#include "apps/computer/record.h"
#include "apps/line/command_line.h"
#include "apps/line/exit_status.h"
#include "apps/line/number_text.h"
#include "apps/machine/machines.h"
#include "apps/system/attempts.h"
#include "apps/system/interrupt.h"
#include "apps/system/memory_room.h"
#include "apps/system/output_set.h"
#include "apps/system/stopwatch.h"
#include "core/base/expect.h"
#include "nodes/runner.h"
#include "nodes/watch/trace.h"

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
  return outputs;
}

std::vector<NamedFile> inputs_of(const ProgramOptions& options) {
  const bool reads_file = options.is_modelled && find_machine_preset(options.machine_name) == nullptr;
  return reads_file ? std::vector<NamedFile>{{"--machine", options.machine_name}} : std::vector<NamedFile>();
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

int run_program(const std::string& name, ProgramOptions& options, const AnyApplication& application, Interrupt& interrupt) {
  const OutputSet<ProgramRecord> outputs = outputs_of(options);
  check_outputs(inputs_of(options), outputs.names());
  const ProgramPlan plan(application.needs(options.computer.node_count), options.computer);
  choose_machine(options, plan.needs().operations);
  std::optional<nodes::TraceRecorder> recorder;
  if (options.trace) {
    recorder.emplace(plan.node_count() + 1, nodes::TraceChoice{});
  }
  const auto runner = nodes::make_runner(specifications(plan, application), options.computer, recorder ? &*recorder : nullptr);
  ProgramRecord record{.name = name, .options = options, .plan = plan};
  Stopwatch stopwatch;
  if (runner->run(interrupt.token()) == nodes::RunEnd::interrupted) {
    throw Interrupted{};
  }
  record.wall_seconds = stopwatch.lap();
  record.virtual_time = runner->virtual_report();
  take_programs(record, *runner, application);
  if (recorder) {
    record.trace = recorder->take();
  }
  Attempts attempts(std::cerr);
  outputs.write(record, attempts);
  attempts.make([&] {
    std::cout << record.result << (record.result.empty() || record.result.ends_with('\n') ? "" : "\n")
              << (options.quiet ? "" : summary(record));
    finish_output(std::cout, "what the program came to");
  });
  return attempts.status();
}

/// What to do, from the line; nothing if help was printed.
int read_and_run(const std::string& name, std::vector<std::string> words, const AnyApplication& application,
                 Interrupt& interrupt) {
  CommandLine line(application.description, DMPC_VERSION, "", name);
  ProgramOptions options;
  add_options(line.own_options(), options, application.options);
  const auto read = line.parse(words);
  if (const HelpText* const help = std::get_if<HelpText>(&read)) {
    std::cout << help->text;
    finish_output(std::cout, "the help");
    return 0;
  }
  return run_program(name, options, application, interrupt);
}

int complain(const std::string& name, const std::string& message, int status) {
  std::cerr << name << ": " << message << std::endl;
  return status;
}

int status_of_run(const std::string& name, const std::vector<std::string>& words, const AnyApplication& application) {
  Interrupt interrupt;
  try {
    return read_and_run(name, words, application, interrupt);
  } catch (const Interrupted&) {
    return complain(name, std::string("interrupted, ") + interrupt.consequence(), interrupted_status);
  } catch (const core::RoomError& error) {
    return complain(name, error.what(), no_room_status);
  } catch (const core::InputError& error) {
    return complain(name, error.what(), input_status);
  } catch (const core::UsageError& error) {
    return complain(name, error.what(), usage_status);
  } catch (const dmpc::UsageError& error) {
    return complain(name, error.what(), usage_status);
  } catch (const ProgramError& error) {
    return complain(name, std::string("the program: ") + error.what(), internal_status);
  } catch (const std::bad_alloc&) {
    return complain(name, "there is no more memory: ask for fewer nodes", no_room_status);
  } catch (const std::exception& error) {
    return complain(name, error.what(), internal_status);
  }
}

}  // namespace
}  // namespace dmpc::apps

namespace dmpc {

int run_any(int count, const char* const* words, const AnyApplication& application) {
  const std::string name = count > 0 ? std::filesystem::path(words[0]).filename().string() : "program";
  return apps::status_of_run(name, {words + (count > 0 ? 1 : 0), words + count}, application);
}

}  // namespace dmpc
