#include "svm/pages/run_tasks.h"

#include <memory>

#include "core/base/counts.h"
#include "core/base/expect.h"
#include "nodes/gathering.h"
#include "nodes/program.h"
#include "nodes/ranks/rank_memory.h"
#include "svm/pages/packets.h"
#include "svm/pages/task_program.h"

namespace dmpc::svm {
namespace {

/// Makes the program of node `index`.
using MakeTaskProgram = std::function<std::unique_ptr<AnyTaskProgram>(std::uint32_t index, nodes::Node& node)>;

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
                 .make_program = [](nodes::Node&) { return std::make_unique<nodes::IdleProgram>(); },
                 .held_bytes = plan.held_bytes()});
  return all;
}

/// Gathers the results of the local nodes and, on rank 0, of all.
void gather_tasks(nodes::Runner& runner, const TaskPlan& plan, const TakeResults& take, TaskFigures& figures) {
  nodes::gather_nodes(
      runner, plan.node_count(),
      [&](std::size_t index, nodes::FlatWriter& reported) {
        const auto& program = dynamic_cast<const AnyTaskProgram&>(runner.program(index));
        const std::span<const std::byte> results = program.results();
        reported.put(program.report().pages);
        reported.put(runner.node(index).counters());
        reported.put(program.charges());
        reported.put_bytes({reinterpret_cast<const char*>(results.data()), results.size()});
      },
      [&](std::uint32_t index, nodes::FlatReader& reported) {
        figures.pages[index] = reported.take<PageCounters>();
        figures.counters[index] = reported.take<nodes::NodeCounters>();
        figures.charges[index] = reported.take<nodes::Charges>();
        take(plan.first_task(index), reported.take_bytes());
      });
}

void run_and_gather(nodes::Runner& runner, const TaskPlan& plan, std::stop_token stop, const TakeResults& take,
                    TaskFigures& figures) {
  figures.end = runner.run(std::move(stop));
  if (figures.end == nodes::RunEnd::finished) {
    gather_tasks(runner, plan, take, figures);
    figures.virtual_time = runner.virtual_report();
  }
}

void check_pages(const TaskFigures& figures) {
  const PageCounters pages = figures.all_pages();
  core::expect(pages.references == pages.home_hits + pages.cache_hits + pages.misses && pages.misses >= pages.faults,
               "every reference was a page hit or a page miss");
  core::expect(pages.faults == pages.served, "every fault was served");
}

}  // namespace

PageCounters TaskFigures::all_pages() const { return core::total_of(pages, std::identity()); }

TaskFigures run_tasks_of_kind(const TaskKinds& kinds, const TaskPlan& plan, std::span<const std::byte> database,
                              const TaskWatching& watching, std::stop_token stop, const TakeResults& take) {
  core::expect(watching.reference_logs == nullptr || watching.reference_logs->size() == plan.node_count(),
               "each node has a log of its references");
  core::expect(watching.heat == nullptr || watching.heat->size() == plan.first_task(plan.node_count()),
               "each task has a place for what it takes");
  const nodes::ByteSource source(database);
  const MakeTaskProgram make = [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<AnyTaskProgram> {
    if (watching.reference_logs == nullptr) {
      return make_task_program(node, plan, source, kinds.plain, watching.heat);
    }
    auto program = make_task_program(node, plan, source, kinds.recording, watching.heat);
    program->records().record_into((*watching.reference_logs)[index]);
    return program;
  };
  const std::vector<nodes::NodeSpecification> specifications = task_specifications(plan, make);
  const auto runner = nodes::make_runner(specifications, plan.computer(), watching.observer);
  const nodes::RankLinks* const links = plan.computer().ranks;
  TaskFigures figures{.pages = std::vector<PageCounters>(plan.node_count()),
                      .counters = std::vector<nodes::NodeCounters>(plan.node_count()),
                      .charges = std::vector<nodes::Charges>(plan.node_count())};
  if (links == nullptr) {
    run_and_gather(*runner, plan, std::move(stop), take, figures);
  } else {
    watching.communicate([&] {
      run_and_gather(*runner, plan, std::move(stop), take, figures);
      if (figures.end == nodes::RunEnd::finished) {
        figures.ranks = nodes::gather_rank_figures(*runner, specifications, links, watching.add, watching.seen);
        nodes::expect_nothing_lost(figures.ranks);
      }
    });
  }
  if (figures.end == nodes::RunEnd::finished && (links == nullptr || links->rank() == 0)) {
    check_pages(figures);
  }
  return figures;
}

}  // namespace dmpc::svm
