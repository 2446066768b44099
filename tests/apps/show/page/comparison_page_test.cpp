// Two runs on one clock: what their page says without script, and what it draws in a browser.
#include "apps/show/page/comparison_page.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "apps/show/page/render_page.h"
#include "apps/show/stats/stats.h"
#include "core/base/expect.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/page/played.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::comparison_page_test {

namespace {

using nlohmann::json;
using tests::reported;

ComparedPage page_of(const Watched& watched, const std::string& file) {
  const std::string word = command_text(std::vector<std::string>{"x", file}).substr(2);  // as a shell takes it
  const std::string page = render_page(watched.record(), {.command = "dmpc", .words = {"dmpc", "render", word}});
  ComparedPage compared{file, played_run(page, file), {}};
  compared.picture = Image(compared.run.data["width"], compared.run.data["height"]);
  std::fill(compared.picture.rgb.begin(), compared.picture.rgb.end(), 0.5F);
  return compared;
}

RenderOptions with_cache(std::uint32_t pages) {
  RenderOptions options = starved(modelled());
  options.pages.cache_pages = pages;
  return options;
}

/// Runs with 4 and 8 pages, of which the second is the shorter one.
Comparison four_and_eight(const std::string& second = "b.html") {
  return {.pages = {{page_of(Watched(with_cache(4)), "a.html"), page_of(Watched(with_cache(8)), second)}},
          .picture_sentence = "The pictures are the same.",
          .counter_sentence = "2 of 3 counters differ."};
}

std::string text_of(const Comparison& comparison) {
  return comparison_page(comparison, {.command = "dmpc compare a.html b.html"});
}

const json& run_of(const Comparison& comparison, std::size_t side) { return comparison.pages[side].run.data; }

double total_ms(const Comparison& comparison) {
  return std::max(comparison.pages[0].run.total_ns(), comparison.pages[1].run.total_ns()) / 1e6;
}

std::string state_at(double ms) {
  std::ostringstream state;
  state.precision(17);
  state << "#t=" << ms;
  return state.str();
}

}  // namespace

TEST_CASE("the page of two runs has the data of both, whose sums are the runs' counters") {
  const std::vector<std::uint32_t> caches = {4, 8};
  const json data = json::parse(tests::data_in(text_of(four_and_eight())));
  REQUIRE(data["runs"].size() == 2);
  for (std::size_t side = 0; side < 2; ++side) {
    const Watched watched(with_cache(caches[side]));
    const json stats = json::parse(stats_json(watched.record()));
    for (const json& field : data["runs"][side]["fields"]) {
      const std::vector<std::uint64_t> numbers = tests::numbers_in(field["values"]);
      const std::uint64_t sum = std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
      CHECK((field["name"] != "faults" || sum == stats["pages"]["faults"]));
      CHECK((field["name"] != "rays" || sum == stats["rays"]["total"]));
    }
    CHECK(data["runs"][side]["fetched"] == stats["pages"]["faults"]);
  }
}

TEST_CASE("what a node's time went to adds up to the whole run, on both sides and in the difference") {
  const Table table = time_table(four_and_eight().pages);
  std::vector<double> sums(3);
  for (std::size_t row = 0; row + 1 < table.rows().size(); ++row) {
    for (std::size_t column = 0; column < sums.size(); ++column) {
      sums[column] += std::get<double>(table.rows()[row][column + 1]);
    }
  }
  CHECK(std::get<std::string>(table.rows().back()[0]) == "the whole run");
  for (std::size_t column = 0; column < sums.size(); ++column) {
    CHECK(sums[column] == doctest::Approx(std::get<double>(table.rows().back()[column + 1])).epsilon(1e-6));
  }
  CHECK(sums[2] < 0);
}

TEST_CASE("without script the page has both pictures, commands and tables, and says which run took longer and by what") {
  const std::string page = text_of(four_and_eight());
  for (const char* const part : {"A took ", " less; the largest part of that is ", "dmpc render a.html", "dmpc render b.html",
                                 "The picture of A", "The picture of B", "Sums over all pixels", "2 of 3 counters differ.",
                                 "The pictures are the same.", "Plot: What a node&#39;s time went to"}) {
    CHECK_MESSAGE(tests::contains(page, part), part);
  }
  CHECK_FALSE(tests::contains(page, " style="));
  // The difference in words is before all else.
  CHECK(page.find("A was run with <code>a.html</code>, B with <code>b.html</code>.") < page.find("A took "));
  CHECK(page.find("A took ") < page.find("The pictures are the same."));
  CHECK(page.find("2 of 3 counters differ.") < page.find("<nav"));
}

TEST_CASE("on one clock the pixels of either run are lit that it had done by then" * doctest::test_suite("slow")) {
  const Comparison comparison = four_and_eight();
  const std::string page = text_of(comparison);
  for (const int share : {0, 40, 100}) {
    const double ms = total_ms(comparison) * share / 100;
    std::string expected;
    for (std::size_t side = 0; side < 2; ++side) {
      const double now = 65535.0 * 1e6 * ms / run_of(comparison, side)["total_ns"].get<double>();
      const std::vector<std::uint64_t> done = tests::numbers_in(run_of(comparison, side)["done"]);
      expected += std::to_string(std::count_if(done.begin(), done.end(),
                                               [now](std::uint64_t part) { return static_cast<double>(part) <= now + 1e-6; })) +
                  " ";
    }
    CHECK(reported(page, "", "lit('shot')+' '+lit('shot1')+' '", state_at(ms)) == expected);
  }
}

TEST_CASE("a run that is over does nothing any more while the other goes on" * doctest::test_suite("slow")) {
  const Comparison comparison = four_and_eight();
  REQUIRE(comparison.pages[1].run.total_ns() < comparison.pages[0].run.total_ns());
  const std::string said = reported(text_of(comparison), "", "id('said').textContent",
                                    state_at((comparison.pages[1].run.total_ns() / 1e6 + total_ms(comparison)) / 2) + "&node=0");
  CHECK(tests::contains(said, "A: Node 0, at "));
  CHECK(tests::contains(said, "B: Node 0, at "));
  CHECK(tests::contains(said.substr(said.find("B: ")), "ms: idle at the end 100.0 %."));
}

TEST_CASE("by keys alone a pixel of the second run is chosen, said of both, and the address brings the view back" *
          doctest::test_suite("slow")) {
  const std::string page = text_of(four_and_eight());
  const std::string chosen = reported(page, "key(id('shot1'),'ArrowRight')", "id('said').textContent+w.location.hash");
  CHECK(tests::contains(chosen, "A: Pixel 8, 6: node "));
  CHECK(tests::contains(chosen, "B: Pixel 8, 6: node "));
  CHECK(tests::contains(chosen, "run=1"));
  const std::string state = chosen.substr(chosen.find('#'));
  CHECK(reported(page, "", "id('said').textContent+w.location.hash", state) == chosen);
  const std::string shown =
      "[...p.querySelectorAll('#player .cards section')].filter(s=>!s.hidden).map(s=>s.textContent[0]).join('')";
  CHECK(tests::contains(reported(page, "", shown, "#run=0"), "A"));
  CHECK_FALSE(tests::contains(reported(page, "", shown, "#run=0"), "B"));
  CHECK_FALSE(tests::contains(reported(page, "", shown, "#run=1"), "A"));
  CHECK(reported(page, "", "id('command').textContent", "#run=1") == "dmpc render b.html");
  CHECK(reported(page, "", "!!p.documentElement.dataset.loaded", "#run=7&link=1e9&page=1e9&peer=1e9&why=1e9&x=1e9") == "true");
}

TEST_CASE("a name that would be script does nothing, and of a script in which a byte is changed nothing runs" *
          doctest::test_suite("slow")) {
  const std::string name = "</script><script>document.title='run'</script>\xe2\x80\xa8<img src=x onerror=alert(1)>";
  std::string page = text_of(four_and_eight(name));
  CHECK(reported(page, "", "[!!id('player'),p.querySelectorAll('img[onerror]').length,p.title.startsWith('Two runs')]") ==
        "true,0,true");
  page[page.find("\"The runs, on one clock\"") + 1] = 't';
  CHECK(reported(page, "", "!!id('player')") == "false");
}

TEST_CASE("a browser shows the page of two runs whole, on a screen and on a telephone, and asks nobody for more" *
          doctest::test_suite("slow")) {
  const tests::TemporaryFolder folder;
  const std::string page = text_of(four_and_eight());
  for (const int width : {1280, 400}) {
    tests::check_shown_whole(tests::reported_by_browser(page, width, width == 400, folder / "shot.png"), page, width,
                             width == 400);
  }
}

TEST_CASE("each part of the page of two runs has a name of its own, and words for those who do not see it" *
          doctest::test_suite("slow")) {
  CHECK(reported(text_of(four_and_eight()), "", tests::broken_rules) == "0,0,0,0,0");
}

TEST_CASE("a run in virtual time and one by the wall clock have no time in common") {
  Comparison comparison = four_and_eight();
  comparison.pages[1] = page_of(Watched(starved(small())), "b.html");
  CHECK_THROWS_WITH_AS(text_of(comparison), doctest::Contains("render both with --runner=virtual, or neither"), core::InputError);
}

}  // namespace dmpc::apps::html::comparison_page_test
