#include "apps/computer/program_main.h"

#include <unistd.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <variant>

#include "apps/computer/program_call.h"
#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/line/help_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/ranks/launcher.h"
#include "apps/frontend/ranks/rank_group.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/output_set.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Parses the command line and runs the program; returns nothing if help was printed.
int read_and_act(const ProgramCall& call, const ProgramMain& program, Interrupt& interrupt) {
  CommandLine line(program.description, DMPC_VERSION, "", call.name);
  program.declare(line.own_options());
  const auto what = with_words_agreed([&] { return line.parse(call.words); }, CompanionOf::own_program);
  if (const HelpText* const help = std::get_if<HelpText>(&what)) {
    print_help(std::cout, help->text);
    finish_output(std::cout, "the help");
    return 0;
  }
  if (program.runner != RunnerKind::mpi) {
    with_words_agreed([] { expect_one_process("run it together: --runner=mpi"); }, CompanionOf::own_program);
  }
  return program.act(call, interrupt);
}

int complain(const std::string& name, const std::string& message, int status) {
  std::cerr << name + ": " + with_words_clipped(message) + "\n"
            << std::flush;  // in one piece, since several processes may share stderr
  return status;
}

int status_of(const ProgramCall& call, const ProgramMain& program) {
  const std::string& name = call.name;
  const ProgramEnds ends(name);
  Interrupt interrupt(ends.look());
  try {
    return read_and_act(call, program, interrupt);
  } catch (const Interrupted&) {
    return complain(name, std::string("interrupted, ") + interrupt.consequence(), interrupted_status);
  } catch (const core::CapacityError& error) {
    return complain(name, error.what(), no_capacity_status);
  } catch (const core::InputError& error) {
    return complain(name, error.what(), input_status);
  } catch (const core::UsageError& error) {
    return complain(name, error.what(), usage_status);
  } catch (const dmpc::UsageError& error) {
    return complain(name, error.what(), usage_status);
  } catch (const ProgramError& error) {
    return complain(name, std::string("the program: ") + error.what(), internal_status);
  } catch (const std::bad_alloc&) {
    return complain(name, "there is no more memory: ask for fewer nodes", no_capacity_status);
  } catch (const std::exception& error) {
    return complain(name, error.what(), internal_status);
  } catch (...) {
    return complain(name, "the program: what it threw is no std::exception", internal_status);
  }
}

}  // namespace

int run_main(int count, const char* const* words, const ProgramMain& program) {
  const std::string name = count > 0 ? std::filesystem::path(words[0]).filename().string() : "program";
  const ShownOutput errors(std::cerr);  // also for the programs' own output
  std::optional<ShownOutput> output;
  if (::isatty(STDOUT_FILENO) == 1) {
    output.emplace(std::cout);
  }
  const int status = status_of({name, {words + (count > 0 ? 1 : 0), words + count}}, program);
  end_ranks(status);
  return status;
}

}  // namespace dmpc::apps
