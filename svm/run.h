// Renders a picture on N nodes: plans the memory, makes nodes and host, runs them on threads, and reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "nodes/computer_request.h"
#include "nodes/gathering.h"
#include "nodes/observers/meter.h"
#include "nodes/observers/watching.h"
#include "nodes/pictures/computer.h"
#include "nodes/runner.h"
#include "svm/local_copy.h"
#include "svm/page_options.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/plan.h"
#include "svm/program.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// Options of a run, without the database and the picture.
struct RunOptions {
  nodes::ComputerRequest computer = {};
  PageOptions pages = {};
  nodes::Watching watching = {};  ///< if it has a heat map of pages, these are counted, regardless of `pages`
  /// Where the picture is begun, and what of it is saved during the run. An interrupted run saves its state.
  core::Continuation continuation = {};
  bool tracer_is_own = false;  ///< run_replicated() with a tracer that has no bundles: rays are traced one by one
};

struct NodeReport : nodes::NodeFigures {
  ProgramReport program;
  ReferenceLog references = {};  ///< empty unless recorded
};

struct Report : pictures::Report<NodeReport> {
  Plan plan = {};
  std::uint64_t host_deposits_saturated = 0;  ///< pixels whose sums saturated on the host's film
  std::uint64_t pixels_done = 0;              ///< by this run, over all passes
  std::uint64_t items_assigned = 0;           ///< work items assigned by the host
  std::uint64_t host_pages_served = 0;        ///< replies of the host to requests for pages

  core::Operations operations() const { return summed(&ProgramReport::operations); }
  PageCounters pages() const { return summed(&ProgramReport::pages); }
  WorkCounters work() const { return summed(&ProgramReport::work); }
  QuestionCounters questions() const { return summed(&ProgramReport::questions); }
};

/// The plan of a run with these options, for messages before the run. Throws as make_plan() does.
Plan plan_of(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
             const RunOptions& options);

/// Renders. On ranks rank 0 calls it, and the others follow() (svm/ranks.h). Throws as make_plan() does before anything is
/// rendered; core::InternalError if a conservation law is broken. Several calls in a process are independent.
Report run_by(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
              const RunOptions& options, std::stop_token stop);
Report run_svm(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
               std::stop_token stop);
/// With our own grid.
Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop);

/// The specifications for `plan`: the nodes in order, then the host, which writes `film`. All arguments except `continuation`
/// outlive the runner.
std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const MakeProgram& make_program, core::Film& film,
                                                        const nodes::Progress& progress,
                                                        const core::Continuation& continuation = {});

/// The specifications if the host is elsewhere.
std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program);

/// To be called after a run, on all ranks: the reports of all nodes on the host's rank; on others those of their own nodes.
std::vector<NodeReport> gather_reports(nodes::Runner& runner, const Plan& plan);

/// Runs any programs of this family under `plan`, checks the conservation laws and reports.
Report run_programs(const Plan& plan, const MakeProgram& make_program, const RunOptions& options, std::stop_token stop);

/// Renders with strategy replicated and the caller's tracer, as in options.tracer_is_own: make_tracer(index, copy) returns node
/// `index`'s core::Tracer over its own copy of the database (a std::span<const std::byte>, overread_bytes more readable). It is
/// called before the start.
template <class MakeTracer>
Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop, const MakeTracer& make_tracer) {
  core::expect(options.tracer_is_own, "a run with a tracer of one's own says so");
  using Tracer = std::invoke_result_t<const MakeTracer&, std::uint32_t, std::span<const std::byte>>;
  Plan plan = plan_of(*replicated_strategy(), database, settings, options);
  const core::FineDetail detail = settings.fine_detail(database);
  plan.request.detail = &detail;
  const auto make_program = [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<NodeProgram> {
    const auto tracer_over = [&](LocalCopy& copy) { return make_tracer(index, copy.bytes()); };
    return std::make_unique<ControlProgram<LocalCopy, Tracer>>(node, plan, settings, database.bytes(), tracer_over,
                                                               nodes::meter_for(options.watching, options.computer, node.id()));
  };
  return run_programs(plan, make_program, options, std::move(stop));
}

}  // namespace dmpc::svm
