#include "svm/picture_computer.h"

#include <memory>
#include <utility>

#include "core/base/expect.h"
#include "nodes/gathering.h"
#include "svm/host.h"
#include "svm/packets.h"

namespace dmpc::svm {
namespace {

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

core::Film film_of(const PlanRequest& request) {
  return request.start != nullptr ? request.start->film
                                  : core::Film(static_cast<int>(request.width), static_cast<int>(request.height),
                                               request.film_scale, core::planes_for(request.first_samples));
}

}  // namespace

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

PictureComputer::PictureComputer(const Plan& plan, const MakeProgram& make_program, const RunOptions& options)
    : plan_(plan),
      options_(options),
      film_(film_of(plan.request)),
      runner_(nodes::make_runner(specifications_of(plan_, make_program, film_, options_.watching.progress, options_.continuation),
                                 options_.computer, options_.watching.observer)),
      before_(plan.request.computer.node_count) {
  core::expect(options_.watching.heat == nullptr || options_.watching.heat->item_count() == film_.pixel_count(),
               "a heat map is of the picture's size");
  if (options_.watching.distributed && !options_.computer.machine) {  // whose nodes refer to the database
    options_.watching.distributed();
  }
}

PictureComputer::~PictureComputer() = default;

void PictureComputer::begin_frame(const core::RenderSettings& settings, const core::FineDetail* detail) {
  PlanRequest request = plan_.request;
  request.start = nullptr;
  film_ = film_of(request);
  for (std::uint32_t i = 0; i < before_.size(); ++i) {
    if (runner_->is_here(i)) {
      dynamic_cast<PictureProgram&>(runner_->program(i)).begin_frame(settings);
    }
  }
  dynamic_cast<HostProgram&>(runner_->program(before_.size())).begin_frame(detail);
}

Report PictureComputer::render(std::stop_token stop) {
  const nodes::RunEnd end = runner_->run(std::move(stop));
  const std::uint32_t host_index = plan_.request.computer.node_count;
  const auto& host = dynamic_cast<const HostProgram&>(runner_->program(host_index));
  if (end != nodes::RunEnd::finished) {
    host.keep();
  }
  Report report{.film = std::move(film_), .end = end, .plan = plan_, .nodes = gather_reports(*runner_, plan_), .host = {}};
  report.plan.request.detail = nullptr;  // it is the run's, and so is the database
  report.plan.request.database = {};
  for (std::size_t i = 0; i < report.nodes.size(); ++i) {
    const ProgramReport counted = report.nodes[i].program;
    report.nodes[i].program = core::counts_since(counted, before_[i]);
    before_[i] = counted;
  }
  report.ranks = nodes::gather_rank_figures(*runner_, plan_, options_.computer.ranks, options_.watching.elsewhere.adds());
  report.host = runner_->node(host_index).counters();
  report.host_deposits_saturated = host.deposits_saturated();
  report.pixels_done = host.pixels_done();
  report.items_dealt = host.items_given();
  report.host_pages_served = host.pages_served();
  report.refinement = host.refinement().result();
  if (end == nodes::RunEnd::finished) {
    check_conservation(report);
    report.virtual_time = runner_->virtual_report();
  }
  return report;
}

}  // namespace dmpc::svm
