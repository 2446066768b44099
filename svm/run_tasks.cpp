#include "svm/run_tasks.h"

#include <memory>
#include <utility>

#include "core/base/expect.h"
#include "svm/packets.h"
#include "svm/task_program.h"

namespace dmpc::svm {
namespace {

/// Makes the program of node `index`.
using MakeTaskProgram = std::function<std::unique_ptr<AnyTaskProgram>(std::uint32_t index, nodes::Node& node)>;

class IdleHost final : public nodes::Program {
 public:
  void receive(const nodes::Packet& /*packet*/) override { core::expect(false, "nobody sends the host anything"); }
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return "nothing to do"; }
};

template <class Records>
std::unique_ptr<TaskProgram<Records>> make_task_program(nodes::Node& node, const TaskPlan& plan,
                                                        const nodes::ByteSource& database, const TaskKind<Records>& kind,
                                                        TaskHeat* heat) {
  auto program = std::make_unique<TaskProgram<Records>>(node, plan, database, kind);
  if (heat != nullptr) {
    program->note_heat(TaskMeter(*heat, nodes::index_of(node.id())));
  }
  return program;
}

std::vector<nodes::NodeSpecification> task_specifications(const TaskPlan& plan, const MakeTaskProgram& make) {
  std::vector<nodes::NodeSpecification> all;
  for (std::uint32_t index = 0; index < plan.node_count(); ++index) {
    all.push_back({.plan = plan.node_memory(index),
                   .mailbox = plan.mailbox(),
                   .make_program = [&make, index](nodes::Node& node) { return make(index, node); },
                   .held_bytes = plan.held_bytes(),
                   .interrupt_kinds = 1U << number_of(Kind::page_request)});  // as in svm/run.cpp: serving changes no pages
  }
  all.push_back({.plan = plan.host_memory(),
                 .mailbox = {},
                 .make_program = [](nodes::Node&) { return std::make_unique<IdleHost>(); },
                 .held_bytes = plan.held_bytes()});
  return all;
}

void check_pages(const TaskFigures& figures) {
  const PageCounters pages = figures.all_pages();
  core::expect(pages.references == pages.home_hits + pages.cache_hits + pages.misses && pages.misses >= pages.faults,
               "every reference was a page hit or a page miss");
  core::expect(pages.faults == pages.served, "every fault was served");
}

}  // namespace

PageCounters TaskFigures::all_pages() const {
  PageCounters sum;
  for (const PageCounters& node : pages) {
    sum += node;
  }
  return sum;
}

TaskFigures run_tasks_of_kind(const TaskKinds& kinds, std::span<const std::byte> database, std::uint32_t count,
                              const TaskOptions& options, const TaskWatching& watching, std::stop_token stop,
                              const TakeResults& take) {
  const TaskPlan plan(options, database.size(), count, kinds.plain.sizes);
  core::expect(watching.reference_logs == nullptr || watching.reference_logs->size() == plan.node_count(),
               "each node has a log of its references");
  core::expect(watching.heat == nullptr || watching.heat->size() == count, "each task has a place for what it takes");
  const nodes::ByteSource source(database);
  const auto make = [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<AnyTaskProgram> {
    if (watching.reference_logs == nullptr) {
      return make_task_program(node, plan, source, kinds.plain, watching.heat);
    }
    auto program = make_task_program(node, plan, source, kinds.recording, watching.heat);
    program->records().record_into((*watching.reference_logs)[index]);
    return program;
  };
  const auto runner = nodes::make_runner(task_specifications(plan, make), options.computer, watching.observer);
  TaskFigures figures;
  figures.end = runner->run(std::move(stop));
  for (std::uint32_t index = 0; index < plan.node_count(); ++index) {
    const auto& program = dynamic_cast<const AnyTaskProgram&>(runner->program(index));
    figures.pages.push_back(program.report().pages);
    figures.counters.push_back(runner->node(index).counters());
    figures.charges.push_back(program.charges());
    take(plan.first_task(index), program.results());
  }
  if (figures.end == nodes::RunEnd::finished) {
    check_pages(figures);
    figures.virtual_time = runner->virtual_report();
  }
  return figures;
}

}  // namespace dmpc::svm
