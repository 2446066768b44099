#include "apps/show/page/forecast_view.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "apps/show/page/render_page.h"
#include "apps/show/page/sweep_page.h"
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

/// Runs of 2, 4 and 16 pages beside what is predicted from that of 4; with 8 pages that is too uncertain to be shown.
ForecastView four_pages() {
  ForecastView view{true, 4, "It is so wide.", {}, {}};
  view.sizes = {from_to(2, 20, 21), from_to(4, 10, 10), from_to(8, 5, 6), from_to(16, 4, 4.1)};
  view.runs = {{2, 20.5e6}, {4, 10e6}, {16, 4.05e6}};
  return view;
}

std::string sweep_page_of(const ForecastView& view) {
  return sweep_page({.title = "Sweep", .texts = {}, .parts = {}, .forecast = view}, {});
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
  REQUIRE(view.runs.size() == 1);
  CHECK(view.runs[0].total_ns == doctest::Approx(static_cast<double>(report.virtual_time->total_ns)));
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

TEST_CASE("what a page says is read back from it, and of a page without it nothing") {
  const Watched watched(starved(modelled()));
  const std::string page = page_of(watched);
  const ForecastView read = forecast_in(page, "a.html").value();
  CHECK(json_of(read) == json_of(forecast_view(watched.record()).value()));
  CHECK_FALSE(forecast_in(page_of(Watched(modelled(Strategy::dataflow))), "a.html").has_value());
  CHECK_FALSE(forecast_in("<p>No data.</p>", "a.html").has_value());
}

TEST_CASE("of threads faults are predicted, and no time") {
  const Watched watched(starved(small()));
  const ForecastView view = forecast_view(watched.record()).value();
  CHECK_FALSE(view.is_of_time);
  CHECK(view.runs[0].total_ns == static_cast<double>(std::get<svm::Report>(*watched.report).pages().faults));
  for (const TimeBand& size : view.sizes) {
    CHECK(size.least_ns <= doctest::Approx(size.faults));
    CHECK(size.most_ns >= doctest::Approx(size.faults));
  }
  const std::string page = page_of(watched);
  CHECK(contains(page, "id=\"what-if\""));
  CHECK(contains(page, "the run would have "));
  CHECK_FALSE(contains(page, ">Run time by the size of the caches<"));
  CHECK_FALSE(forecast_in(page, "a.html").has_value());
}

TEST_CASE("a band that is wider than a tenth is in the table, too, and called vague") {
  const std::string page = sweep_page_of(four_pages());
  CHECK(contains(page, "20.000</td><td>21.000</td><td>5.0</td><td>20.500"));
  CHECK(contains(page, "5.000</td><td>6.000</td><td>20.0<"));
  CHECK(contains(page, "the run would take 5.00 ms to 6.00 ms, which is vague: the ends lie 20 % apart."));
}

TEST_CASE("by script a page says in words what is asked for in its address, with dots that a switch hides" *
          doctest::test_suite("slow")) {
  const std::string page = sweep_page_of(four_pages());
  CHECK(reported(page, "") == "4 pages: the run from which all else is predicted, 10 ms. 3 dots, 3 bands");
  CHECK(reported(page, "#cache=2") == "2 pages: predicted 20 to 21 ms, with 500 faults; a run took 20.5 ms. 3 dots, 3 bands");
  CHECK(reported(page, "#cache=2&dots=0") == "2 pages: predicted 20 to 21 ms, with 500 faults. 0 dots, 3 bands");
  CHECK(reported(page, "#cache=9") ==
        "8 pages: predicted 5 to 6 ms, with 125 faults, which is vague: the ends lie 20.0 % apart. 3 dots, 3 bands");
  CHECK(contains(reported(page, "#cache=nan&dots=-1&__proto__=1"), "4 pages: the run"));
  CHECK(contains(reported(page_of(Watched(starved(modelled()))), "#cache=1e9"), " 1 dots, "));
}

}  // namespace dmpc::apps::html::forecast_view_test
