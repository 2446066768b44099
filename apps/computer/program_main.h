// Runs a program from its command line to its exit status.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// The command line of a program.
struct ProgramCall {
  std::string name;                ///< name of the executable
  std::vector<std::string> words;  ///< the arguments
};

struct ProgramMain {
  std::string description;
  std::function<void(OptionSet options)> declare;  ///< declares the program's options
  const RunnerKind& runner;                        ///< as set by the options
  /// Runs the program after the options are read; returns the exit status.
  std::function<int(const ProgramCall& call, Interrupt& interrupt)> act;
};

/// Call it once, from main().
int run_main(int count, const char* const* words, const ProgramMain& program);

}  // namespace dmpc::apps
