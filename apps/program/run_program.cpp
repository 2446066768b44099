#include "apps/program/run_program.h"

#include <unistd.h>

#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/ranks/rank_group.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/companion_path.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/last_words.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/surroundings.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

int complain(const std::string& message, int status) {
  std::cerr << "dmpc: " << with_words_clipped(message) << std::endl;
  return status;
}

/// As reported by the standard library, or oneTBB.
bool is_lack_of_threads(const std::exception& error) {
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  return system != nullptr ? system->code() == std::errc::resource_unavailable_try_again
                           : std::string_view(error.what()).starts_with("pthread_create has failed");
}

int complain_of_bug(const std::exception& error) {
  if (memory_has_run_out()) {
    return complain_of_memory();
  }
  if (is_lack_of_threads(error)) {
    return complain(
        "building and reading take a thread for each processor, and this computer does not let dmpc start another: ask for a "
        "higher limit (ulimit -u, pids.max of a container)",
        no_capacity_status);
  }
  return complain(std::string("this is a bug in dmpc, please report it: ") + error.what(), internal_status);
}

/// `has_broken_pipe` becomes true if nobody reads any more what was to be said.
int run(Parse parse, const std::vector<std::string>& arguments, Interrupt& interrupt, bool& has_broken_pipe) {
  try {
    const Command command = with_words_agreed([&] { return parse(arguments); });
    if (command.is_quiet()) {
      silence_progress();
    }
    return command.run(interrupt, std::cout);
  } catch (const Interrupted&) {
    return complain(std::string("interrupted, ") + interrupt.consequence(), interrupted_status);
  } catch (const BrokenPipe&) {
    has_broken_pipe = true;
    return input_status;
  } catch (const core::CapacityError& error) {
    return complain(error.what(), no_capacity_status);
  } catch (const core::InputError& error) {
    return complain(error.what(), input_status);
  } catch (const core::UsageError& error) {
    return complain(error.what(), usage_status);
  } catch (const std::bad_alloc&) {
    return complain_of_memory();
  } catch (const InstallationError& error) {
    return complain(error.what(), internal_status);
  } catch (const nodes::FabricError& error) {
    return complain(error.what(), internal_status);
  } catch (const std::exception& error) {
    return complain_of_bug(error);
  }
}

/// Where not even a complaint may find memory.
int run_within_memory(Parse parse, int count, char** values, bool& has_broken_pipe) {
#if !defined(__SANITIZE_ADDRESS__)  // whose shadow is larger than any memory
  bound_memory();
#endif
  Interrupt interrupt;
  return run(parse, std::vector<std::string>(values + 1, values + count), interrupt, has_broken_pipe);
}

}  // namespace

int run_program(Parse parse, int count, char** values) {
  end_without_abort();
  settle_in();
  const ShownOutput errors(std::cerr);
  std::optional<ShownOutput> output;
  if (::isatty(STDOUT_FILENO) == 1) {
    output.emplace(std::cout);
  }
  bool has_broken_pipe = false;
  try {
    const int status = run_within_memory(parse, count, values, has_broken_pipe);
    end_ranks(status);
    if (has_broken_pipe) {
      end_by_broken_pipe();
    }
    return status;
  } catch (const std::bad_alloc&) {
    return complain_of_memory();
  } catch (const core::CapacityError& error) {
    return complain(error.what(), no_capacity_status);
  }
}

}  // namespace dmpc::apps
