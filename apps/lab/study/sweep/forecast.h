// Predicts the times of a sweep over cache sizes from one of its runs.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/sweep/measure.h"
#include "apps/lab/study/sweep/settings.h"
#include "apps/show/page/forecast_view.h"

namespace dmpc::apps {

/// Returns the index of the run of the middle size among those with enough memory; nothing unless --cache-pages alone varies, and
/// pages travel on a modelled machine.
std::optional<std::size_t> predicting_run(const SweepSettings& settings, const std::vector<SweepResult>& results);

/// Returns the prediction of that run's page, for which it is rendered once more, beside all runs; nothing if there is no such
/// run or no prediction. Throws as RenderProcesses::run().
std::optional<html::ForecastView> sweep_forecast(const SweepSettings& settings, const std::vector<SweepResult>& results,
                                                 const Interrupt& interrupt);

}  // namespace dmpc::apps
