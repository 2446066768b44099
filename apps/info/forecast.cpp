#include "apps/info/forecast.h"

#include "apps/run/strategy_options.h"
#include "apps/system/stopwatch.h"
#include "dataflow/regions/mapping.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {

namespace {

template <class Plan>
MemoryForecast forecast_of(const Plan& plan, std::uint32_t node_count) {
  std::size_t all_bytes = plan.host_memory().total();
  for (std::uint32_t node = 0; node < node_count; ++node) {
    all_bytes += plan.node_memory(node).total();
  }
  return {smallest_node_memory_bytes(plan.request), plan.node_memory_max_bytes(), all_bytes};
}

class Forecaster {
 public:
  Forecaster(const core::Database& database, const core::RenderSettings& settings, const dataflow::BalanceOptions& balance)
      : database_(database),
        settings_(settings),
        balance_(balance),
        loads_(dataflow::column_loads(database, settings, balance)),
        region_seconds_(stopwatch_.lap()) {}

  ComputerForecast computer(std::uint32_t node_count) {
    ComputerForecast result{.nodes = node_count,
                            .svm = with_pages(svm::Strategy::svm, node_count),
                            .replicated = with_pages(svm::Strategy::replicated, node_count)};
    if (node_count <= dataflow::region_count_max) {
      add_rays(result);
    }
    return result;
  }
  double region_seconds() const { return region_seconds_; }

 private:
  MemoryForecast with_pages(svm::Strategy strategy, std::uint32_t node_count) const {
    return forecast_of(svm::plan_of(strategy, database_, settings_, {.computer = {.node_count = node_count}}), node_count);
  }

  /// From the loads known already; on their nodes, since some primary rays are dealt to nodes by number.
  dataflow::Bsp regions(std::uint32_t node_count) const {
    dataflow::Bsp bsp = dataflow::share_out(loads_, node_count, balance_).bsp;
    dataflow::map_onto(bsp, nodes::TopologyKind::hypercube, dataflow::axes_facing(settings_.camera));
    return bsp;
  }

  void add_rays(ComputerForecast& result) {
    stopwatch_.lap();
    dataflow::RunOptions run{.computer = {.node_count = result.nodes},
                             .rays = {.balance = {.balance = dataflow::Balance::equal_size}}};
    run.make_bsp = [&](std::uint32_t count) { return regions(count); };
    const dataflow::Prepared prepared = dataflow::prepare(database_, settings_, run, {}, false);
    result.dataflow = forecast_of(prepared.plan, result.nodes);
    result.dataflow_copies = prepared.duplication;
    region_seconds_ += stopwatch_.lap();
  }

  const core::Database& database_;
  const core::RenderSettings& settings_;
  const dataflow::BalanceOptions& balance_;
  Stopwatch stopwatch_;
  dataflow::ColumnLoads loads_;
  double region_seconds_;
};

}  // namespace

Forecast forecast(const core::Database& database, const core::RenderSettings& settings,
                  const std::vector<std::uint32_t>& node_counts, const dataflow::BalanceOptions& balance,
                  const ForecastProgress& progress) {
  Forecaster forecaster(database, settings, balance);
  Forecast result{.balance = balance.balance};
  for (const std::uint32_t node_count : node_counts) {
    result.computers.push_back(forecaster.computer(node_count));
    if (progress) {
      progress(result.computers.size(), node_counts.size());
    }
  }
  result.region_seconds = forecaster.region_seconds();
  return result;
}

}  // namespace dmpc::apps
