// Tasks over pages, of any kind: run on the computer from bytes to results.
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

/// Figures of a run, without results. Those of nodes on other ranks are known only on rank 0.
struct TaskFigures {
  nodes::RunEnd end = nodes::RunEnd::finished;
  std::vector<PageCounters> pages;                   ///< by node
  std::vector<nodes::NodeCounters> counters;         ///< by node
  std::vector<nodes::Charges> charges;               ///< by node
  std::optional<nodes::VirtualReport> virtual_time;  ///< on a modelled machine
  std::vector<nodes::RankFigures> ranks;             ///< on rank 0, if there are ranks

  /// The sum over all nodes.
  PageCounters all_pages() const;
};

template <class Result>
struct TaskReport : TaskFigures {
  std::vector<Result> results;  ///< by task; meaningless if the run was interrupted
};

/// Observers of a run. On ranks each has the same.
struct TaskWatching {
  nodes::Observer* observer = nullptr;
  std::vector<ReferenceLog>* reference_logs = nullptr;  ///< one for each node, to record its references
  TaskHeat* heat = nullptr;                             ///< for all tasks; each task's costs are added to it
  /// On ranks, after the nodes that are here are made: calls `run`, in which ranks communicate, on the communicating thread, as
  /// soon as all ranks have their nodes.
  std::function<void(const std::function<void()>& run)> communicate = [](const auto& run) { run(); };
  /// Likewise, after a regular end: what was observed here, and, on rank 0, what was observed on another rank.
  std::function<std::string()> seen = [] { return std::string(); };
  nodes::AddSeen add = {};
};

/// Tasks for a program that records references, and for one that does not.
struct TaskKinds {
  TaskKind<Pager> plain;
  TaskKind<RecordingPager> recording;
};

/// Takes a node's results: those of tasks `first` on, as bytes. Results of nodes on other ranks come only to rank 0.
using TakeResults = std::function<void(std::uint32_t first, std::string_view results)>;

/// run_tasks() for a given plan and tasks of a type that is not known here.
TaskFigures run_tasks_of_kind(const TaskKinds& kinds, const TaskPlan& plan, std::span<const std::byte> database,
                              const TaskWatching& watching, std::stop_token stop, const TakeResults& take);

/// Runs tasks 0 .. count - 1 over `database`, whole pages that are distributed over the nodes and do not change. Results are the
/// same for every computer, cache and schedule, if each task's depend only on its number and what it reads. With in_flight = 1 so
/// is the order of each node's references for every cache: then the predictions of svm/pages/observers for other caches are
/// exact. Throws core::UsageError and core::CapacityError as TaskPlan does, and whatever a task throws.
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
