// The options of a program of somebody's own: those of the computer, as `dmpc render` has them, and the program's.
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
  std::optional<nodes::TopologyKind> topology;  ///< in place of the machine's
  std::optional<std::uint64_t> chaos_seed;
  std::optional<std::filesystem::path> stats;   ///< where the counters go, as JSON
  std::optional<std::filesystem::path> trace;   ///< .pftrace
  std::optional<std::filesystem::path> report;  ///< .html
  bool quiet = false;                           ///< no closing lines
  // A program of tasks has these, too:
  svm::TaskOptions tasks;                           ///< the computer is the program's
  std::optional<std::filesystem::path> references;  ///< where those of the last run go, as CSV
  std::optional<std::filesystem::path> heat;        ///< where what each task of the last run took goes, as CSV

  /// Somebody sees the run happen.
  bool is_observed() const { return trace || report; }
  bool is_modelled() const { return runner == RunnerKind::virtual_time; }
};

/// Declares them, and which go together.
void add_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);
/// Its parts: the program's own and the computer's, and, once others are declared, what is written of a run.
void add_computer_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);
void add_closer_look(OptionSet options, ProgramOptions& program);

/// Reads the machine that is to be modelled, if one is, and gives it the program's operations in place of a renderer's. Throws
/// core::InputError as load_machine() does.
void choose_machine(ProgramOptions& options, const Vocabulary& vocabulary);

}  // namespace dmpc::apps
