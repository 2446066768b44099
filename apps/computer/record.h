// What is known of a program once it is done: of its run or, where it has tasks over pages, of its runs together.
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

/// A node when all is over.
struct ProgramNode {
  nodes::NodeCounters counters;
  nodes::Charges charges;
  nodes::VirtualTimes times;            ///< modelled machine only
  svm::PageCounters pages;              ///< tasks only
  nodes::MemoryPlan memory;             ///< in the run that took most
  std::vector<std::size_t> used_bytes;  ///< per piece of memory that the program declares

  /// What there is to add of another run.
  ProgramNode& operator+=(const ProgramNode& more);
};

/// What a program of tasks has run.
struct TaskRuns {
  std::uint32_t run_count = 0;
  std::uint64_t task_count = 0;
  // The last run alone:
  std::uint32_t page_count = 0, cache_pages = 0;
  svm::PageCounters last_pages;
  std::vector<svm::ReferenceLog> references;  ///< by node, if they are asked for
  svm::TaskHeat heat;                         ///< likewise, by task
};

/// A view, as far as it has references.
struct ProgramRecord {
  std::string name;  ///< the program's
  const ProgramOptions& options;
  const Vocabulary& vocabulary;
  std::vector<ProgramNode> nodes;
  std::vector<nodes::RankFigures> ranks;  ///< where there are any: traffic of all runs, the rest of the last one
  double wall_seconds = 0;
  std::optional<std::uint64_t> virtual_ns, run_hash;  ///< modelled machine only
  std::optional<nodes::VirtualReport> network;        ///< likewise, of a program with packets
  std::string result;                                 ///< what it came to
  TaskRuns tasks;
  std::optional<nodes::Trace> trace;  ///< the last run's, as the members below
  std::optional<RunView> view;        ///< for a report
  std::optional<PacketPairs> pairs;   ///< likewise, of a program with packets and few enough nodes

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes.size()); }
  /// Adds a run of `task_count` tasks.
  void add(const svm::TaskFigures& figures, const svm::TaskPlan& plan, std::uint32_t task_count);
  /// Adds the time of a run on a modelled machine to that of nodes that are there.
  void add(const nodes::VirtualReport& report);
  /// All nodes as one; memory is the fullest one's.
  ProgramNode sum() const;
};

/// What nodes sent of the packets that the vocabulary names.
nodes::Traffic sent(const ProgramRecord& record);

/// "8 nodes" or "8 nodes of ipsc2".
std::string computer_text(const ProgramOptions& options);

/// How long it took, what travelled and what a node takes, a line or two.
std::string summary(const ProgramRecord& record);

/// All counters as JSON, with a line end. The keys are an interface: names with units last.
std::string stats_json(const ProgramRecord& record);

/// Writes the trace in the format that its file's ending says.
void write_program_trace(const ProgramRecord& record, std::ostream& output);

}  // namespace dmpc::apps
