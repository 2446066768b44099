#include "apps/report.h"

#include "dataflow/packets.h"
#include "svm/packets.h"

namespace dmpc::apps {

namespace {

// Where the strategies call one thing by different names.
std::uint64_t deposits_saturated(const svm::Report& report) { return report.host_deposits_saturated; }
std::uint64_t deposits_saturated(const dataflow::Report& report) { return report.host_rays.deposits_saturated; }
std::span<const char* const> kind_names(const svm::Report&) { return svm::kind_names; }
std::span<const char* const> kind_names(const dataflow::Report&) { return dataflow::kind_names; }

template <class StrategyReport>
Account account_of_strategy(const StrategyReport& report) {
  Account account{.film = report.film,
                  .end = report.end,
                  .node_memory_max_bytes = report.plan.node_memory_max_bytes(),
                  .chaos = report.plan.request.chaos,
                  .nodes = {},
                  .operations = report.operations(),
                  .host = report.host,
                  .host_deposits_saturated = deposits_saturated(report),
                  .sent = report.sent(),
                  .kind_names = kind_names(report)};
  for (const auto& node : report.nodes) {
    account.nodes.push_back({node.program.operations, node.counters, node.memory_planned, node.memory_used});
  }
  return account;
}

}  // namespace

Account account_of(const Report& report) {
  return std::visit([](const auto& of_strategy) { return account_of_strategy(of_strategy); }, report);
}

}  // namespace dmpc::apps
