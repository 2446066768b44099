#include "apps/run/run_strategy.h"

#include <memory>
#include <utility>

#include "apps/line/number_text.h"
#include "apps/machine/machine_file.h"
#include "apps/oracle/oracle.h"
#include "apps/run/option_words.h"
#include "apps/system/memory_room.h"
#include "core/base/expect.h"
#include "core/record/records.h"

namespace dmpc::apps {

namespace {

/// A node of a modelled machine waits for its page, as those of the 1994 paper did.
std::optional<std::uint32_t> in_flight(const StrategyOptions& options) {
  const bool is_modelled = options.computer.machine.has_value();
  return is_modelled && !options.pages.in_flight ? 1 : options.pages.in_flight;
}

svm::RunOptions svm_options(const StrategyOptions& options) {
  return {.node_count = options.computer.node_count,
          .node_memory_bytes = options.computer.node_memory_bytes,
          .cache_pages = options.pages.cache_pages,
          .replacement = options.pages.replacement,
          .in_flight = in_flight(options),
          .work_item_side = options.pages.work_item_side,
          .count_pages = options.pages.count_pages,
          .chaos = options.computer.chaos,
          .machine = options.computer.machine};
}

dataflow::RunOptions dataflow_options(const StrategyOptions& options) {
  return {.node_count = options.computer.node_count,
          .node_memory_bytes = options.computer.node_memory_bytes,
          .ray_batch = options.rays.ray_batch,
          .ray_credits = options.rays.ray_credits,
          .queue_packets = options.rays.queue_packets,
          .balance = options.rays.balance,
          .topology = options.rays.topology,
          .chaos = options.computer.chaos,
          .machine = options.computer.machine};
}

svm::Report run_with_embree(const core::Database& database, const core::RenderSettings& settings, const svm::RunOptions& run,
                            std::stop_token stop) {
  const EmbreeScene scene(database.primitives(), EmbreeMode::robust);
  const std::vector<core::Database::Place> places = database.find_places();
  return svm::run_replicated(database, settings, run, std::move(stop), [&](std::uint32_t, std::span<const std::byte> copy) {
    return EmbreeTracer(scene, places, core::LocalRecords(copy));
  });
}

/// `run`: the options of any strategy.
template <class RunOptions>
void tie(RunOptions& run, const RunTies& ties) {
  run.heat = ties.heat;
  run.observer = ties.observer;
  run.continuation = ties.continuation;
}

/// The nodes' memories are touched before a run begins.
template <class Plan>
void check_room(const Plan& plan, std::uint32_t node_count) {
  std::uint64_t bytes = plan.host_memory().total();
  for (std::uint32_t node = 0; node < node_count; ++node) {
    bytes += plan.node_memory(node).total();
  }
  check_memory_room(bytes, counted(node_count, "node") + " and the host");
}

/// svm and replicated.
ReadyRun ready_with_pages(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                          const RunTies& ties) {
  const bool paged = options.strategy == Strategy::svm, by_embree = options.tracer == TracerChoice::embree;
  svm::RunOptions run = svm_options(options);
  run.distributed = ties.distributed;
  run.reference_logs = ties.reference_logs;
  tie(run, ties);
  const auto start = [&database, &settings, run, paged, by_embree](const RunProgress& progress, std::stop_token stop) -> Report {
    svm::RunOptions watched = run;
    watched.progress = progress;
    if (by_embree) {
      return run_with_embree(database, settings, watched, std::move(stop));
    }
    return paged ? svm::run_svm(database, settings, watched, std::move(stop))
                 : svm::run_replicated(database, settings, watched, std::move(stop));
  };
  const auto strategy = paged ? svm::Strategy::svm : svm::Strategy::replicated;
  const svm::Plan plan = with_options_named([&] { return svm::plan_of(strategy, database, settings, run); });
  check_room(plan, run.node_count);
  return {plan.notes, start};
}

ReadyRun ready_with_rays(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                         const std::stop_token& stop, const RunTies& ties) {
  dataflow::RunOptions run = dataflow_options(options);
  tie(run, ties);
  const auto prepared =
      std::make_shared<dataflow::Prepared>(with_options_named([&] { return dataflow::prepare(database, settings, run, stop); }));
  check_room(prepared->plan, run.node_count);
  if (ties.distributed) {
    ties.distributed();
    run.distributed = [prepared] { prepared->distribution.forget_records(); };
  }
  const auto start = [&settings, run, prepared](const RunProgress& progress, std::stop_token stop_run) -> Report {
    dataflow::RunOptions watched = run;
    watched.progress = progress;
    return dataflow::run_prepared(*prepared, settings, watched, std::move(stop_run));
  };
  return {prepared->plan.notes, start};
}

}  // namespace

void choose_machine(StrategyOptions& options, const nodes::Machine& machine) {
  options.computer.runner = RunnerKind::virtual_time;
  options.computer.machine = machine;
  options.rays.topology = machine.topology;
}

void choose_machine(StrategyOptions& options) {
  if (options.computer.runner == RunnerKind::threads) {
    return;
  }
  nodes::Machine machine = load_machine(options.computer.machine_name).machine;
  const ComputerOptions& computer = options.computer;
  if (computer.memory_port && !machine.has_contention) {
    throw core::UsageError("--memory-port does not go with --machine=" + computer.machine_name +
                           ", whose has_contention is false: without contention no message waits for a port");
  }
  machine.has_contention = machine.has_contention && !computer.no_contention;
  machine.has_memory_port = machine.has_contention && (machine.has_memory_port || computer.memory_port);
  choose_machine(options, machine);
}

ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop, const RunTies& ties) {
  core::expect(options.computer.machine.has_value() == (options.computer.runner == RunnerKind::virtual_time),
               "a modelled machine has been read");
  return options.strategy == Strategy::dataflow ? ready_with_rays(options, database, settings, stop, ties)
                                                : ready_with_pages(options, database, settings, ties);
}

}  // namespace dmpc::apps
