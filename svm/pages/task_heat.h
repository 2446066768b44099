// The costs of each task: an instrument outside of the computer, whose memory is no node's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/expect.h"
#include "nodes/charge.h"
#include "nodes/flat_bytes.h"
#include "svm/pages/node_program.h"

namespace dmpc::svm {

/// The costs of one task. Over all tasks of a node they add up to the node's counters.
struct TaskTaken {
  std::uint32_t node = 0;        ///< the node that ran it
  std::uint64_t steps = 0;       ///< its calls, including those in which its page was absent
  std::uint64_t references = 0;  ///< look-ups of a page, each counted once
  std::uint64_t faults = 0;      ///< requests for pages that it started
  nodes::Charges charges = {};   ///< an arriving page is charged to its first waiter
};

/// By task. Thread safety: each task belongs to one node; read when none runs.
using TaskHeat = std::vector<TaskTaken>;

/// Serialises the costs of the tasks that ran here, for add_heat() on another rank.
inline void put_heat(nodes::FlatWriter& flat, const TaskHeat& heat) {
  const auto is_here = [](const TaskTaken& taken) { return taken.steps > 0; };
  flat.put(static_cast<std::uint64_t>(std::count_if(heat.begin(), heat.end(), is_here)));
  for (std::uint32_t task = 0; task < heat.size(); ++task) {
    if (is_here(heat[task])) {
      flat.put(task);
      flat.put(heat[task]);
    }
  }
}
inline void add_heat(nodes::FlatReader& flat, TaskHeat& heat) {
  for (auto left = flat.take<std::uint64_t>(); left > 0; --left) {
    const auto task = flat.take<std::uint32_t>();
    core::expect(task < heat.size() && heat[task].steps == 0, "a task runs on one rank");
    heat[task] = flat.take<TaskTaken>();
  }
}

/// One node's meter: attributes what it counts from one step to the end of the next to the task of that step. Thread safety:
/// belongs to the node.
class TaskMeter {
 public:
  /// `heat` outlives the meter.
  TaskMeter(TaskHeat& heat, std::uint32_t node) : heat_(&heat), node_(node) {}

  /// Takes the node's counts since the start, at the end of a step of `task`.
  void stepped(std::uint32_t task, const PageCounters& pages, const nodes::Charges& charges) {
    TaskTaken& taken = (*heat_)[task];
    taken.node = node_;
    ++taken.steps;
    taken.references += pages.references - pages_.references;
    taken.faults += pages.faults - pages_.faults;
    for (std::size_t i = 0; i < nodes::charge_count; ++i) {
      taken.charges.count[i] += charges.count[i] - charges_.count[i];
    }
    pages_ = pages;
    charges_ = charges;
  }

 private:
  TaskHeat* heat_;
  std::uint32_t node_;
  PageCounters pages_;
  nodes::Charges charges_;
};

}  // namespace dmpc::svm
