#include "apps/show/page/forecast_view.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "apps/show/page/render_page.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/watched.h"
#include "tests/support/browser.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::forecast_view_test {

namespace {

using nlohmann::json;
using tests::contains;

std::string page_of(const Watched& watched) {
  return render_page(watched.record(), {.command = "dmpc", .words = {"dmpc", "render", "balls-2"}});
}

TimeBand from_to(std::uint32_t pages, double least_ms, double most_ms) {
  return {.cache_pages = pages, .faults = 1000.0 / pages, .least_ns = 1e6 * least_ms, .most_ns = 1e6 * most_ms};
}

/// A run with 4 pages, and what is predicted from it; with 8 pages that is vague.
ForecastView four_pages() {
  ForecastView view{true, 4, "It is so wide.", {}, 10e6};
  view.sizes = {from_to(2, 20, 21), from_to(4, 10, 10), from_to(8, 5, 6), from_to(16, 4, 4.1)};
  return view;
}

/// What the page says of the size that its address asks for, and how many dots there are.
std::string reported(const std::string& page, const std::string& address, int wide = 1280) {
  const tests::TemporaryFolder folder;
  return tests::reported_by_browser(
      page, wide, false, folder / "shot.png",
      "<script>addEventListener('load',()=>setTimeout(()=>{const p=document.querySelector('iframe')."
      "contentDocument;document.title=p.querySelector('#what-if output').textContent+' '+"
      "p.querySelectorAll('.dot').length+' dots, '+p.querySelectorAll('.band').length+' bands'},1000))"
      "</script>",
      address);
}

}  // namespace

TEST_CASE("the page of a run says in a table what its data say: the run itself, and other caches between two readings") {
  const Watched watched(starved(modelled()));
  const ForecastView view = forecast_view(watched.record()).value();
  const auto& report = std::get<svm::Report>(*watched.report);
  CHECK(view.cache_pages == report.plan.frames);
  CHECK(view.total_ns == doctest::Approx(static_cast<double>(report.virtual_time->total_ns)));
  const std::string page = page_of(watched);
  const json data = json::parse(tests::data_in(page))["forecast"];
  CHECK(data == json_of(view));
  CHECK(contains(page, "Run time by the size of the caches"));
  CHECK(contains(page, "<div id=\"what-if\"></div>"));
  for (const json& point : data["points"]) {
    CHECK(point[2] <= point[3]);
    if (point[0] == data["cache"]) {
      CHECK(point[1] == report.pages().faults);
      CHECK(point[2] == data["runs"][0][1]);
    }
  }
}

TEST_CASE("of threads faults are predicted, and no time") {
  const Watched watched(starved(small()));
  const ForecastView view = forecast_view(watched.record()).value();
  CHECK_FALSE(view.is_of_time);
  CHECK(view.total_ns == static_cast<double>(std::get<svm::Report>(*watched.report).pages().faults));
  for (const TimeBand& size : view.sizes) {
    CHECK(size.least_ns <= doctest::Approx(size.faults));
    CHECK(size.most_ns >= doctest::Approx(size.faults));
  }
  const std::string page = page_of(watched);
  CHECK(contains(page, "id=\"what-if\""));
  CHECK(contains(page, "the run would have "));
  CHECK_FALSE(contains(page, ">Run time by the size of the caches<"));
}

TEST_CASE("a band that is wider than a tenth is in the table, too, and called vague") {
  Page of_forecast("Forecast");
  add_forecast(of_forecast, four_pages());
  const std::string page = of_forecast.text();
  CHECK(contains(page, "10.000</td><td>10.000</td><td>0.0</td><td>10.000"));
  CHECK(contains(page, "5.000</td><td>6.000</td><td>20.0<"));
  CHECK(contains(page, "the run would take 5.00 ms to 6.00 ms, which is vague: the ends lie 20 % apart."));
}

TEST_CASE("by script a page says in words what is asked for in its address, with dots that a switch hides" *
          doctest::test_suite("slow")) {
  const Watched watched(starved(modelled()));
  const std::string page = page_of(watched), own = std::to_string(forecast_view(watched.record()).value().cache_pages);
  for (const char* const address : {"", "#cache=nan&dots=-1&__proto__=1"}) {
    CHECK(contains(reported(page, address), " from which all else is predicted, "));
    CHECK(reported(page, address).starts_with(own + " page"));
  }
  CHECK(contains(reported(page, "#cache=1e9"), ": predicted "));
  CHECK(contains(reported(page, "#cache=1e9"), " 1 dots, "));
  CHECK(contains(reported(page, "#cache=1e9&dots=0"), " 0 dots, "));
}

}  // namespace dmpc::apps::html::forecast_view_test
