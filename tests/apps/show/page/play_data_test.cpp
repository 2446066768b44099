#include "apps/show/page/play_data.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/run/work.h"
#include "apps/show/page/player.h"
#include "apps/show/stats/stats.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::play_data_test {

namespace {

using nlohmann::json;
using tests::numbers_in;

Origin origin() { return {.words = {"dmpc", "render", "'<b> \xe2\x80\xa8.nff'"}}; }

std::string text_of(const Watched& watched) { return data_text(play_data(watched.record(), origin())); }

std::uint64_t sum_of(const json& array) {
  const std::vector<std::uint64_t> numbers = numbers_in(array);
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

const json& named(const json& list, std::string_view name) {
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
    CHECK(data["format"] == 3);
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
    served_ns += 1e9 * (times["service_busy"].get<double>() + times["service_idle"].get<double>());
  }
  CHECK(work_ns(data) - named(data["works"], "messages")["ns"].get<double>() ==
        doctest::Approx(computed_ns + served_ns).epsilon(1e-9));
  // Each part is that of the closing lines: one figure for one thing.
  const Account account = account_of(*watched.report);
  const nodes::VirtualTimes times = sum_of_nodes(*account.virtual_time);
  CHECK(named(data["works"], "messages")["ns"] == times.sending_ns + times.receiving_ns);
  CHECK(named(data["works"], service_busy_words)["ns"] == times.service_busy_ns);
  CHECK(named(data["works"], service_idle_words)["ns"] == times.service_idle_ns);
  const double slack_ns = data["step_ns"].get<double>() / 255 * data["nodes"].get<double>();
  for (const json& work : data["works"]) {
    CHECK(std::abs(shares_ns(data, work["name"]) - work["ns"].get<double>()) <= slack_ns);
  }
  CHECK(data["total_ns"].get<double>() == doctest::Approx(1e9 * stats["virtual_seconds"]["total"].get<double>()));
  CHECK(data["steps"].get<double>() * data["step_ns"].get<double>() >=
        data["total_ns"].get<double>() - data["step_ns"].get<double>());
}

TEST_CASE("on a modelled machine waits by name add up to those of --stats, and the critical path to the run") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::forest}) {
    CAPTURE(name_of(strategy));
    const Watched watched(strategy == Strategy::svm ? starved(modelled()) : modelled(strategy));
    const json data = json::parse(text_of(watched));
    const Account account = account_of(*watched.report);
    const nodes::VirtualTimes times = sum_of_nodes(*account.virtual_time);
    const TimeParts parts = parts_of(times, account.waits);
    std::uint64_t waited_ns = 0;
    for (const TimePart part : wait_parts) {
      const std::uint64_t ns = parts.ns[static_cast<std::size_t>(part)] - (part == TimePart::idle_at_end ? times.end_ns : 0);
      const std::string name = words_of(part, account.waits);
      CAPTURE(name);
      const auto at =
          std::find_if(data["waits"].begin(), data["waits"].end(), [&](const json& wait) { return wait["name"] == name; });
      CHECK((at == data["waits"].end() ? 0 : (*at)["ns"].get<std::uint64_t>()) == ns);
      waited_ns += ns;
    }
    CHECK(waited_ns > 0);
    std::uint64_t path_ns = 0;
    for (const json& part : data["path"]["parts"]) {
      path_ns += part["ns"].get<std::uint64_t>();
    }
    CHECK(path_ns == account.virtual_time->total_ns);
    CHECK(data["path"]["parts"][0]["name"] == "computing");
  }
}

TEST_CASE("each wait that a page has is one of its node's, and what led to its end came before that") {
  const Watched watched(starved(modelled()));
  const json causes = json::parse(text_of(watched))["causes"];
  const auto column = [&causes](const char* name) { return numbers_in(causes[name]); };
  const std::vector<std::uint64_t> node = column("node"), begin = column("begin"), length = column("length"),
                                   kind = column("kind");
  REQUIRE(node.size() == watched.view().waits->waits.size());
  REQUIRE(node.size() > 10);
  CHECK(causes["count"] == node.size());
  CHECK(causes["left_out_ns"] == 0);
  const std::vector<std::uint64_t> at = column("at"), left = column("left"), request = column("request"), from = column("from");
  std::size_t page_replies = 0, asked_by_itself = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    CHECK(at[i] <= begin[i] + length[i]);
    CHECK(left[i] <= at[i]);
    if (i > 0 && node[i] == node[i - 1]) {
      CHECK(begin[i] >= begin[i - 1] + length[i - 1]);
    }
    if (causes["kinds"][kind[i]] == "page reply") {
      ++page_replies;
      CHECK(causes["kinds"][request[i]] == "page request");
      asked_by_itself += from[i] == node[i] ? 1 : 0;  // else its request stood behind another's
    }
  }
  CHECK(page_replies > 0);
  CHECK(2 * asked_by_itself > page_replies);
}

TEST_CASE("what passed over time adds up to pages fetched, by pair and by page, and to what each link carried") {
  const Watched watched(starved(modelled()));
  const nodes::ExchangeProfile& exchange = *watched.view().exchange;
  const svm::Fetches& fetches = *watched.view().fetches;
  const auto sum = [](std::span<const std::uint64_t> row) { return std::accumulate(row.begin(), row.end(), std::uint64_t{0}); };
  const std::size_t node_count = watched.options.computer.node_count;
  for (std::uint32_t requester = 0; requester < node_count; ++requester) {
    for (std::uint32_t home = 0; home < node_count; ++home) {
      CHECK(sum(exchange.pairs().row(requester * static_cast<std::uint32_t>(node_count + 1) + home)) ==
            fetches.by_pair[requester * fetches.peer_count + home]);
    }
  }
  for (std::uint32_t page = 0; page < fetches.by_page.size(); ++page) {
    CHECK(sum(exchange.numbers().row(page)) == fetches.by_page[page]);
  }
  for (const nodes::LinkUse& link : std::get<svm::Report>(*watched.report).virtual_time->busiest_links) {
    CHECK(sum(exchange.link_bytes(link.from, link.to)) == link.bytes);
  }
}

TEST_CASE("a page has as much over time as it shows: links, pairs, pages and levels") {
  const json data = json::parse(text_of(Watched(starved(modelled()))));
  const auto values = [](const json& rows) { return numbers_in(rows["values"]).size(); };
  const json& over = data["over"];
  CHECK(values(over["links"]) == data["links"].size() * over["links"]["steps"].get<std::size_t>());
  CHECK(values(over["pages"]) == data["pages"].size() * over["pages"]["steps"].get<std::size_t>());
  const auto side = data["pairs"]["side"].get<std::size_t>();
  CHECK(values(over["pairs"]) == side * side * over["pairs"]["steps"].get<std::size_t>());
  REQUIRE(over["levels"].size() == 3);
  CHECK(over["levels"][1]["name"] == "pages awaited");
  CHECK(values(over["levels"][1]) == over["levels"][1]["steps"]);
  for (const char* const name : {"links", "pages", "pairs"}) {
    const double end_ns = over[name]["steps"].get<double>() * over[name]["step_ns"].get<double>();
    CHECK(end_ns >= data["total_ns"].get<double>());
  }
}

TEST_CASE("threads have waits by name, too, and no path") {
  const json data = json::parse(text_of(Watched(starved(small()))));
  CHECK_FALSE(data["waits"].empty());
  CHECK_FALSE(data.contains("path"));
  CHECK_FALSE(data.contains("causes"));
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
