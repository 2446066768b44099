// The options of a user's program: those of the computer, as in `dmpc render`, and its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/vocabulary.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/run/runner_kind.h"
#include "nodes/computer_request.h"
#include "svm/pages/task_plan.h"

namespace dmpc::apps {

inline constexpr std::uint32_t program_nodes_max = 4096;

struct ProgramOptions {
  nodes::ComputerRequest computer;  ///< with the machine, once it is read
  bool is_node_count_given = false;
  RunnerKind runner = RunnerKind::threads;
  std::string machine_name = "ipsc2";           ///< to be modelled: a preset's name or a machine file
  std::optional<nodes::TopologyKind> topology;  ///< replaces the machine's
  std::optional<std::uint64_t> chaos_seed;
  std::optional<std::filesystem::path> stats;   ///< JSON file of the counters
  std::optional<std::filesystem::path> trace;   ///< .pftrace
  std::optional<std::filesystem::path> report;  ///< .html
  bool quiet = false;                           ///< no closing lines
  // Only for programs of tasks:
  svm::TaskOptions tasks;                           ///< the computer is the program's
  std::optional<std::filesystem::path> references;  ///< CSV file of the last run's references
  std::optional<std::filesystem::path> heat;        ///< CSV file of the cost of each task in the last run

  /// Returns whether the run has observers.
  bool is_observed() const { return trace || report; }
  bool is_modelled() const { return runner == RunnerKind::virtual_time; }
};

/// Declares all options and their compatibility checks.
void add_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);
/// Declares the first part: the program's own options and the computer's. The output options follow once others are declared.
void add_computer_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);
void add_closer_look(OptionSet options, ProgramOptions& program);

/// Reads the modelled machine, if any, with the program's operations instead of a renderer's. Throws core::InputError as
/// load_machine() does.
void choose_machine(ProgramOptions& options, const Vocabulary& vocabulary);

}  // namespace dmpc::apps
