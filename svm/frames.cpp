#include "svm/frames.h"

#include <memory>
#include <utility>

#include "core/base/expect.h"
#include "nodes/gathering.h"
#include "nodes/ranks/heartbeats.h"
#include "svm/host.h"
#include "svm/packets.h"
#include "svm/ranks.h"
#include "svm/resident.h"

namespace dmpc::svm {
namespace {

std::uint64_t packets_of(const nodes::TrafficByKind& traffic, Kind kind) { return traffic[number_of(kind)].packets; }

/// Requests for pages, passed on or not.
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
  core::expect(work.items_given + report.items_assigned == work.items_taken, "every work item given was taken");
  core::expect(work.pixels_rendered == report.pixels_done, "every pixel was rendered once a pass");
  core::expect(packets_of(report.sent(), Kind::film_sums) == packets_of(report.host.received, Kind::film_sums),
               "every film packet sent was received");
  report.plan.request.strategy->check_conservation(report);
  nodes::expect_nothing_lost(report.ranks);
}

/// Serving a page, or passing on its request, installs no page and runs no pixel, so a node may be interrupted for it at any
/// time. The set of cached pages changes only between quanta; serving a page marks it as used, like any look-up.
constexpr std::uint32_t interrupt_kinds = 1U << number_of(Kind::page_request) | 1U << number_of(Kind::passed_request);

/// The pages that every node keeps permanently.
std::vector<PageId> resident_pages(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                                   nodes::RankLinks* ranks, const std::stop_token& stop) {
  const auto find = [&] { return most_used_pages(database, settings, plan.resident_count, stop); };
  return ranks == nullptr || plan.resident_count == 0 ? find() : nodes::with_heartbeats(*ranks, find);
}

}  // namespace

std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program) {
  std::vector<nodes::NodeSpecification> all =
      pictures::specifications_without_host(plan, make_program, plan.batching(), interrupt_kinds);
  all.back().interrupt_kinds =
      are_at_host(plan.request.pages.homes) ? interrupt_kinds : 0;  // its service costs as much as a node's
  return all;
}

std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const MakeProgram& make_program, core::Film& film,
                                                        const nodes::Progress& progress, const core::Continuation& continuation) {
  std::vector<nodes::NodeSpecification> specifications = specifications_without_host(plan, make_program);
  specifications.back().make_program = [&plan, &film, &progress, continuation](nodes::Node& node) {
    return std::make_unique<HostProgram>(node, plan, film, progress, continuation);
  };
  return specifications;
}

std::vector<NodeReport> gather_reports(nodes::Runner& runner, const Plan& plan) {
  std::vector<NodeReport> reports;
  nodes::gather_nodes(
      runner, plan.request.computer.node_count,
      [&](std::size_t index, nodes::FlatWriter& reported) {
        reported.put(dynamic_cast<const NodeProgram&>(runner.program(index)).report());
        reported.put(nodes::figures_of(runner.node(index)));
      },
      [&](std::size_t, nodes::FlatReader& reported) {
        const auto program = reported.take<ProgramReport>();
        reports.push_back({{reported.take<nodes::NodeFigures>()}, program});
      });
  return reports;
}

PictureComputer::PictureComputer(const Plan& plan, const MakeProgram& make_program, const RunOptions& options)
    : plan_(plan),
      computer_(
          pictures::film_of(plan.request, plan.request.film_scale, plan.request.start),
          [&](core::Film& film) {
            return specifications_of(plan, make_program, film, options.watching.progress, options.continuation);
          },
          options.computer, options.watching),
      before_(plan.node_count()) {
  if (options.watching.distributed && options.computer.immutable() == nodes::Immutable::is_copied) {
    options.watching.distributed();
  }
}

void PictureComputer::begin_frame(const core::RenderSettings& settings, const core::FineDetail* detail) {
  computer_.begin_frame(pictures::film_of(plan_.request, plan_.request.film_scale), settings, detail);
}

Report PictureComputer::render(std::stop_token stop) {
  std::vector<NodeReport> gathered;
  pictures::Outcome outcome =
      computer_.render(std::move(stop), plan_, [&] { gathered = gather_reports(computer_.runner(), plan_); });
  Report report{{std::move(outcome), std::move(gathered)}, plan_};
  report.plan.request.detail = nullptr;  // like the database, it belongs to the run
  report.plan.request.database = {};
  report.plan.own_policy = nullptr;
  for (std::size_t i = 0; i < report.nodes.size(); ++i) {
    const ProgramReport counted = report.nodes[i].program;
    report.nodes[i].program = core::counts_since(counted, before_[i]);
    before_[i] = counted;
  }
  const auto& host = dynamic_cast<const HostProgram&>(computer_.host());
  report.host_deposits_saturated = host.deposits_saturated();
  report.pixels_done = host.pixels_done();
  report.items_assigned = host.items_given();
  report.host_pages_served = host.pages_served();
  if (report.end == nodes::RunEnd::finished) {
    check_conservation(report);
  }
  return report;
}

Frames::Frames(const Strategy& strategy, const core::Database& database, const core::RenderSettings& first,
               const RunOptions& options, const std::stop_token& stop, bool are_several)
    : database_(database),
      options_(options),
      settings_(first),
      detail_(first.fine_detail(database)),
      plan_(plan_of(strategy, database, first, options)),
      bytes_(database.bytes()),
      recorded_(options.pages.record_references ? plan_.request.computer.node_count : 0) {
  plan_.request.detail = &detail_;
  plan_.request.database = database.bytes();
  nodes::RankLinks* const ranks = options.computer.ranks;
  plan_.resident = resident_pages(database, first, plan_, ranks, stop);
  if (ranks != nullptr) {
    hand_out(plan_, first, database, options.watching.elsewhere.order, are_several, *ranks);
  }
  std::vector<ReferenceLog>* const logs = recorded_.empty() ? options.pages.reference_logs : &recorded_;
  if (const OwnPolicy* const own = options.pages.own_policy) {
    own_policy_ = own->start();
    plan_.own_policy = own_policy_.get();
  }
  maker_ = strategy.maker(plan_, settings_, bytes_, options_.watching, logs);
}

Report Frames::render(const core::RenderSettings& settings, std::stop_token stop) {
  settings_ = settings;
  if (!computer_) {
    computer_.emplace(plan_, maker_, options_);
  } else {
    detail_ = settings.fine_detail(database_);
    computer_->begin_frame(settings_, &detail_);
  }
  Report report = computer_->render(std::move(stop));
  if (own_policy_ && report.end == nodes::RunEnd::finished) {
    own_policy_->finish();
  }
  for (std::size_t i = 0; i < recorded_.size(); ++i) {
    report.nodes[i].references = std::exchange(recorded_[i], {});
  }
  return report;
}

}  // namespace dmpc::svm
