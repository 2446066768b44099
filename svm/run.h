// Renders a picture on N nodes: plans the memory, assembles nodes and host, runs them on threads, and reports.
#pragma once

#include <array>
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

#include "core/build/database.h"
#include "core/picture/film.h"
#include "core/picture/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "core/trace/traversal.h"
#include "nodes/chaos.h"
#include "nodes/counters.h"
#include "nodes/machine.h"
#include "nodes/runner.h"
#include "nodes/watch/heat_map.h"
#include "nodes/watch/meter.h"
#include "svm/host.h"
#include "svm/local_copy.h"
#include "svm/node_program.h"
#include "svm/plan.h"
#include "svm/program.h"
#include "svm/watch/reference_log.h"

namespace dmpc::svm {

/// What the user may choose; the fields of PlanRequest that the database and the picture do not give.
struct RunOptions {
  std::uint32_t node_count = 8;
  std::optional<std::size_t> node_memory_bytes = std::nullopt;
  std::optional<std::uint32_t> cache_pages = std::nullopt;
  Replacement replacement = Replacement::lru;
  std::optional<std::uint32_t> in_flight = std::nullopt;
  std::uint32_t work_item_side = 3;
  bool count_pages = false;
  /// Record every node's page references, run_svm() only: an instrument, whose memory is no node's and grows with the run. Needs
  /// work_item_side = 0 and in_flight = 1: else the references would depend on the cache and the schedule.
  bool record_references = false;
  std::size_t stack_reserve_bytes = std::size_t{256} << 10U;
  std::optional<nodes::Chaos> chaos = std::nullopt;  ///< disturbs the run; the film stays the same
  /// A modelled machine, in virtual time, in place of threads. Not with chaos.
  std::optional<nodes::Machine> machine = std::nullopt;
  Progress progress = {};  ///< called by the host's thread
  /// What each pixel takes is added to it, of the kinds that it records but `samples`; `pages` are then counted, whatever
  /// count_pages says. Of the size of the picture; outlives the run.
  nodes::HeatMap* heat = nullptr;
  nodes::Observer* observer = nullptr;  ///< sees the run happen; outlives it
  /// One for each node, where run_svm() notes what the node references, with an observer and unless different pages are counted,
  /// in whatever order it comes. Outlive the run.
  std::vector<ReferenceLog>* reference_logs = nullptr;
  /// Where the picture is begun, and what of it is kept on the way. An interrupted run keeps what it has.
  core::Continuation continuation = {};
  /// Called on the calling thread when the nodes hold the database, which is not read again, before any node starts.
  std::function<void()> distributed = {};

  /// What the nodes' meters are for. The options outlive it.
  nodes::Metering metering() const { return {heat, observer, machine ? &*machine : nullptr}; }
};

struct NodeReport {
  ProgramReport program;
  nodes::NodeCounters counters;
  nodes::MemoryPlan memory_planned, memory_used;
  ReferenceLog references = {};  ///< empty unless recorded
};

struct Report {
  core::Film film;
  nodes::RunEnd end = nodes::RunEnd::finished;  ///< interrupted: the film is not complete
  Plan plan;
  std::vector<NodeReport> nodes;
  nodes::NodeCounters host;
  std::optional<nodes::VirtualReport> virtual_time;  ///< of a modelled machine
  std::uint64_t host_deposits_saturated = 0;         ///< pixels whose sums saturated on the host's film
  std::uint64_t pixels_done = 0;                     ///< by this run, over all passes
  core::RefinementResult refinement;

  core::Operations operations() const;  ///< summed over the nodes
  PageCounters pages() const;
  WorkCounters work() const;
  /// Packets and bytes sent by all nodes and the host, by Kind's number.
  std::array<nodes::Traffic, nodes::packet_kind_count> sent() const;
};

/// The plan that a run with these options will follow, for messages before the run. Throws as make_plan() does.
Plan plan_of(Strategy strategy, const core::Database& database, const core::RenderSettings& settings, const RunOptions& options);

/// Renders with strategy svm. Throws as make_plan() does before anything is rendered; core::InternalError if a law of
/// conservation is broken. One call at a time in a process needs no care; several are independent.
Report run_svm(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
               std::stop_token stop);

/// Makes the program of node `index`; called before the start, in order, on the calling thread.
using MakeProgram = std::function<std::unique_ptr<NodeProgram>(std::uint32_t index, nodes::Node& node)>;

/// What a runner needs for `plan`: the nodes in order, then the host, which writes `film`. All arguments but `continuation`
/// outlive the runner.
std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const MakeProgram& make_program, core::Film& film,
                                                        const Progress& progress, const core::Continuation& continuation = {});

/// The program of a node with a meter.
template <class Records, class Tracer, class MakeTracer>
std::unique_ptr<NodeProgram> make_metered_program(nodes::Node& node, const Plan& plan, const core::RenderSettings& settings,
                                                  std::span<const std::byte> database, const MakeTracer& make_tracer,
                                                  const nodes::Metering& metering) {
  using Metered = ControlProgram<Records, Tracer, core::PixelTask, nodes::Meter>;
  return std::make_unique<Metered>(node, plan, settings, database, make_tracer, nodes::Meter(metering, node.id()));
}

/// The program of a node: with a meter if one is asked for, without any trace of one if not. `options` outlives it.
template <class Records, class Tracer, class MakeTracer>
std::unique_ptr<NodeProgram> make_control_program(nodes::Node& node, const Plan& plan, const core::RenderSettings& settings,
                                                  std::span<const std::byte> database, const MakeTracer& make_tracer,
                                                  const RunOptions& options) {
  if (options.metering().is_wanted()) {
    return make_metered_program<Records, Tracer>(node, plan, settings, database, make_tracer, options.metering());
  }
  return std::make_unique<ControlProgram<Records, Tracer>>(node, plan, settings, database, make_tracer);
}

/// Runs any programs of this family under `plan`, checks the laws of conservation and reports.
Report run_programs(const Plan& plan, const MakeProgram& make_program, const RunOptions& options, std::stop_token stop);

/// Renders with strategy replicated and a tracer of one's own: make_tracer(index, copy) returns node `index`'s core::Tracer
/// over its own copy of the database (a std::span<const std::byte>, overread_bytes more readable). It is called before the
/// start.
template <class MakeTracer>
Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop, const MakeTracer& make_tracer) {
  using Tracer = std::invoke_result_t<const MakeTracer&, std::uint32_t, std::span<const std::byte>>;
  const Plan plan = plan_of(Strategy::replicated, database, settings, options);
  const auto make_program = [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<NodeProgram> {
    const auto tracer_over = [&](LocalCopy& copy) { return make_tracer(index, copy.bytes()); };
    return make_control_program<LocalCopy, Tracer>(node, plan, settings, database.bytes(), tracer_over, options);
  };
  return run_programs(plan, make_program, options, std::move(stop));
}

/// Renders with strategy replicated and our own grid.
Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop);

}  // namespace dmpc::svm
