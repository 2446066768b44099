#include "apps/frontend/run/cache_forecast.h"

#include <algorithm>
#include <cmath>

#include "core/base/elementary.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t sizes_an_octave = 4;
constexpr double deviations = 2;  ///< half-width of a sample's interval, in standard deviations

/// In ascending order, each once.
std::vector<std::uint32_t> sizes_up_to(std::uint32_t least, std::uint32_t most, std::uint32_t own) {
  std::vector<std::uint32_t> sizes = {own};
  for (std::uint32_t i = 0;; ++i) {
    const double share = core::exponential(core::natural_log(2) * (i % sizes_an_octave) / sizes_an_octave);
    const auto size = static_cast<std::uint32_t>(static_cast<double>(std::uint64_t{1} << i / sizes_an_octave) * share + 0.5);
    if (size > most) {
      break;
    }
    if (size >= least) {
      sizes.push_back(size);
    }
  }
  std::sort(sizes.begin(), sizes.end());
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  return sizes;
}

/// What a run spent on something at each node, on average.
double mean_ns(const ForecastRun& run, TimePart part) {
  return static_cast<double>(run.parts.ns[static_cast<std::size_t>(part)]) / run.node_count;
}

/// What grows with the faults by each reading.
struct Readings {
  double all_ns;    ///< (A)
  double pages_ns;  ///< (B)
};

Readings readings_of(const ForecastRun& run) {
  return {run.total_ns() - mean_ns(run, TimePart::computing),
          mean_ns(run, TimePart::data_wait) + mean_ns(run, TimePart::service_busy) + mean_ns(run, TimePart::service_idle) +
              mean_ns(run, TimePart::messages)};
}

/// The error of a proportion of the curve, by half of the sample, as a share.
double half_error(const MissEstimate& misses, std::uint32_t size, std::uint32_t own) {
  const double whole = misses.misses(size) / misses.misses(own), own_half = misses.half_misses(own);
  return own_half == 0 || whole == 0 ? 1 : std::abs(misses.half_misses(size) / own_half / whole - 1);
}

/// By size: not less than nearer to the run's own.
std::vector<double> sample_errors(const MissEstimate& misses, const std::vector<std::uint32_t>& sizes, std::uint32_t own) {
  std::vector<double> errors(sizes.size(), 0.0);
  if (misses.every == 1) {
    return errors;
  }
  const auto at = static_cast<std::size_t>(std::find(sizes.begin(), sizes.end(), own) - sizes.begin());
  for (std::size_t i = at + 1; i < sizes.size(); ++i) {
    errors[i] = std::max(errors[i - 1], half_error(misses, sizes[i], own));
  }
  for (std::size_t i = at; i-- > 0;) {
    errors[i] = std::max(errors[i + 1], half_error(misses, sizes[i], own));
  }
  return errors;
}

/// With `low` to `high` times the faults.
TimeBand band_of(const ForecastRun& run, std::uint32_t size, double low, double high) {
  const Readings grows = readings_of(run);
  const auto with = [&](double grown_ns, double times) { return run.total_ns() + grown_ns * (times - 1); };
  return {.cache_pages = size,
          .faults = static_cast<double>(run.faults) * (low + high) / 2,
          .least_ns = std::min(with(grows.all_ns, low), with(grows.pages_ns, low)),
          .most_ns = std::max(with(grows.all_ns, high), with(grows.pages_ns, high))};
}

}  // namespace

CacheForecast forecast_caches(const ForecastRun& run, const MissEstimate& misses, std::uint32_t pages_max) {
  CacheForecast forecast{.run = run, .sizes = {}, .every = misses.every};
  const std::uint32_t least = misses.cache_pages_min() * (misses.every == 1 ? 1 : 2);  // half of the sample needs as many
  const double own = misses.misses(run.cache_pages);
  if (run.faults == 0 || run.parts.total_ns() == 0 || own == 0 || run.cache_pages < least) {
    return forecast;
  }
  forecast.curve_error = std::abs(own / static_cast<double>(run.faults) - 1);
  const std::vector<std::uint32_t> sizes = sizes_up_to(least, std::max(pages_max, run.cache_pages), run.cache_pages);
  const std::vector<double> errors = sample_errors(misses, sizes, run.cache_pages);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] == run.cache_pages) {
      forecast.sizes.push_back(band_of(run, sizes[i], 1, 1));
      continue;
    }
    const double to_own = misses.misses(sizes[i]) / own, to_faults = misses.misses(sizes[i]) / static_cast<double>(run.faults);
    const double error = deviations * errors[i];
    forecast.sizes.push_back(band_of(run, sizes[i], std::min(to_own, to_faults) * std::max(0.0, 1 - error),
                                     std::max(to_own, to_faults) * (1 + error)));
    forecast.sample_error = std::max(forecast.sample_error, error);
  }
  return forecast;
}

}  // namespace dmpc::apps
