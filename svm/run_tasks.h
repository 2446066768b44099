// Tasks over pages, of whatever they are: run on the computer from bytes to results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/base/expect.h"
#include "nodes/observer.h"
#include "nodes/runner.h"
#include "svm/node_program.h"
#include "svm/task_plan.h"
#include "svm/task_program.h"
#include "svm/watch/recording_pager.h"
#include "svm/watch/reference_log.h"

namespace dmpc::svm {

/// What became of a run, beside results.
struct TaskFigures {
  nodes::RunEnd end = nodes::RunEnd::finished;
  std::vector<PageCounters> pages;                   ///< by node
  std::vector<nodes::NodeCounters> counters;         ///< by node
  std::optional<nodes::VirtualReport> virtual_time;  ///< of a modelled machine

  /// Of all nodes.
  PageCounters all_pages() const;
};

template <class Result>
struct TaskReport : TaskFigures {
  std::vector<Result> results;  ///< by task; those of an interrupted run mean nothing
};

/// Who looks on.
struct TaskWatching {
  nodes::Observer* observer = nullptr;
  std::vector<ReferenceLog>* reference_logs = nullptr;  ///< one for each node, where its references are noted
};

/// Makes the program of node `index`.
using MakeTaskProgram = std::function<std::unique_ptr<AnyTaskProgram>(std::uint32_t index, nodes::Node& node)>;

/// Runs the programs, and hands over what each comes to: results(index, bytes). For run_tasks().
TaskFigures run_task_programs(const TaskPlan& plan, const TaskOptions& options, const MakeTaskProgram& make,
                              const TaskWatching& watching, std::stop_token stop,
                              const std::function<void(std::uint32_t, std::span<const std::byte>)>& results);

/// Runs tasks 0 .. count - 1 over `database`, whole pages that are spread over the nodes and do not change. Results are the same
/// for every computer, cache and schedule, if each task's depend on its number and what it reads alone. With in_flight = 1 so is
/// the order of each node's references for every cache: then what svm/watch tells of other caches is exact. Throws
/// core::UsageError and core::RoomError as TaskPlan does, and whatever a task throws.
template <PagedTask Task>
TaskReport<typename Task::Result> run_tasks(std::span<const std::byte> database, std::uint32_t count, const TaskOptions& options,
                                            const TaskWatching& watching = {}, std::stop_token stop = {}) {
  using Plain = TaskProgram<Pager, Task>;
  using Recording = TaskProgram<RecordingPager, Task>;
  const TaskPlan plan(options, database.size(), count, Plain::sizes());
  core::expect(watching.reference_logs == nullptr || watching.reference_logs->size() == plan.node_count(),
               "each node has a log of its references");
  const nodes::ByteSource source(database);
  const auto make = [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<AnyTaskProgram> {
    if (watching.reference_logs == nullptr) {
      return std::make_unique<Plain>(node, plan, source);
    }
    auto program = std::make_unique<Recording>(node, plan, source);
    program->records().record_into((*watching.reference_logs)[index]);
    return program;
  };
  TaskReport<typename Task::Result> report;
  report.results.resize(count);
  const auto take = [&](std::uint32_t index, std::span<const std::byte> results) {
    if (!results.empty()) {
      std::memcpy(report.results.data() + plan.first_task(index), results.data(), results.size());
    }
  };
  static_cast<TaskFigures&>(report) = run_task_programs(plan, options, make, watching, std::move(stop), take);
  return report;
}

}  // namespace dmpc::svm
