// The page that plays, in a real browser: what its script draws, by pointer, by keys and by the address, and what may not run.

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/run/report.h"
#include "apps/show/page/render_page.h"
#include "tests/apps/show/page/numbers_in.h"
#include "tests/apps/show/page/played.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::player_test {

using tests::reported;

namespace {

/// Page of a run on a modelled machine; the scene can have another name.
std::string page_of(const std::string& scene = "balls-2") {
  Watched watched(starved(modelled()));
  watched.options.picture.scene = scene;
  return render_page(watched.record(), {.command = "dmpc", .words = {"dmpc", "render", "balls-2"}});
}

}  // namespace

TEST_CASE("the pixels that are lit at a time are those that were done by then" * doctest::test_suite("slow")) {
  const std::string page = page_of();
  const nlohmann::json data = nlohmann::json::parse(tests::data_in(page));
  const std::vector<std::uint64_t> done = tests::numbers_in(data["done"]);
  for (const int share : {0, 40, 75, 100}) {
    const double ms = data["total_ns"].get<double>() / 1e6 * share / 100;
    const auto count = std::count_if(done.begin(), done.end(),
                                     [&](std::uint64_t part) { return static_cast<double>(part) <= 65535.0 * share / 100; });
    std::ostringstream state;
    state.precision(17);
    state << "#t=" << ms;
    CHECK(reported(page, "", "lit()", state.str()) == std::to_string(count));
  }
}

TEST_CASE("by keys alone a pixel is chosen, said and let go, time goes on, and the address has it" *
          doctest::test_suite("slow")) {
  const std::string page = page_of();
  const std::string chosen =
      reported(page, "key(id('shot'),'ArrowRight');key(id('shot'),'ArrowDown')", "id('said').textContent+w.location.hash");
  CHECK(contains(chosen, "Pixel 8, 7: node "));
  CHECK(contains(chosen, "x=8"));
  CHECK(contains(reported(page, "key(id('shot'),'ArrowRight');key(p.body,'Escape')", "id('said').textContent"),
                 "Point at a pixel"));
  CHECK(reported(page, "key(id('raster'),'Home')", "lit()") == "0");
  CHECK(contains(reported(page, "key(id('raster'),'ArrowDown')", "id('said').textContent"), "Node 0"));
  CHECK(contains(reported(page, "key(id('pairs'),'ArrowDown')", "id('said').textContent"), "fetched by node 0 from node 1"));
  CHECK(contains(reported(page, "key(id('machine'),'ArrowDown')", "id('said').textContent"), "Link from "));
  CHECK(contains(reported(page, "key(id('pages'),'ArrowRight')", "id('said').textContent"), "of the hottest: at home on node "));
  CHECK(reported(page, "key(p.body,' ')", "id('play').textContent") == "Pause");
}

TEST_CASE("the chain of causes leads back to the start, from a wait by key and from the end of the run by address" *
          doctest::test_suite("slow")) {
  const std::string page = page_of();
  const std::string last = "p.querySelector('#why li:last-child').textContent";
  const std::string path = reported(page, "", "id('why-sum').textContent+" + last + "+id('path').textContent", "#why=1e9");
  CHECK(contains(path, "The run ended when it did after "));
  CHECK((contains(path, "From the start node ") || contains(path, "From the start the host ") ||
         contains(path, "more, back to the start.")));
  CHECK(contains(path, "Hide the critical path"));
  const nlohmann::json data = nlohmann::json::parse(tests::data_in(page));
  std::ostringstream state;
  state << "#node=" << tests::numbers_in(data["causes"]["node"])[0] << "&t="
        << static_cast<double>(tests::numbers_in(data["causes"]["begin"])[0] +
                               tests::numbers_in(data["causes"]["length"])[0] / 2) /
               1e6;
  CHECK(contains(reported(page, "key(id('raster'),'w')", "id('why-sum').textContent+w.location.hash", state.str()),
                 "The wait ended when it did"));
}

TEST_CASE("a page opens with where the time of the whole run went, not with its last moment") {
  const std::string page = page_of(), text = "id('names').parentElement.textContent";
  const std::string opened = reported(page, "", text);
  CHECK_MESSAGE(contains(opened, "Of all nodes, in the whole run."), opened);
  const std::string table = "id('names').textContent";
  CHECK(reported(page, "", table) == reported(page, "", table, "#from=0&to=1e9"));
  CHECK(contains(reported(page, "", text, "#t=0"), "Of all nodes, at 0"));
}

TEST_CASE("what the time of the whole run went to is said on a page as in the closing lines") {
  const Watched watched(starved(modelled()));
  const std::string page = render_page(watched.record(), {.command = "dmpc"});
  const Account account = account_of(*watched.report);
  const std::vector<double> percent = percent_parts(parts_of(account).ns);
  const auto row = [&page](const std::string& name) {
    return reported(page, "",
                    "[...p.querySelectorAll('#names tr')].filter(r=>r.firstChild.textContent==='" + name +
                        "').map(r=>r.children[1].textContent)[0]");
  };
  CHECK(row("computing") == fixed(percent[static_cast<std::size_t>(TimePart::computing)], 1) + " %");
  CHECK(row("messages") == fixed(percent[static_cast<std::size_t>(TimePart::messages)], 1) + " %");
}

TEST_CASE("over the rows of time a page tells the pointer's moment, until the pointer leaves" * doctest::test_suite("slow")) {
  const std::string over =
      "const c=id('raster'),b=c.getBoundingClientRect();c.dispatchEvent(new w.PointerEvent('pointermove',"
      "{clientX:b.left+b.width/2,clientY:b.top+1,bubbles:true}))";
  const std::string page = page_of();
  CHECK(contains(reported(page, over, "id('said').textContent"), "Node 0, at "));
  CHECK(contains(reported(page, over, "id('names').parentElement.textContent"), "Of node 0, at "));
  CHECK(contains(reported(page, over + ";c.dispatchEvent(new w.PointerEvent('pointerleave'))", "id('said').textContent"),
                 "Point at a pixel"));
}

TEST_CASE("plots and maps are drawn by the page, and tell what is reached by keys" * doctest::test_suite("slow")) {
  const std::string page = page_of();
  CHECK(reported(page, "", "[...p.querySelectorAll('figure.plot')].filter(f=>!f.querySelector('svg')).length") == "0");
  const auto at = [&page](const std::string& figure) {
    const std::string found = "p.querySelector('" + figure + "')";
    return reported(page, "key(" + found + ".querySelector('svg'),'ArrowRight')", found + ".querySelector('output').textContent");
  };
  CHECK(contains(at("#plot-losses"), "node 0: computing "));
  CHECK(contains(at("figure.plot:not([id])"), "node 0, since the start 0 ms: "));
}

TEST_CASE("the view's command has its heat map and window") {
  CHECK(reported(page_of(), "", "id('command').textContent", "#heat=faults&from=1&to=2&node=1") ==
        "dmpc render balls-2 --heatmap=faults:faults.png --trace=part.pftrace --trace-window=1.000000,2.000000");
}

TEST_CASE("of a script in which a byte is changed nothing runs" * doctest::test_suite("slow")) {
  std::string page = page_of();
  CHECK(reported(page, "", "!!id('player')") == "true");
  const std::size_t at = page.find("\"The run, as it went\"");
  REQUIRE(at != std::string::npos);
  page[at + 1] = 't';
  CHECK(reported(page, "", "!!id('player')") == "false");
}

TEST_CASE("names that would be script do nothing") {
  const std::string counts = "[!!id('player'),p.querySelectorAll('img[onerror]').length,p.querySelectorAll('script').length]";
  const std::string hostile =
      reported(page_of("</script><script>document.title='run'</script>\xe2\x80\xa8<img src=x onerror=alert(1)>"), "", counts);
  CHECK(hostile == reported(page_of(), "", counts));
  CHECK(hostile.starts_with("true,0,"));
}

TEST_CASE("each part of the page has a name of its own, and words for those who do not see it" * doctest::test_suite("slow")) {
  CHECK(reported(page_of(), "", tests::broken_rules) == "0,0,0,0,0");
}

TEST_CASE("a page has the scripts of what it plays, and no others") {
  const auto scripts = [](const RenderOptions& options) {
    const std::string page = render_page(Watched(options).record(), {.command = "dmpc"});
    std::string found;
    for (const char* const part : {"startWhatIf", "chainOf", "pairText", "pageText", "linkText", "levelColors"}) {
      found += tests::contains(page, std::string("const ") + part + " =") ? '1' : '0';
    }
    return found;
  };
  CHECK(scripts(starved(modelled())) == "111111");
  CHECK(scripts(modelled(Strategy::dataflow)) == "011011");
  CHECK(scripts(starved(small())) == "101100");
}

TEST_CASE("an address that says nonsense is taken as far as it makes sense" * doctest::test_suite("slow")) {
  CHECK(reported(page_of(), "", "!!p.documentElement.dataset.loaded", "#t=nan&x=1e9&node=-7&heat=__proto__&mix=-5&from=9&to=3") ==
        "true");
}

}  // namespace dmpc::apps::html::player_test
