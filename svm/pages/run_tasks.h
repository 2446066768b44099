// Tasks over pages, of whatever they are: run on the computer from bytes to results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/observer.h"
#include "nodes/observers/watching.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/runner.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/observed_pagers.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/pages/task_heat.h"
#include "svm/pages/task_kind.h"
#include "svm/pages/task_plan.h"

namespace dmpc::svm {

/// What became of a run, beside results. Of nodes on other ranks nothing is known but on rank 0.
struct TaskFigures {
  nodes::RunEnd end = nodes::RunEnd::finished;
  std::vector<PageCounters> pages;                   ///< by node
  std::vector<nodes::NodeCounters> counters;         ///< by node
  std::vector<nodes::Charges> charges;               ///< by node
  std::optional<nodes::VirtualReport> virtual_time;  ///< of a modelled machine
  std::vector<nodes::RankFigures> ranks;             ///< of rank 0, where there are any

  /// The counters of all nodes together.
  PageCounters all_pages() const;
};

template <class Result>
struct TaskReport : TaskFigures {
  std::vector<Result> results;  ///< by task; those of an interrupted run mean nothing
};

/// Who looks on. Of ranks, each has the same.
struct TaskWatching {
  nodes::Observer* observer = nullptr;
  std::vector<ReferenceLog>* reference_logs = nullptr;  ///< one for each node, where its references are noted
  TaskHeat* heat = nullptr;                             ///< of all tasks, to which what each takes is added
  /// On ranks, when the nodes that are here are made: calls `run`, in which ranks talk to each other, on the thread that
  /// communicates, as soon as all ranks have theirs.
  std::function<void(const std::function<void()>& run)> communicate = [](const auto& run) { run(); };
  /// Likewise, after a regular end: what was seen here, and, on rank 0, what was seen on another rank.
  std::function<std::string()> seen = [] { return std::string(); };
  nodes::AddSeen add = {};
};

/// Tasks for a program that notes references, and for one that does not.
struct TaskKinds {
  TaskKind<Pager> plain;
  TaskKind<RecordingPager> recording;
};

/// Where a node's results go: those of tasks `first` on, as bytes. Of nodes on other ranks rank 0 alone has them.
using TakeResults = std::function<void(std::uint32_t first, std::string_view results)>;

/// run_tasks() of tasks whose type is not known here, and for which there is a plan.
TaskFigures run_tasks_of_kind(const TaskKinds& kinds, const TaskPlan& plan, std::span<const std::byte> database,
                              const TaskWatching& watching, std::stop_token stop, const TakeResults& take);

/// Runs tasks 0 .. count - 1 over `database`, whole pages that are spread over the nodes and do not change. Results are the same
/// for every computer, cache and schedule, if each task's depend on its number and what it reads alone. With in_flight = 1 so is
/// the order of each node's references for every cache: then what svm/pages/observers tells of other caches is exact. Throws
/// core::UsageError and core::CapacityError as TaskPlan does, and whatever a task throws.
template <PagedTask Task>
TaskReport<typename Task::Result> run_tasks(std::span<const std::byte> database, std::uint32_t count, const TaskOptions& options,
                                            const TaskWatching& watching = {}, std::stop_token stop = {}) {
  TaskReport<typename Task::Result> report;
  report.results.resize(count);
  const auto take = [&](std::uint32_t first, std::string_view results) {
    if (!results.empty()) {
      std::memcpy(report.results.data() + first, results.data(), results.size());
    }
  };
  const TaskKinds kinds = {task_kind<Pager, Task>(), task_kind<RecordingPager, Task>()};
  const TaskPlan plan(options, database.size(), count, kinds.plain.sizes);
  static_cast<TaskFigures&>(report) = run_tasks_of_kind(kinds, plan, database, watching, std::move(stop), take);
  return report;
}

}  // namespace dmpc::svm
