// What is known of a program of tasks once it is done: its runs together.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/paged_options.h"
#include "apps/edge/run/run_view.h"
#include "nodes/counters.h"
#include "nodes/virtual/virtual_times.h"
#include "nodes/watch/trace.h"
#include "svm/pages/run_tasks.h"
#include "svm/pages/task_heat.h"
#include "svm/pages/task_plan.h"
#include "svm/pages/watch/reference_log.h"

namespace dmpc::apps {

/// A node's part of all runs.
struct PagedNode {
  svm::PageCounters pages;
  nodes::Charges charges;
  nodes::Traffic requests, replies;  ///< that it sent
  nodes::VirtualTimes times;         ///< of a modelled machine
  nodes::NodeCounters clock;         ///< of threads: busy, asleep and in all
  std::size_t memory_bytes = 0;      ///< in the run that took most

  PagedNode& operator+=(const PagedNode& more);
};

struct PagedRecord {
  std::string name;  ///< of the program
  const PagedOptions& options;
  const std::vector<OperationNeed>& operations;
  std::string result;  ///< what it came to
  std::vector<PagedNode> nodes;
  std::uint32_t run_count = 0;
  std::uint64_t task_count = 0;
  std::uint32_t page_count = 0, cache_pages = 0;  ///< of the last run
  double wall_seconds = 0;
  std::optional<std::uint64_t> virtual_ns, run_hash;  ///< of a modelled machine
  std::vector<nodes::RankFigures> ranks;              ///< where there are any: traffic of all runs, the rest of the last one
  std::vector<svm::ReferenceLog> references;          ///< of the last run, by node, if they are asked for
  std::optional<nodes::Trace> trace;                  ///< likewise
  svm::TaskHeat heat;                                 ///< likewise, by task
  std::optional<RunView> view;                        ///< likewise, for a report
  svm::PageCounters last_pages;                       ///< of the last run

  /// Adds a run of `task_count` tasks.
  void add(const svm::TaskFigures& figures, const svm::TaskPlan& plan, std::uint32_t tasks);
  /// Of all nodes.
  PagedNode sum() const;
};

/// How long it took, what travelled and what a node takes, a line or two.
std::string summary(const PagedRecord& record);
/// All counters as JSON, with a line end. The keys are an interface: names with units last.
std::string stats_json(const PagedRecord& record);
/// Writes the trace of the last run in the format that its file's ending says.
void write_trace(const PagedRecord& record, std::ostream& output);

}  // namespace dmpc::apps
