#include "apps/run/run_strategy.h"

#include <memory>
#include <optional>
#include <utility>

#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/run/computer_capacity.h"
#include "apps/frontend/run/option_words.h"
#include "apps/oracle/oracle.h"
#include "apps/policy/foreign_policy.h"
#include "apps/run/strategy_rows.h"
#include "core/base/expect.h"
#include "core/record/records.h"
#include "dataflow/frames.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_memory.h"
#include "svm/frames.h"

namespace dmpc::apps {

namespace {

svm::Report run_with_embree(const core::Database& database, const core::RenderSettings& settings, const svm::RunOptions& run,
                            std::stop_token stop) {
  const EmbreeScene scene(database.primitives(), EmbreeMode::robust);
  const std::vector<core::Database::Place> places = database.find_places();
  return svm::run_replicated(database, settings, run, std::move(stop), [&](std::uint32_t, std::span<const std::byte> copy) {
    return EmbreeTracer(scene, places, database.header().frame, core::LocalRecords(copy));
  });
}

/// On rank 0 if there are several; the other ranks check for themselves.
template <class Plan>
void check_room_for(const Plan& plan) {
  check_room(nodes::rank_memory(nodes::peers_of(plan), plan.request.computer.ranks, 0));
}

/// Returns the largest network memory of a rank.
template <class Plan>
nodes::NetworkMemory network_memory_max(const Plan& plan, const nodes::RankLinks& links) {
  nodes::NetworkMemory most;
  for (std::uint32_t rank = 0; rank < links.rank_count(); ++rank) {
    const nodes::NetworkMemory network = nodes::rank_memory(nodes::peers_of(plan), &links, rank).network;
    most = network.total() > most.total() ? network : most;
  }
  return most;
}

/// Returns the plan's memory plus each rank's own.
template <class Plan>
std::vector<std::string> notes_of(const Plan& plan) {
  std::vector<std::string> notes = plan.notes;
  const nodes::RankLinks* const links = plan.request.computer.ranks;
  if (links != nullptr && links->rank_count() > 1) {
    notes.push_back(std::to_string(links->rank_count()) + " ranks, each with its nodes' memories and up to " +
                    network_text(network_memory_max(plan, *links)));
  }
  return notes;
}

/// For svm, replicated and forest.
ReadyRun ready_with_pages(const svm::Strategy& strategy, const StrategyOptions& options, const core::Database& database,
                          const core::RenderSettings& settings, const nodes::Watching& watching,
                          const core::Continuation& continuation) {
  const bool by_embree = options.tracer == TracerChoice::embree;
  svm::RunOptions run{.computer = options.computer, .pages = options.pages, .watching = watching, .continuation = continuation};
  run.tracer_is_own = by_embree;
  const auto frames = std::make_shared<std::optional<svm::Frames>>();
  const bool are_several = options.has_several_frames;
  const auto start = [&database, &settings, &strategy, run, by_embree, are_several, frames](const nodes::Progress& progress,
                                                                                            std::stop_token stop) -> Report {
    svm::RunOptions watched = run;
    watched.watching.progress = progress;
    if (by_embree) {
      return run_with_embree(database, settings, watched, std::move(stop));
    }
    if (!are_several) {
      return svm::run_by(strategy, database, settings, watched, std::move(stop));
    }
    return frames->emplace(strategy, database, settings, watched, stop).render(settings, stop);
  };
  const auto go_on = [frames](const core::RenderSettings& next, std::stop_token stop) -> Report {
    return (*frames)->render(next, std::move(stop));
  };
  const svm::Plan plan = with_options_named(strategy_words(), [&] { return svm::plan_of(strategy, database, settings, run); });
  check_room_for(plan);
  return {notes_of(plan), start, go_on};
}

ReadyRun ready_with_rays(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                         const std::stop_token& stop, const nodes::Watching& watching, const core::Continuation& continuation) {
  dataflow::RunOptions run{
      .computer = options.computer, .rays = options.rays, .watching = watching, .continuation = continuation};
  run.are_frames = options.has_several_frames;
  const auto prepared = std::make_shared<dataflow::Prepared>(
      with_options_named(strategy_words(), [&] { return dataflow::prepare(database, settings, run, stop); }));
  check_room_for(prepared->plan);
  if (watching.distributed) {
    watching.distributed();
    run.watching.distributed = [prepared] { prepared->distribution.forget_records(); };
  }
  const auto frames = std::make_shared<std::optional<dataflow::Frames>>();
  const auto start = [&settings, run, prepared, frames](const nodes::Progress& progress, std::stop_token stop_run) -> Report {
    dataflow::RunOptions watched = run;
    watched.watching.progress = progress;
    if (!run.are_frames) {
      return dataflow::run_prepared(*prepared, settings, watched, std::move(stop_run));
    }
    return frames->emplace(*prepared, settings, watched, stop_run).render(std::move(stop_run));
  };
  const auto go_on = [&database, prepared, frames](const core::RenderSettings& next, std::stop_token stop_run) -> Report {
    return (*frames)->render(next, next.fine_detail(database), std::move(stop_run));
  };
  return {notes_of(prepared->plan), start, go_on};
}

}  // namespace

void choose_machine(StrategyOptions& options, const nodes::Machine& machine) {
  options.runner.kind = RunnerKind::virtual_time;
  options.computer.machine = machine;
  options.rays.topology = machine.topology;
}

void choose_machine(StrategyOptions& options) {
  if (options.runner.kind != RunnerKind::virtual_time) {
    return;
  }
  choose_machine(options, load_machine(options.runner.machine_name).machine);
}

void load_policy(StrategyOptions& options, const std::function<void()>& check) {
  if (!options.policy_place.empty()) {
    options.policy = std::make_shared<ForeignPolicy>("--replacement", options.policy_place, check);
    options.pages.own_policy = options.policy.get();
  }
}

ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop, const nodes::Watching& watching, const core::Continuation& continuation) {
  core::expect(options.computer.machine.has_value() == (options.runner.kind == RunnerKind::virtual_time),
               "a modelled machine has been read");
  core::expect((options.pages.own_policy == nullptr) == options.policy_place.empty(), "a policy of the user's has been loaded");
  const svm::Strategy* const with_pages = page_strategy(options.strategy);
  return with_pages != nullptr ? ready_with_pages(*with_pages, options, database, settings, watching, continuation)
                               : ready_with_rays(options, database, settings, stop, watching, continuation);
}

}  // namespace dmpc::apps
