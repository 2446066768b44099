// A page's forecast of a run's time with other cache sizes: a table and a plot, and the data that its script draws.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/run/cache_forecast.h"
#include "apps/frontend/show/page/page.h"
#include "apps/run/render_record.h"

namespace dmpc::apps::html {

/// A band of predicted times beside the measured run; of threads, whose times say nothing about a machine, of predicted faults.
struct ForecastView {
  bool is_of_time = true;         ///< else all times are numbers of faults
  std::uint32_t cache_pages = 0;  ///< the measured run's
  std::string why;                ///< explains the band's width: sentences
  std::vector<TimeBand> sizes;    ///< in ascending order
  double total_ns = 0;            ///< the measured run's
};

/// Returns the forecast of a finished run; nothing unless pages travel and references were recorded, or if no forecast can be
/// made from them.
std::optional<ForecastView> forecast_view(const RenderRecord& record);

/// Returns the scripts' data: {unit ("ns" or "faults"), cache, widest (share of a band that is not vague), why, points: [[pages,
/// faults, least_ns, most_ns]], runs: [[pages, ns]]}.
nlohmann::json json_of(const ForecastView& view);
/// Adds the forecast as a sentence, a table and an element in which a script draws it.
void add_forecast(Page& page, const ForecastView& view);

}  // namespace dmpc::apps::html
