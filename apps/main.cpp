// The program: reads the command line, calls one command, and turns what went wrong into an exit status.
//   0 done    1 bad input    2 wrong usage    3 an internal check failed    4 no room    130 interrupted

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "apps/accurate/precision_command.h"
#include "apps/check.h"
#include "apps/compare.h"
#include "apps/error/command.h"
#include "apps/exit_status.h"
#include "apps/info/command.h"
#include "apps/interrupt.h"
#include "apps/machine.h"
#include "apps/options.h"
#include "apps/output_file.h"
#include "apps/progress.h"
#include "apps/render.h"
#include "apps/scale/command.h"
#include "apps/scene.h"
#include "apps/speed/command.h"
#include "apps/stability/command.h"
#include "apps/study.h"
#include "apps/system/surroundings.h"
#include "core/expect.h"

namespace dmpc::apps {

namespace {

/// One overload a command.
struct Execute {
  Interrupt& interrupt;

  int operator()(const HelpText& help) const {
    std::cout << help.text;
    finish_output(std::cout, "the help");
    return 0;
  }
  int operator()(const RenderOptions& options) const { return render_command(options, interrupt, std::cout); }
  int operator()(const InfoOptions& options) const { return info_command(options, interrupt, std::cout); }
  int operator()(const SceneOptions& options) const { return scene_command(options, interrupt, std::cout); }
  int operator()(const CheckOptions& options) const { return check_command(options, interrupt); }
  int operator()(const CompareOptions& options) const { return compare_command(options, interrupt, std::cout); }
  int operator()(const MachineOptions& options) const { return machine_command(options, std::cout); }
  int operator()(const PaperStudyOptions& options) const { return study_paper_command(options, interrupt, std::cout); }
  int operator()(const ScaleOptions& options) const { return study_scale_command(options, interrupt, std::cout); }
  int operator()(const ErrorOptions& options) const { return bench_error_command(options, interrupt, std::cout); }
  int operator()(const SpeedOptions& options) const { return bench_speed_command(options, interrupt, std::cout); }
  int operator()(const StabilityOptions& options) const { return bench_stability_command(options, interrupt, std::cout); }
  int operator()(const PrecisionOptions& options) const { return bench_precision_command(options, interrupt, std::cout); }
  int operator()(const StudyOptions& options) const { return study_command(options, interrupt, std::cout); }
};

/// Commands that show progress have a field `quiet`.
constexpr auto obey_quiet = [](const auto& options) {
  if constexpr (requires { options.quiet; }) {
    if (options.quiet) {
      silence_progress();
    }
  }
};

int complain(const std::string& message, int status) {
  std::cerr << "dmpc: " << message << std::endl;
  return status;
}

/// `has_broken_pipe` becomes true if nobody reads any more what was to be said.
int run(const std::vector<std::string>& arguments, bool& has_broken_pipe) {
  Interrupt interrupt;
  try {
    const Command command = parse_command_line(arguments);
    std::visit(obey_quiet, command);
    return std::visit(Execute{interrupt}, command);
  } catch (const Interrupted&) {
    return complain(std::string("interrupted, ") + interrupt.consequence(), interrupted_status);
  } catch (const BrokenPipe&) {
    has_broken_pipe = true;
    return input_status;
  } catch (const core::RoomError& error) {
    return complain(error.what(), no_room_status);
  } catch (const core::InputError& error) {
    return complain(error.what(), input_status);
  } catch (const core::UsageError& error) {
    return complain(error.what(), usage_status);
  } catch (const std::bad_alloc&) {
    return complain("this computer has not enough memory for that: try a smaller scene or --resolution", no_room_status);
  } catch (const std::exception& error) {
    return complain(std::string("this is a bug in dmpc, please report it: ") + error.what(), internal_status);
  }
}

}  // namespace

}  // namespace dmpc::apps

int main(int count, char** values) {
  dmpc::apps::settle_in();
  bool has_broken_pipe = false;
  const int status = dmpc::apps::run(std::vector<std::string>(values + 1, values + count), has_broken_pipe);
  if (has_broken_pipe) {
    dmpc::apps::end_by_broken_pipe();
  }
  return status;
}
