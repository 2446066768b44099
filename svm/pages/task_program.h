// The node program of tasks that read pages and are no pixels: graphs, tables, anything that does not fit one memory.
//
// As with pixels (svm/program.h): requests are served in receive(), regardless of the node's state, and a page that arrives runs
// every task that waited for it before the next packet is handled. So a task that reads one record after another proceeds with a
// cache of one page, and the last node always makes progress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/expect.h"
#include "core/trace/task_state.h"
#include "nodes/node.h"
#include "svm/pages/node_program.h"
#include "svm/pages/task_heat.h"
#include "svm/pages/task_kind.h"
#include "svm/pages/task_plan.h"

namespace dmpc::svm {

/// The results of a program of any tasks.
class AnyTaskProgram : public NodeProgram {
 public:
  /// In bytes; for each task of the node, in order.
  virtual std::span<const std::byte> results() const = 0;
};

/// `Records` is Pager or RecordingPager.
template <class Records>
class TaskProgram final : public AnyTaskProgram {
 public:
  /// `kind`, which outlives this, is the plan's.
  TaskProgram(nodes::Node& node, const TaskPlan& plan, const nodes::ByteSource& database, const TaskKind<Records>& kind)
      : records_(node, plan.pages(), database),
        kind_(kind),
        next_(plan.first_task(nodes::index_of(node.id()))),
        first_(next_),
        count_(plan.tasks_at(nodes::index_of(node.id()))) {
    std::tie(tasks_, numbers_, runnable_, free_, results_) = plan.program_layout(nodes::index_of(node.id())).in(node.memory());
    for (std::uint32_t place = 0; place < free_.size(); ++place) {
      free_[free_count_++] = static_cast<std::uint32_t>(free_.size()) - 1 - place;
    }
  }

  Records& records() { return records_; }
  /// Records the costs of each task from now on. To be called before the start, if at all.
  void note_heat(TaskMeter meter) { meter_ = meter; }

  void receive(const nodes::Packet& packet) override {
    const bool is_about_pages = records_.receive(packet, *this);
    core::expect(is_about_pages, "a node is asked for pages, and gets those that it asked for");
  }

  bool work() override {
    if (runnable_count_ == 0 && can_start()) {
      start();
    }
    if (runnable_count_ > 0) {
      go_on(runnable_[--runnable_count_]);
    }
    return runnable_count_ > 0 || can_start();
  }

  bool finished() const override { return done_ == count_; }

  nodes::Charges charges() const override {
    nodes::Charges charges = charges_;
    records_.add_charges(charges);
    return charges;
  }

  nodes::Levels levels() const override {
    nodes::Levels levels = records_.levels();
    levels.add({"tasks done", done_});
    return levels;
  }

  std::string describe() const override {
    return std::to_string(done_) + " of " + std::to_string(count_) + " tasks done, " + std::to_string(records_.faults()) +
           " pages awaited";
  }

  ProgramReport report() const override { return {.operations = {}, .pages = records_.counters(), .work = {}}; }
  std::span<const std::byte> results() const override { return results_; }

  /// Runs a step of the task there, and records its costs. Called by records that have what the task has waited for.
  void go_on(std::uint32_t place) {
    step(place);
    if (meter_) {
      meter_->stepped(numbers_[place], records_.counters(), charges());
    }
  }

 private:
  bool can_start() const { return free_count_ > 0 && next_ - first_ < count_; }

  void start() {
    const std::uint32_t place = free_[--free_count_];
    numbers_[place] = next_++;
    kind_.start(task_at(place), numbers_[place]);
    runnable_[runnable_count_++] = place;
  }

  void step(std::uint32_t place) {
    core::Address absent = core::no_address;
    switch (kind_.run(task_at(place), records_, charges_, absent)) {
      case core::TaskState::more:
        runnable_[runnable_count_++] = place;
        return;
      case core::TaskState::absent:
        return records_.park(place, absent);
      case core::TaskState::finished:
        kind_.put_result(task_at(place), &results_[(numbers_[place] - first_) * kind_.sizes.result_bytes]);
        free_[free_count_++] = place;
        ++done_;
        return;
    }
  }

  std::byte* task_at(std::uint32_t place) const { return &tasks_[place * kind_.sizes.task_bytes]; }

  Records records_;
  const TaskKind<Records>& kind_;
  std::uint32_t next_, first_, count_;  ///< tasks of this node: the next to start, the first, and their number
  std::uint32_t done_ = 0;
  std::span<std::byte> tasks_;        ///< in flight
  std::span<std::uint32_t> numbers_;  ///< task number, by slot
  std::span<std::uint32_t> runnable_, free_;
  std::uint32_t runnable_count_ = 0, free_count_ = 0;
  std::span<std::byte> results_;
  nodes::Charges charges_;
  std::optional<TaskMeter> meter_;
};

}  // namespace dmpc::svm
