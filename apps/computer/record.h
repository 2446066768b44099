// The results of a finished program: of its run or, for tasks over pages, of its runs together.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/computer/packet_pairs.h"
#include "apps/computer/vocabulary.h"
#include "apps/frontend/run/run_view.h"
#include "nodes/counters.h"
#include "nodes/local_memory.h"
#include "nodes/observers/trace.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/virtual/virtual_times.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/pages/run_tasks.h"
#include "svm/pages/task_heat.h"
#include "svm/pages/task_plan.h"

namespace dmpc::apps {

/// A node after the run.
struct ProgramNode {
  nodes::NodeCounters counters;
  nodes::Charges charges;
  nodes::VirtualTimes times;            ///< modelled machine only
  svm::PageCounters pages;              ///< tasks only
  nodes::MemoryPlan memory;             ///< of the run with the largest one
  std::vector<std::size_t> used_bytes;  ///< per declared piece of memory

  /// Adds the additive counters of another run.
  ProgramNode& operator+=(const ProgramNode& more);
};

/// The runs of a program of tasks.
struct TaskRuns {
  std::uint32_t run_count = 0;
  std::uint64_t task_count = 0;
  // Only of the last run:
  std::uint32_t page_count = 0, cache_pages = 0;
  svm::PageCounters last_pages;
  std::vector<svm::ReferenceLog> references;  ///< by node, if requested
  svm::TaskHeat heat;                         ///< by task, if requested
};

/// A view, as far as it has references.
struct ProgramRecord {
  std::string name;  ///< the program's
  const ProgramOptions& options;
  const Vocabulary& vocabulary;
  std::vector<ProgramNode> nodes;
  std::vector<nodes::RankFigures> ranks;  ///< if there are ranks: traffic of all runs, other figures of the last run
  double wall_seconds = 0;
  std::optional<std::uint64_t> virtual_ns, run_hash;  ///< modelled machine only
  std::optional<nodes::VirtualReport> network;        ///< likewise, of a program with packets
  std::string result;                                 ///< the program's result
  TaskRuns tasks;
  std::optional<nodes::Trace> trace;  ///< of the last run, as the members below
  std::optional<RunView> view;        ///< for a report
  std::optional<PacketPairs> pairs;   ///< likewise, of a program with packets and few enough nodes

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes.size()); }
  /// Adds a run of `task_count` tasks.
  void add(const svm::TaskFigures& figures, const svm::TaskPlan& plan, std::uint32_t task_count);
  /// Adds the virtual time of a run to that of the existing nodes.
  void add(const nodes::VirtualReport& report);
  /// Returns the sum of all nodes, with the memory of the fullest one.
  ProgramNode sum() const;
};

/// Returns the traffic of the packets in the vocabulary.
nodes::Traffic sent(const ProgramRecord& record);

/// Returns "8 nodes" or "8 nodes of ipsc2".
std::string computer_text(const ProgramOptions& options);

/// Describes the run time, the traffic and a node's memory in one or two lines.
std::string summary(const ProgramRecord& record);

/// Returns all counters as JSON, with a final newline. The keys are an interface: names with units last.
std::string stats_json(const ProgramRecord& record);

/// Writes the trace in the format of its file's extension.
void write_program_trace(const ProgramRecord& record, std::ostream& output);

}  // namespace dmpc::apps
