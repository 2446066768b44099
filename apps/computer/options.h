// The options of a program of somebody's own: those of the computer, as `dmpc render` has them, and the program's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/computer/dmpc/computer.h"
#include "apps/line/command_line.h"
#include "nodes/computer_request.h"

namespace dmpc::apps {

struct ProgramOptions {
  nodes::ComputerRequest computer;  ///< with the machine, once it is read
  bool is_modelled = false;
  std::string machine_name = "ipsc2";           ///< to be modelled: a preset's name or a machine file
  std::optional<nodes::TopologyKind> topology;  ///< in place of the machine's
  std::optional<std::uint64_t> chaos_seed;
  std::optional<std::filesystem::path> stats;  ///< where the counters go, as JSON
  std::optional<std::filesystem::path> trace;  ///< .json or .paje
  bool quiet = false;                          ///< no closing lines
};

/// Declares them, and which go together.
void add_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);

/// Reads the machine that is to be modelled, if one is, and gives it the program's operations. Throws core::InputError as
/// load_machine() does.
void choose_machine(ProgramOptions& options, const std::vector<OperationNeed>& operations);

}  // namespace dmpc::apps
