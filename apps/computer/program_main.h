// From a program's command line to its exit status, whatever it does in between.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/edge/line/command_line.h"
#include "apps/edge/system/distinct_files.h"
#include "apps/edge/system/interrupt.h"

namespace dmpc::apps {

/// How a program was called.
struct ProgramCall {
  std::string name;                ///< of its file
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

/// The files that a program reads.
std::vector<NamedFile> inputs_of(const ProgramOptions& options);

/// Throws core::InputError if a report is asked for and the plots of its page could not be drawn for want of a temporary folder.
void check_page_room(const ProgramOptions& options);

/// Prints what a program came to and, unless asked not to, its closing lines.
void print_result(const std::string& result, const std::string& summary, const ProgramOptions& options);

}  // namespace dmpc::apps
