// The primary rays of a node whose region moves, by unit, so that those that have not started migrate with it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "dataflow/packets.h"
#include "dataflow/regions/primary_run.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// They start in the order of the picture, for all units, as on all other nodes: so nodes have progressed equally far in
/// neighbouring rays, which meet. Thread safety: belongs to one node.
class UnitPrimaries {
  struct List;

 public:
  struct Capacity {
    std::size_t units = 0;  ///< maximum with rays at one time; 0: regions do not move, no rays
    std::size_t runs = 0;
  };

  /// Copies `runs`, unit by unit; unit u has runs_of_unit[u].
  UnitPrimaries(nodes::LocalMemory& memory, const Capacity& capacity, std::span<const PrimaryRun> runs,
                std::span<const std::uint32_t> runs_of_unit, const core::SampleRange& samples)
      : samples_(samples) {
    std::tie(runs_, lists_) = layout(capacity).in(memory);
    core::expect(runs.size() <= runs_.size(), "there is room for a node's own runs");
    std::copy(runs.begin(), runs.end(), runs_.begin());
    std::uint32_t first = 0;
    std::size_t next = 0;
    for (std::uint32_t unit = 0; unit < runs_of_unit.size(); ++unit) {
      if (const std::uint32_t count = runs_of_unit[unit]; count > 0) {
        core::expect(next < lists_.size() && first + count <= runs.size(), "a node's runs are those of its units");
        List& list = lists_[next++];
        list = {.unit = unit, .first = first, .count = count, .rays = 0};
        for (const PrimaryRun& run : runs.subspan(first, count)) {
          list.rays += run.count;
        }
        first += count;
        left_ += list.rays;
      }
    }
    core::expect(first == runs.size(), "every run is a unit's");
  }

  /// The memory that the constructor takes.
  static nodes::Layout<PrimaryRun, List> layout(const Capacity& capacity) {
    return {{nodes::Category::queues, capacity.runs}, {nodes::Category::queues, capacity.units}};
  }

  bool empty() const { return left_ == 0; }
  /// Number of rays.
  std::uint64_t left() const { return left_; }
  std::uint64_t left_of(std::uint32_t unit) const {
    const List* const list = find(unit);
    return list == nullptr ? 0 : list->rays;
  }

  std::size_t runs_of(std::uint32_t unit) const {
    const List* const list = find(unit);
    return list == nullptr ? 0 : list->count;
  }

  /// The number of runs that may be put here for one unit: 0 unless all rays that were here have started.
  std::size_t free_runs() const { return empty() ? runs_.size() : 0; }
  const core::SampleRange& samples() const { return samples_; }

  /// The number of the next ray to start. Requires that one is left.
  std::uint64_t take() {
    core::expect(!empty(), "a primary ray starts once");
    const auto next = [this](const List& list) { return list.count == 0 ? ~std::uint64_t{0} : runs_[list.first].first; };
    List& list = *std::min_element(lists_.begin(), lists_.end(), [&](const List& a, const List& b) { return next(a) < next(b); });
    PrimaryRun& run = runs_[list.first];
    const std::uint64_t number = run.first++;
    --run.count;
    --list.rays;
    --left_;
    if (run.count == 0) {
      ++list.first;
      --list.count;
    }
    return number;
  }

  /// The unit with most rays. Requires that one is left.
  std::uint32_t largest_unit() const {
    core::expect(!empty(), "a unit with primary rays is asked for where there is one");
    return std::max_element(lists_.begin(), lists_.end(), [](const List& a, const List& b) { return a.rays < b.rays; })->unit;
  }

  /// Removes and returns some of a unit's runs, as many as a packet holds, or none if there is none.
  AssignedPrimaries give(std::uint32_t unit) {
    AssignedPrimaries assigned{.samples = samples_};
    if (List* const list = find(unit)) {
      assigned.count = std::min(list->count, static_cast<std::uint32_t>(assigned.runs.size()));
      for (std::uint32_t i = 0; i < assigned.count; ++i) {
        assigned.runs[i] = runs_[list->first + i];
        list->rays -= assigned.runs[i].count;
        left_ -= assigned.runs[i].count;
      }
      list->first += assigned.count;
      list->count -= assigned.count;
    }
    return assigned;
  }

  /// Adds some of a unit's runs; there was memory for all of them before the first.
  void put(std::uint32_t unit, const AssignedPrimaries& assigned) {
    core::expect(assigned.count == 0 || assigned.samples == samples_, "primary rays go along in the pass that they are of");
    List& list = lists_.front();
    if (empty()) {
      list = {.unit = unit};
    }
    core::expect(list.unit == unit && list.first + list.count + assigned.count <= runs_.size(),
                 "runs come where there is room for all of their unit");
    for (std::uint32_t i = 0; i < assigned.count; ++i) {
      runs_[list.first + list.count] = assigned.runs[i];
      ++list.count;
      list.rays += assigned.runs[i].count;
      left_ += assigned.runs[i].count;
    }
  }

 private:
  struct List {
    std::uint32_t unit = 0;
    std::uint32_t first = 0, count = 0;  ///< range of runs
    std::uint64_t rays = 0;
  };
  /// Its list of rays; nullptr if it has none.
  List* find(std::uint32_t unit) const {
    const auto found =
        std::find_if(lists_.begin(), lists_.end(), [unit](const List& list) { return list.count > 0 && list.unit == unit; });
    return found == lists_.end() ? nullptr : &*found;
  }

  std::span<PrimaryRun> runs_;
  std::span<List> lists_;
  std::uint64_t left_ = 0;
  core::SampleRange samples_;
};

}  // namespace dmpc::dataflow
