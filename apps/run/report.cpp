#include "apps/run/report.h"

#include <initializer_list>

#include "dataflow/packets.h"
#include "svm/forest/strategy.h"
#include "svm/packets.h"

namespace dmpc::apps {

namespace {

// Maps the strategies' different names.
std::uint64_t deposits_saturated(const svm::Report& report) { return report.host_deposits_saturated; }
std::uint64_t deposits_saturated(const dataflow::Report& report) { return report.host_rays.deposits_saturated; }
std::span<const char* const> kind_names(const svm::Report&) { return svm::kind_names; }
std::span<const char* const> kind_names(const dataflow::Report&) { return dataflow::kind_names; }

template <class Kind>
std::uint32_t bits_of(std::initializer_list<Kind> kinds) {
  std::uint32_t bits = 0;
  for (const Kind kind : kinds) {
    bits |= 1U << number_of(kind);
  }
  return bits;
}

WaitKinds svm_waits(bool asks) {
  using svm::Kind;
  return {.data = asks ? "answer" : "page",
          .data_kinds = asks ? bits_of({Kind::questions, Kind::answers}) : bits_of({Kind::page_reply}),
          .work_kinds = bits_of({Kind::work_request, Kind::work_reply, Kind::mask_part, Kind::begin_pass}),
          .film_kinds = bits_of({Kind::film_acknowledgement, Kind::mask_acknowledgement}),
          .end_kinds = bits_of({Kind::stop})};
}

WaitKinds dataflow_waits() {
  using dataflow::Kind;
  return {.data = "ray",
          .data_kinds = bits_of({Kind::rays, Kind::forwarded}),
          .work_kinds = bits_of({Kind::primaries, Kind::unit_refusal, Kind::unit_page, Kind::unit_primaries}),
          .token_kinds = bits_of({Kind::token}),
          .credit_kinds = bits_of({Kind::credits, Kind::overflow_taken, Kind::ask, Kind::unused}),
          .film_kinds = bits_of({Kind::film_acknowledgement}),
          .end_kinds = bits_of({Kind::finish, Kind::done, Kind::stop})};
}

WaitKinds waits_of(const svm::Report& report) { return svm_waits(report.plan.request.strategy == svm::forest_strategy()); }
WaitKinds waits_of(const dataflow::Report&) { return dataflow_waits(); }

template <class StrategyReport>
Account account_of_strategy(const StrategyReport& report) {
  Account account{.film = report.film,
                  .end = report.end,
                  .node_memory_max_bytes = report.plan.node_memory_max_bytes(),
                  .chaos = report.plan.request.computer.chaos,
                  .nodes = {},
                  .operations = report.operations(),
                  .host = report.host,
                  .host_deposits_saturated = deposits_saturated(report),
                  .sent = report.sent(),
                  .kind_names = kind_names(report),
                  .virtual_time = report.virtual_time,
                  .waits = waits_of(report),
                  .refinement = report.refinement,
                  .ranks = report.ranks};
  for (const auto& node : report.nodes) {
    account.nodes.push_back({node.program.operations, node.counters, node.memory_planned, node.memory_used});
  }
  return account;
}

void clear_own(svm::Report& report) {
  report.host_deposits_saturated = report.pixels_done = report.items_assigned = report.host_pages_served = 0;
}
void clear_own(dataflow::Report& report) {
  report.host_rays = {};
  for (dataflow::NodeReport& node : report.nodes) {
    node.primary_rays = 0;
  }
}

}  // namespace

WaitKinds wait_kinds(Strategy strategy) {
  return strategy == Strategy::dataflow ? dataflow_waits() : svm_waits(strategy == Strategy::forest);
}

Account account_of(const Report& report) {
  return std::visit([](const auto& of_strategy) { return account_of_strategy(of_strategy); }, report);
}

void clear_counters(Report& report) {
  const auto clear = [](auto& run) {
    clear_own(run);
    for (auto& node : run.nodes) {
      node.program = {};
      node.counters = {};
    }
    for (nodes::RankFigures& rank : run.ranks) {
      rank.traffic = {};
    }
    run.host = {};
    run.virtual_time.reset();
  };
  std::visit(clear, report);
}

TimeParts parts_of(const Account& account) { return parts_of(sum_of_nodes(*account.virtual_time), account.waits); }

}  // namespace dmpc::apps
