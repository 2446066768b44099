#include "apps/frontend/run/cache_forecast.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace dmpc::apps::cache_forecast_test {

namespace {

/// Pages 0 to count - 1 round and round: with fewer frames than pages every reference misses, else only the first of each.
MissEstimate cycle(std::uint32_t count, std::uint32_t rounds) {
  std::vector<svm::PageId> pages;
  for (std::uint32_t i = 0; i < count * rounds; ++i) {
    pages.push_back(svm::PageId{i % count});
  }
  return {.curve = svm::MissCurve(pages)};
}

/// One node: 100 ns, of which it computed 40, waited 30 for pages, took 10 for messages, and idled 20 at the end.
ForecastRun run_of_100_ns(std::uint32_t cache_pages, std::uint64_t faults) {
  ForecastRun run{.parts = {}, .cache_pages = cache_pages, .faults = faults};
  const auto set = [&run](TimePart part, std::uint64_t ns) { run.parts.ns[static_cast<std::size_t>(part)] = ns; };
  set(TimePart::computing, 40);
  set(TimePart::data_wait, 30);
  set(TimePart::messages, 10);
  set(TimePart::idle_at_end, 20);
  return run;
}

const TimeBand& with(const CacheForecast& forecast, std::uint32_t cache_pages) {
  return *std::find_if(forecast.sizes.begin(), forecast.sizes.end(),
                       [cache_pages](const TimeBand& size) { return size.cache_pages == cache_pages; });
}

}  // namespace

TEST_CASE("with half the faults half of all that is no computing is left by one reading, half of what pages take by the other") {
  const CacheForecast forecast = forecast_caches(run_of_100_ns(4, 16), cycle(8, 2), 16);
  const TimeBand& larger = with(forecast, 8);
  CHECK(larger.faults == 8);
  CHECK(larger.least_ns == doctest::Approx(40 + 60 / 2));
  CHECK(larger.most_ns == doctest::Approx(100 - 40 / 2));
  CHECK(larger.width() == doctest::Approx(80.0 / 70 - 1));
  CHECK_FALSE(larger.is_narrow());
}

TEST_CASE("of a cache that is no better nothing but the run itself is predicted, as is of its own") {
  const CacheForecast forecast = forecast_caches(run_of_100_ns(4, 16), cycle(8, 2), 16);
  for (const std::uint32_t size : {1, 4, 7}) {
    CHECK(with(forecast, size).least_ns == doctest::Approx(100));
    CHECK(with(forecast, size).most_ns == doctest::Approx(100));
    CHECK(with(forecast, size).is_narrow());
  }
}

TEST_CASE("with more faults the reading that has all grow is the longer one") {
  const TimeBand smaller = with(forecast_caches(run_of_100_ns(8, 8), cycle(8, 2), 16), 4);
  CHECK(smaller.least_ns == doctest::Approx(100 + 40));
  CHECK(smaller.most_ns == doctest::Approx(100 + 60));
}

TEST_CASE("sizes are four for each doubling up to all pages, and the run's own, each once and in order") {
  const CacheForecast forecast = forecast_caches(run_of_100_ns(9, 16), cycle(16, 2), 16);
  std::vector<std::uint32_t> sizes;
  for (const TimeBand& size : forecast.sizes) {
    sizes.push_back(size.cache_pages);
  }
  CHECK(sizes == std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 16});
}

TEST_CASE("where the curve misses the run's own faults the band has both proportions") {
  const CacheForecast forecast = forecast_caches(run_of_100_ns(4, 20), cycle(8, 2), 16);
  CHECK(forecast.curve_error == doctest::Approx(0.2));
  CHECK(with(forecast, 8).least_ns == doctest::Approx(40 + 60 * 0.4));  // 8 of the run's 20
  CHECK(with(forecast, 8).most_ns == doctest::Approx(100 - 40 * 0.5));  // 8 of the curve's 16
  CHECK(with(forecast, 4).width() == 0);
}

TEST_CASE("a sample widens the band by twice the error that half of it shows, the more the further from the run's own cache") {
  MissEstimate sampled = cycle(8, 2);
  sampled.every = 2;  // so half of the sample is meaningful for caches from 16 pages on
  sampled.half = cycle(4, 3).curve;
  const CacheForecast forecast = forecast_caches(run_of_100_ns(16, 16), sampled, 64);
  CHECK(forecast.sizes.front().cache_pages == 16);
  CHECK(forecast.sample_error == 0);  // no size from 16 on changes anything, in the curve or in half of it
  sampled.curve = cycle(12, 2).curve;
  sampled.half = cycle(6, 3).curve;
  const CacheForecast wider = forecast_caches(run_of_100_ns(16, 48), sampled, 64);
  // From 48 misses to 24, and by the half from 72 to 24: a third in place of a half, so a third less, twice.
  CHECK(wider.sample_error == doctest::Approx(2.0 / 3));
  CHECK(with(wider, 64).most_ns == doctest::Approx(std::max(40 + 60 * (0.5 + 1.0 / 3), 60 + 40 * (0.5 + 1.0 / 3))));
  CHECK(with(wider, 64).least_ns == doctest::Approx(40 + 60 * (0.5 - 1.0 / 3)));
  CHECK(with(wider, 16).width() == 0);
}

TEST_CASE("far from the run's own cache a band is not surer than nearer to it") {
  MissEstimate sampled = cycle(12, 2);
  sampled.every = 2;
  sampled.half = cycle(7, 3).curve;  // with 27 pages it still misses all, where the sample misses half
  const CacheForecast forecast = forecast_caches(run_of_100_ns(16, 48), sampled, 64);
  CHECK(with(forecast, 27).most_ns == doctest::Approx(40 + 60 * 0.5 * 3));
  CHECK(with(forecast, 64).most_ns == doctest::Approx(40 + 60 * 0.5 * 3));
  CHECK(with(forecast, 64).least_ns == doctest::Approx(40));
}

TEST_CASE("nothing is predicted from a run without faults, without time, or whose cache the sample does not know") {
  CHECK(forecast_caches(run_of_100_ns(4, 0), cycle(8, 2), 16).sizes.empty());
  CHECK(forecast_caches({.parts = {}, .cache_pages = 4, .faults = 16}, cycle(8, 2), 16).sizes.empty());
  CHECK(forecast_caches(run_of_100_ns(4, 16), {}, 16).sizes.empty());
  MissEstimate sampled = cycle(8, 2);
  sampled.every = 4;
  sampled.half = sampled.curve;
  CHECK(forecast_caches(run_of_100_ns(31, 16), sampled, 64).sizes.empty());
  CHECK_FALSE(forecast_caches(run_of_100_ns(32, 64), sampled, 64).sizes.empty());
}

}  // namespace dmpc::apps::cache_forecast_test
