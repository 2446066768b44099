#include "apps/show/page/play_data.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "apps/edge/run/work.h"
#include "apps/show/stats/stats.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::play_data_test {

namespace {

using nlohmann::json;
using tests::numbers_in;

Origin origin() { return {.words = {"dmpc", "render", "'<b> \xe2\x80\xa8.nff'"}}; }

std::string text_of(const Watched& watched) { return play_data(watched.record(), origin()); }

std::uint64_t sum_of(const json& array) {
  const std::vector<std::uint64_t> numbers = numbers_in(array);
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

const json& named(const json& list, const std::string& name) {
  return *std::find_if(list.begin(), list.end(), [&](const json& entry) { return entry.at("name") == name; });
}

/// Nanoseconds of all nodes with one kind of work, from the 255ths of their steps.
double shares_ns(const json& data, const std::string& work) {
  return static_cast<double>(sum_of(named(data["works"], work)["shares"])) / 255 * data["step_ns"].get<double>();
}

double work_ns(const json& data) {
  double sum = 0;
  for (const json& work : data["works"]) {
    sum += work["ns"].get<double>();
  }
  return sum;
}

}  // namespace

TEST_CASE("sums of what a page plays are the run's counters") {
  for (const RenderOptions& options : {starved(small()), starved(modelled())}) {
    const Watched watched(options);
    const json data = json::parse(text_of(watched)), stats = json::parse(stats_json(watched.record()));
    CHECK(data["format"] == 1);
    CHECK(sum_of(named(data["fields"], "rays")["values"]) == stats["rays"]["total"]);
    CHECK(sum_of(named(data["fields"], "references")["values"]) == stats["pages"]["references"]);
    CHECK(sum_of(named(data["fields"], "faults")["values"]) == stats["pages"]["faults"]);
    CHECK(sum_of(data["pairs"]["counts"]) == stats["pages"]["faults"]);
    CHECK(data["fetched"] == stats["pages"]["faults"]);
    CHECK(stats["pages"]["faults"] > 0);
  }
}

TEST_CASE("rays that travel are those that the run counts between its nodes") {
  const Watched watched(small(Strategy::dataflow));
  const json data = json::parse(text_of(watched)), stats = json::parse(stats_json(watched.record()));
  const std::vector<std::uint64_t> sent = std::get<dataflow::Report>(*watched.report).ray_matrix();
  CHECK(data["pairs"]["what"] == "rays");
  CHECK(sum_of(data["pairs"]["counts"]) == std::accumulate(sent.begin(), sent.end(), std::uint64_t{0}));
  CHECK(sum_of(named(data["fields"], "rays")["values"]) == stats["rays"]["total"]);
  CHECK(data["pages"].empty());
}

TEST_CASE("in virtual time the steps of all nodes add up to what they did, to half of a 255th of a step each") {
  const Watched watched(starved(modelled()));
  const json data = json::parse(text_of(watched)), stats = json::parse(stats_json(watched.record()));
  double computed_ns = 0, served_ns = 0;
  for (const json& node : stats["nodes"]) {
    const json& times = node["virtual_seconds"];
    computed_ns += 1e9 * times["computing"].get<double>();
    served_ns += 1e9 * (times["stolen"].get<double>() + times["lent"].get<double>());
  }
  CHECK(work_ns(data) - named(data["works"], "messages")["ns"].get<double>() ==
        doctest::Approx(computed_ns + served_ns).epsilon(1e-9));
  const double slack_ns = data["step_ns"].get<double>() / 255 * data["nodes"].get<double>();
  for (const json& work : data["works"]) {
    CHECK(std::abs(shares_ns(data, work["name"]) - work["ns"].get<double>()) <= slack_ns);
  }
  CHECK(data["total_ns"].get<double>() == doctest::Approx(1e9 * stats["virtual_seconds"]["total"].get<double>()));
  CHECK(data["steps"].get<double>() * data["step_ns"].get<double>() >=
        data["total_ns"].get<double>() - data["step_ns"].get<double>());
}

TEST_CASE("links and hottest pages are as --stats and the page's tables have them") {
  const Watched watched(starved(modelled()));
  const json data = json::parse(text_of(watched)), stats = json::parse(stats_json(watched.record()));
  REQUIRE(data["links"].size() == stats["links"]["rows"].size());
  for (std::size_t i = 0; i < data["links"].size(); ++i) {
    for (const std::size_t column : {0U, 1U, 2U, 3U}) {
      CHECK(data["links"][i][column] == stats["links"]["rows"][i][column]);
    }
    CHECK(data["links"][i][4].get<double>() == doctest::Approx(1e9 * stats["links"]["rows"][i][4].get<double>()));
  }
  REQUIRE_FALSE(data["pages"].empty());
  CHECK(data["pages"][0][2] >= data["pages"].back()[2]);
}

TEST_CASE("what is lit in a part of the run was done by then, and at its end all is lit") {
  const Watched watched(starved(modelled()));
  const json data = json::parse(text_of(watched));
  const auto done = watched.heat->values(core::HeatKind::done);
  const std::vector<std::uint64_t> parts = numbers_in(data["done"]);
  REQUIRE(parts.size() == done.size());
  const double total_ns = data["total_ns"];
  for (std::size_t pixel = 0; pixel < parts.size(); ++pixel) {
    CHECK(static_cast<double>(done[pixel]) <= static_cast<double>(parts[pixel]) / 65535 * total_ns * (1 + 1e-12));
    CHECK(static_cast<double>(done[pixel]) > (static_cast<double>(parts[pixel]) - 1) / 65535 * total_ns * (1 - 1e-12));
    CHECK(parts[pixel] <= 65535);
  }
}

TEST_CASE("texts are data, whatever they contain") {
  Watched watched(small());
  watched.options.picture.scene = "</script>\xe2\x80\xa8<b>\xff\"";
  const std::string text = text_of(watched);
  CHECK_FALSE(contains(text, "\xe2\x80\xa8"));
  const json data = json::parse(text);
  CHECK(data["scene"] == "</script>\xe2\x80\xa8<b>\xef\xbf\xbd\"");
  CHECK(data["words"][2] == "'<b> \xe2\x80\xa8.nff'");
}

TEST_CASE("a page names its clock") {
  CHECK(json::parse(text_of(Watched(small())))["clock"] == "wall clock");
  CHECK(json::parse(text_of(Watched(modelled())))["clock"] == "virtual time");
}

}  // namespace dmpc::apps::html::play_data_test
