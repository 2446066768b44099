#include "svm/run.h"

#include <memory>
#include <string>

#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "nodes/gathering.h"
#include "nodes/ranks/life_signs.h"
#include "svm/host.h"
#include "svm/ranks.h"
#include "svm/resident.h"

namespace dmpc::svm {
namespace {

/// A heat map of pages has them counted.
PageOptions pages_of(const RunOptions& options) {
  const nodes::HeatMap* const heat = options.watching.heat;
  PageOptions pages = options.pages;
  pages.count_pages = pages.count_pages || (heat != nullptr && heat->has(core::HeatKind::pages));
  return pages;
}

/// What is counted for single pixels, and references in the order of single rays, need rays that walk alone; and the nodes of a
/// modelled machine compute as those of the article did.
bool walks_in_bundles(const RunOptions& options) {
  return !options.tracer_is_own && !options.computer.machine && !options.watching.is_metered() &&
         !pages_of(options).count_pages && !options.pages.record_references && options.pages.reference_logs == nullptr;
}

PlanRequest request_of(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
                       const RunOptions& options) {
  return {.strategy = &strategy,
          .page_count = static_cast<std::uint32_t>(database.page_count()),
          .forest_page_count = static_cast<std::uint32_t>(database.forest_page_count()),
          .page_size_bytes = database.page_size(),
          .computer = options.computer,
          .pages = pages_of(options),
          .waiting_hits_max = core::waiting_hits_max(settings.shade),
          .width = static_cast<std::uint32_t>(settings.camera.width()),
          .height = static_cast<std::uint32_t>(settings.camera.height()),
          .first_samples = settings.first_samples().count,
          .refinement = settings.refinement,
          .film_scale = settings.shade.film_scale,
          .start = options.continuation.start,
          .bundles = settings.skips.bundles && strategy.takes_bundles() && walks_in_bundles(options)};
}

std::uint64_t packets_of(const nodes::TrafficByKind& traffic, Kind kind) { return traffic[number_of(kind)].packets; }

/// For pages, passed on or not.
std::uint64_t requests_received(const nodes::NodeCounters& counters) {
  return packets_of(counters.received, Kind::page_request) + packets_of(counters.received, Kind::passed_request);
}

void check_conservation(const NodeReport& report) {
  const ProgramReport& program = report.program;
  const nodes::NodeCounters& counters = report.counters;
  core::expect(program.operations.ray_count() == program.rays_ended, "every ray shot has ended");
  core::expect(program.pages.faults == packets_of(counters.sent, Kind::page_request), "every fault was requested, once");
  core::expect(program.pages.faults == packets_of(counters.received, Kind::page_reply), "every page request was replied to");
  core::expect(program.pages.served + packets_of(counters.sent, Kind::passed_request) == requests_received(counters),
               "every page request was served, or passed on");
  core::expect(program.work.items_asked == packets_of(counters.received, Kind::work_reply), "every work request was answered");
  core::expect(packets_of(counters.sent, Kind::film_sums) == packets_of(counters.received, Kind::film_acknowledgement),
               "every film packet was acknowledged");
}

void check_conservation(const Report& report) {
  for (const NodeReport& node : report.nodes) {
    check_conservation(node);
  }
  const PageCounters pages = report.pages();
  core::expect(pages.references == pages.home_hits + pages.cache_hits + pages.misses && pages.misses >= pages.faults,
               "every reference was a page hit or a page miss");
  core::expect(report.host_pages_served == requests_received(report.host), "every page request to the host was served");
  core::expect(pages.faults == pages.served + report.host_pages_served, "every fault was served, by a node or the host");
  const WorkCounters work = report.work();
  core::expect(work.items_given + report.items_dealt == work.items_taken, "every work item given was taken");
  core::expect(work.pixels_rendered == report.pixels_done, "every pixel was rendered once a pass");
  core::expect(packets_of(report.sent(), Kind::film_sums) == packets_of(report.host.received, Kind::film_sums),
               "every film packet sent was received");
  report.plan.request.strategy->check_conservation(report);
  nodes::expect_nothing_lost(report.ranks);
}

/// Serving a page, or passing the request for it on, installs none and runs no pixel: a node may be interrupted for it at any
/// time. Which pages its cache has changes between quanta alone; serving one marks it as used, like any look-up.
constexpr std::uint32_t interrupt_kinds = 1U << number_of(Kind::page_request) | 1U << number_of(Kind::passed_request);

/// Notes what each node references where that is recorded: it becomes a part of the node's report.
Report run_as_planned(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                      const RunOptions& options, std::stop_token stop) {
  std::vector<ReferenceLog> recorded(options.pages.record_references ? plan.request.computer.node_count : 0);
  std::vector<ReferenceLog>* const logs = recorded.empty() ? options.pages.reference_logs : &recorded;
  const nodes::ByteSource bytes(database.bytes());  // what makers are given outlives them
  const MakeProgram maker = plan.request.strategy->maker(plan, settings, bytes, options.watching, logs);
  Report report = run_programs(plan, maker, options, std::move(stop));
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    report.nodes[i].references = std::move(recorded[i]);
  }
  return report;
}

/// Those that every node keeps for good.
std::vector<PageId> resident_pages(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                                   nodes::RankLinks* ranks, const std::stop_token& stop) {
  const auto find = [&] { return most_used_pages(database, settings, plan.resident_count, stop); };
  return ranks == nullptr || plan.resident_count == 0 ? find() : nodes::with_life_signs(*ranks, find);
}

}  // namespace

nodes::TrafficByKind Report::sent() const {
  nodes::TrafficByKind sum = core::total_of(nodes, [](const NodeReport& node) { return node.counters.sent; });
  return core::add_counts(sum, host.sent);
}

Plan plan_of(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
             const RunOptions& options) {
  return make_plan(request_of(strategy, database, settings, options));
}

std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program) {
  std::vector<nodes::NodeSpecification> specifications;
  const bool is_host_home = are_at_host(plan.request.pages.homes);  // whose service then costs what a node's would
  for (std::uint32_t i = 0; i < plan.request.computer.node_count; ++i) {
    specifications.push_back({plan.node_memory(i), plan.node_mailbox,
                              [&make_program, i](nodes::Node& node) { return make_program(i, node); }, plan.held_bytes,
                              interrupt_kinds, plan.patience()});
  }
  specifications.push_back(
      {plan.host_memory(), plan.host_mailbox, {}, plan.held_bytes, is_host_home ? interrupt_kinds : std::uint32_t{0}});
  return specifications;
}

std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const MakeProgram& make_program, core::Film& film,
                                                        const nodes::Progress& progress, const core::Continuation& continuation) {
  std::vector<nodes::NodeSpecification> specifications = specifications_without_host(plan, make_program);
  specifications.back().make_program = [&plan, &film, &progress, continuation](nodes::Node& node) {
    return std::make_unique<HostProgram>(node, plan.host(), film, progress, continuation);
  };
  return specifications;
}

std::vector<NodeReport> gather_reports(nodes::Runner& runner, const Plan& plan) {
  std::vector<NodeReport> reports;
  nodes::gather_nodes(
      runner, plan.request.computer.node_count,
      [&](std::size_t index, nodes::FlatWriter& told) {
        told.put(dynamic_cast<const NodeProgram&>(runner.program(index)).report());
        told.put(nodes::figures_of(runner.node(index)));
      },
      [&](std::size_t, nodes::FlatReader& told) {
        const auto program = told.take<ProgramReport>();
        reports.push_back({{told.take<nodes::NodeFigures>()}, program});
      });
  return reports;
}

Report run_programs(const Plan& plan, const MakeProgram& make_program, const RunOptions& options, std::stop_token stop) {
  const core::PartialPicture* const start = plan.request.start;
  Report report{.film = start != nullptr ? start->film
                                         : core::Film(static_cast<int>(plan.request.width), static_cast<int>(plan.request.height),
                                                      plan.request.film_scale, core::planes_for(plan.request.first_samples)),
                .end = nodes::RunEnd::finished,
                .plan = plan,
                .nodes = {},
                .host = {}};
  report.plan.request.detail = nullptr;  // it is the run's, and so is the database
  report.plan.request.database = {};
  core::expect(options.watching.heat == nullptr || options.watching.heat->item_count() == report.film.pixel_count(),
               "a heat map is of the picture's size");
  const auto runner =
      nodes::make_runner(specifications_of(plan, make_program, report.film, options.watching.progress, options.continuation),
                         options.computer, options.watching.observer);
  if (options.watching.distributed && !options.computer.machine) {  // whose nodes refer to the database
    options.watching.distributed();
  }
  report.end = runner->run(std::move(stop));
  const std::uint32_t host_index = plan.request.computer.node_count;
  report.nodes = gather_reports(*runner, plan);
  report.ranks = nodes::gather_rank_figures(*runner, plan, options.computer.ranks, options.watching.elsewhere.adds());
  report.host = runner->node(host_index).counters();
  const auto& host = dynamic_cast<const HostProgram&>(runner->program(host_index));
  report.host_deposits_saturated = host.deposits_saturated();
  report.pixels_done = host.pixels_done();
  report.items_dealt = host.items_given();
  report.host_pages_served = host.pages_served();
  report.refinement = host.refinement().result();
  if (report.end == nodes::RunEnd::finished) {
    check_conservation(report);
    report.virtual_time = runner->virtual_report();
  } else {
    host.keep();
  }
  return report;
}

Report run_by(const Strategy& strategy, const core::Database& database, const core::RenderSettings& settings,
              const RunOptions& options, std::stop_token stop) {
  Plan plan = plan_of(strategy, database, settings, options);
  const core::FineDetail detail = settings.fine_detail(database);
  plan.request.detail = &detail;
  plan.request.database = database.bytes();
  nodes::RankLinks* const ranks = options.computer.ranks;
  plan.resident = resident_pages(database, settings, plan, ranks, stop);
  if (ranks != nullptr) {
    hand_out(plan, settings, database, options.watching.elsewhere.order, *ranks);
  }
  return run_as_planned(database, settings, plan, options, std::move(stop));
}

Report run_svm(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
               std::stop_token stop) {
  return run_by(*svm_strategy(), database, settings, options, std::move(stop));
}

Report run_replicated(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                      std::stop_token stop) {
  return run_by(*replicated_strategy(), database, settings, options, std::move(stop));
}

}  // namespace dmpc::svm
