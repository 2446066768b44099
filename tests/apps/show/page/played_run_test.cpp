#include "apps/show/page/played_run.h"

#include <doctest/doctest.h>

#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/show/page/page_data.h"
#include "apps/show/page/play_data.h"
#include "apps/show/page/player.h"
#include "apps/show/page/render_page.h"
#include "core/base/expect.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/watched.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::played_run_test {

namespace {

using nlohmann::json;
using tests::contains;

Origin origin() { return {.command = "dmpc", .words = {"dmpc", "render", "balls-2"}}; }

std::string page_of(const Watched& watched) { return render_page(watched.record(), origin()); }

/// A page with such data alone.
std::string page_with(std::string data) {
  for (std::size_t at = data.find('<'); at != std::string::npos; at = data.find('<', at)) {
    data.replace(at, 1, "\\u003c");
  }
  return "<html><script type=\"application/json\" id=\"data\">" + data + "</script></html>";
}

/// What is said of a page that is refused; empty if it is not.
std::string refusal(const std::string& page) {
  return tests::complaint_of([&] { played_run(page, "a.html"); });
}

}  // namespace

TEST_CASE("what the page of a render plays is read back, all of it, with its counters and its picture") {
  for (const RenderOptions& options :
       {starved(modelled()), starved(small()), modelled(Strategy::dataflow), modelled(Strategy::forest)}) {
    const Watched watched(options);
    json data = json::parse(data_text(play_data(watched.record(), origin())));
    const PlayedRun run = played_run(page_of(watched), "a.html");
    REQUIRE(run.stats.has_value());
    CHECK(json::parse(*run.stats) == data["stats"]);
    data.erase("stats");
    data.erase("forecast");
    CHECK(run.data == data);
    CHECK(run.picture.starts_with("\x89PNG\r\n"));
  }
}

TEST_CASE("a page that plays no run is refused, with what it is") {
  CHECK(contains(refusal("no page at all"), "a.html: this is no page"));
  CHECK(contains(refusal("<html><p>Nothing.</p></html>"), "a.html: this page plays no run; expected a page that dmpc render"));
  CHECK(contains(refusal(page_with(R"({"runs": []})")), "two runs side by side already"));
  CHECK(contains(refusal(page_with(R"({"forecast": {}})")), "the page of a study, which plays no run"));
  CHECK(contains(refusal(page_with(R"({"format": 7})")), "its data have format 7, expected format 3; compare it with the dmpc"));
  CHECK(contains(refusal(page_with("[1]")), "no object of JSON"));
  CHECK(contains(refusal(page_with("{")), "no object of JSON"));
  CHECK(contains(refusal(page_with("{\"a\":" + std::string(100'000, '['))), "objects in each other"));
  CHECK(
      contains(refusal("<script type=\"application/json\" id=\"data\">{\"format\": 3"), "ends within its data, it was cut off"));
}

TEST_CASE("data that do not hold together are refused, with where, and no browser sees them") {
  const json data = json::parse(data_text(play_data(Watched(starved(modelled())).record(), origin())));
  REQUIRE(refusal(page_with(data.dump())).empty());
  std::vector<std::pair<std::string, json>> changes = {
      {"/steps", data["steps"].get<int>() + 1},
      {"/wide", data["wide"].get<int>() + 1},
      {"/works/0/name", std::string(5000, 'x')},
  };
  for (const auto& row : tests::rows_in("apps/show/page/changed_data.txt", 2)) {
    changes.emplace_back(row[0], json::parse(row[1]));
  }
  for (const auto& [place, value] : changes) {
    CAPTURE(place);
    json changed = data;
    changed[json::json_pointer(place)] = value;
    const std::string said = refusal(page_with(changed.dump()));
    CHECK(contains(said, "a.html: data"));
    CHECK(contains(said, "expected "));
  }
}

TEST_CASE("what is not known is not taken, and texts are taken whatever they contain") {
  json data = json::parse(data_text(play_data(Watched(starved(modelled())).record(), origin())));
  data["onload"] = "alert(1)";
  data["works"][0]["more"] = 1;
  data["scene"] = "</script>\xe2\x80\xa8<b>";
  const PlayedRun run = played_run(page_with(data.dump(-1, ' ', true)), "a.html");
  CHECK_FALSE(run.data.contains("onload"));
  CHECK_FALSE(run.data["works"][0].contains("more"));
  CHECK(run.picture.empty());
}

}  // namespace dmpc::apps::html::played_run_test
