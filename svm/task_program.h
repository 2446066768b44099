// The node program of tasks that read pages and are no pixels: graphs, tables, whatever does not fit one memory.
//
// As with pixels (svm/program.h): requests are served in receive(), whatever a node's own state, and a page that arrives runs
// every task that waited for it before the next packet is looked at. So a task that reads one record after another goes on with a
// cache of one page, and the last node always moves.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "core/base/expect.h"
#include "core/picture/pixel_task.h"
#include "nodes/node.h"
#include "svm/node_program.h"
#include "svm/packets.h"
#include "svm/pager.h"
#include "svm/task_plan.h"

namespace dmpc::svm {

/// A task: a value without pointers of its own, made again and again. start(number) makes it that one of all; run() reads records
/// by records.find() and answers `more` after a bounded time, `finished`, or `absent` if find() had nothing: then absent() is the
/// address, and run() is called again when it is there, and asks for it again. What it does beside look-ups it adds to the
/// charges. result() is asked for once it is finished.
template <class Task>
concept PagedTask = std::default_initializable<Task> && std::is_trivially_copyable_v<Task> &&
    std::default_initializable<typename Task::Result> && std::is_trivially_copyable_v<typename Task::Result> &&
    requires(Task task, const Task& finished, Pager& records, nodes::Charges& charges, std::uint32_t number) {
  task.start(number);
  { task.run(records, charges) } -> std::same_as<core::TaskState>;
  { finished.absent() } -> std::same_as<core::Address>;
  { finished.result() } -> std::same_as<typename Task::Result>;
};

/// What a task's program tells, whatever the task.
class AnyTaskProgram : public NodeProgram {
 public:
  /// In bytes; of each task of the node, in order.
  virtual std::span<const std::byte> results() const = 0;
};

/// `Records` is Pager or RecordingPager.
template <class Records, PagedTask Task>
class TaskProgram final : public AnyTaskProgram {
  using Result = typename Task::Result;

  /// A task under way.
  struct Place {
    Task task;
    std::uint32_t number = 0;
  };

 public:
  TaskProgram(nodes::Node& node, const TaskPlan& plan, const nodes::ByteSource& database)
      : records_(node, plan.pages(), database),
        next_(plan.first_task(nodes::index_of(node.id()))),
        first_(next_),
        tasks_(node.memory().allocate<Place>(nodes::Category::ray_stacks, plan.in_flight())),
        runnable_(node.memory().allocate<std::uint32_t>(nodes::Category::queues, plan.in_flight())),
        free_(node.memory().allocate<std::uint32_t>(nodes::Category::queues, plan.in_flight())),
        results_(node.memory().allocate<Result>(nodes::Category::film_tiles, plan.tasks_at(nodes::index_of(node.id())))) {
    for (std::uint32_t place = 0; place < free_.size(); ++place) {
      free_[free_count_++] = static_cast<std::uint32_t>(free_.size()) - 1 - place;
    }
  }

  /// What a plan is to know of it.
  static constexpr TaskPlan::Sizes sizes() { return {.task_bytes = sizeof(Place), .result_bytes = sizeof(Result)}; }
  Records& records() { return records_; }

  void receive(const nodes::Packet& packet) override {
    if (packet.kind == number_of(Kind::page_request)) {
      return records_.serve(packet);
    }
    core::expect(packet.kind == number_of(Kind::page_reply), "a node is asked for pages, and gets those that it asked for");
    for (std::uint32_t place = records_.install(packet); place != no_slot;) {
      const std::uint32_t next = records_.next_waiting(place);
      records_.retried();
      run(place);
      place = next;
    }
  }

  bool work() override {
    if (runnable_count_ == 0 && can_start()) {
      start();
    }
    if (runnable_count_ > 0) {
      run(runnable_[--runnable_count_]);
    }
    return runnable_count_ > 0 || can_start();
  }

  bool finished() const override { return done_ == results_.size(); }

  nodes::Charges charges() const override {
    nodes::Charges charges = charges_;
    const PageCounters pages = records_.counters();
    charges[nodes::Charge::home_lookup] += pages.home_hits;
    charges[nodes::Charge::cached_lookup] += pages.references - pages.home_hits;
    charges[nodes::Charge::page_install] += pages.faults - records_.faults();
    return charges;
  }

  nodes::Levels levels() const override {
    return {{"pages in cache", records_.cached_pages()}, {"pages awaited", records_.faults()}, {"tasks done", done_}};
  }

  std::string describe() const override {
    return std::to_string(done_) + " of " + std::to_string(results_.size()) + " tasks done, " +
           std::to_string(records_.faults()) + " pages awaited";
  }

  ProgramReport report() const override { return {.operations = {}, .pages = records_.counters(), .work = {}}; }
  std::span<const std::byte> results() const override { return std::as_bytes(results_); }

 private:
  bool can_start() const { return free_count_ > 0 && next_ - first_ < results_.size(); }

  void start() {
    const std::uint32_t place = free_[--free_count_];
    tasks_[place].number = next_++;
    tasks_[place].task.start(tasks_[place].number);
    runnable_[runnable_count_++] = place;
  }

  void run(std::uint32_t place) {
    Task& task = tasks_[place].task;
    switch (task.run(records_, charges_)) {
      case core::TaskState::more:
        runnable_[runnable_count_++] = place;
        return;
      case core::TaskState::absent:
        return records_.park(place, task.absent());
      case core::TaskState::finished:
        results_[tasks_[place].number - first_] = task.result();
        free_[free_count_++] = place;
        ++done_;
        return;
    }
  }

  Records records_;
  std::uint32_t next_, first_;  ///< tasks of this node: the next to start, and the first of all
  std::uint32_t done_ = 0;
  std::span<Place> tasks_;
  std::span<std::uint32_t> runnable_, free_;
  std::uint32_t runnable_count_ = 0, free_count_ = 0;
  std::span<Result> results_;
  nodes::Charges charges_;
};

}  // namespace dmpc::svm
