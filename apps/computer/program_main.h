// Runs a program from its command line to its exit status.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// How a program was called.
struct ProgramCall {
  std::string name;                ///< the file's
  std::vector<std::string> words;  ///< behind it
};

struct ProgramMain {
  std::string description;
  std::function<void(OptionSet options)> declare;  ///< its options
  const RunnerKind& runner;                        ///< as they say
  /// What it does once they are read; returns the exit status.
  std::function<int(const ProgramCall& call, Interrupt& interrupt)> act;
};

/// Call it once, from main().
int run_main(int count, const char* const* words, const ProgramMain& program);

}  // namespace dmpc::apps
