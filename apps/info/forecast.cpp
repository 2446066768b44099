#include "apps/info/forecast.h"

#include "apps/frontend/system/stopwatch.h"
#include "apps/run/strategy_options.h"
#include "dataflow/regions/mapping.h"
#include "dataflow/run.h"
#include "svm/forest/strategy.h"
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
  Forecaster(const core::Database& database, const core::RenderSettings& settings, const dataflow::BalanceOptions& balance,
             const svm::PageOptions& pages)
      : database_(database),
        settings_(settings),
        balance_(balance),
        pages_(pages),
        loads_(dataflow::column_loads(database, settings, balance)),
        region_seconds_(stopwatch_.lap()) {}

  void add(std::uint32_t node_count) {
    computers_.push_back({.nodes = node_count,
                          .svm = with_pages(*svm::svm_strategy(), node_count),
                          .replicated = with_pages(*svm::replicated_strategy(), node_count)});
    if (database_.forest_page_count() > 0) {
      computers_.back().forest = with_pages(*svm::forest_strategy(), node_count);
    }
    if (can_share_out(node_count)) {
      stopwatch_.lap();
      partitions_.push_back(regions(node_count));
      parts_.push_back(dataflow::measure_parts(database_, settings_, partitions_.back()));
      region_seconds_ += stopwatch_.lap();
    }
  }

  /// Returns the results of all computers. All primary rays are assigned at once.
  Forecast result() {
    stopwatch_.lap();
    const auto shares = dataflow::measure_shares(settings_, partitions_, parts_, {}, true, request_for({}).pixel_order());
    std::size_t next = 0;
    for (ComputerForecast& computer : computers_) {
      if (can_share_out(computer.nodes)) {
        computer.dataflow = with_rays(shares[next]);
        computer.dataflow_copies = parts_[next].duplication;
        ++next;
      }
    }
    return {.computers = computers_,
            .balance = balance_.balance,
            .cuts = balance_.bsp.order,
            .regions_a_node = balance_.has_several_regions() ? balance_.regions_a_node : 1,
            .homes = pages_.homes,
            .region_seconds = region_seconds_ + stopwatch_.lap()};
  }

 private:
  MemoryForecast with_pages(const svm::Strategy& strategy, std::uint32_t node_count) const {
    svm::RunOptions options{.computer = {.node_count = node_count}};
    if (strategy.fetches_pages()) {
      options.pages = pages_;
    }
    return forecast_of(svm::plan_of(strategy, database_, settings_, options), node_count);
  }
  MemoryForecast with_rays(const std::vector<dataflow::Share>& shares) const {
    return forecast_of(dataflow::make_plan(request_for(shares)), static_cast<std::uint32_t>(shares.size()));
  }
  dataflow::PlanRequest request_for(const std::vector<dataflow::Share>& shares) const {
    return dataflow::plan_request(shares, settings_, {.rays = {.balance = balance_}});
  }

  bool can_share_out(std::uint32_t node_count) const { return dataflow::can_share_out(loads_.lattice, node_count, balance_); }
  /// Returns the regions for the known loads, on their nodes, since some primary rays are assigned to nodes by number.
  dataflow::Regions regions(std::uint32_t node_count) const {
    dataflow::Regions regions = dataflow::share_out(loads_, node_count, balance_).regions;
    if (dataflow::Bsp* const bsp = regions.bsp()) {
      dataflow::map_onto(*bsp, nodes::TopologyKind::hypercube, dataflow::axes_facing(settings_.camera));
    }
    return regions;
  }

  const core::Database& database_;
  const core::RenderSettings& settings_;
  const dataflow::BalanceOptions& balance_;
  const svm::PageOptions& pages_;
  Stopwatch stopwatch_;
  dataflow::ColumnLoads loads_;
  double region_seconds_;
  std::vector<ComputerForecast> computers_;
  std::vector<dataflow::Regions> partitions_;   ///< for the computers on which dataflow continues
  std::vector<dataflow::MeasuredParts> parts_;  ///< likewise
};

}  // namespace

Forecast forecast(const core::Database& database, const core::RenderSettings& settings,
                  const std::vector<std::uint32_t>& node_counts, const dataflow::BalanceOptions& balance,
                  const ForecastProgress& progress, const svm::PageOptions& pages) {
  Forecaster forecaster(database, settings, balance, pages);
  std::uint64_t done = 0;
  for (const std::uint32_t node_count : node_counts) {
    forecaster.add(node_count);
    if (progress) {
      progress(++done, node_counts.size());
    }
  }
  return forecaster.result();
}

}  // namespace dmpc::apps
