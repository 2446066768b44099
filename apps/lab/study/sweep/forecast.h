// How long the runs of a sweep over sizes of caches would take by one of them alone.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/sweep/measure.h"
#include "apps/lab/study/sweep/settings.h"
#include "apps/show/page/forecast_view.h"

namespace dmpc::apps {

/// The run of the middle size among those that found room, by its number: nothing unless --cache-pages alone varies, and pages
/// travel on a modelled machine.
std::optional<std::size_t> predicting_run(const SweepSettings& settings, const std::vector<SweepResult>& results);

/// What that run's page predicts, for which it is rendered once more, beside all runs. Nothing if there is no such run, or
/// nothing can be told from it. Throws as RenderProcesses::run().
std::optional<html::ForecastView> sweep_forecast(const SweepSettings& settings, const std::vector<SweepResult>& results,
                                                 const Interrupt& interrupt);

}  // namespace dmpc::apps
