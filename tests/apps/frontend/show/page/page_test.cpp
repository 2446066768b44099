#include "apps/frontend/show/page/page.h"

#include <doctest/doctest.h>

#include <array>
#include <sstream>

#include "apps/frontend/show/page/data_url.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::page_page_test {

using tests::contains;
using tests::count;

namespace {

/// A page to which something was added.
template <class Add>
std::string page_with(const Add& add) {
  Page page("A <title>");
  add(page);
  return page.text();
}

/// The page without its script, which has names of its own.
std::string without_script(std::string text) {
  const std::string script = page_script.text;
  return text.erase(text.find(script), script.size());
}

Table table_of(std::size_t rows) {
  Table table("Ta<ble", {{"na<me"}, {"time", "s", 2}, {"count"}});
  for (std::size_t i = 0; i < rows; ++i) {
    table.add_row({"a<b", 0.125, std::uint64_t{1234567}});
  }
  return table;
}

}  // namespace

TEST_CASE("an empty page is a document with a title") {
  const std::string text = page_with([](Page&) {});
  CHECK(text.rfind("<!DOCTYPE html>\n<html lang=\"en\">", 0) == 0);
  CHECK(contains(text, "<title>A &lt;title&gt;</title>"));
  CHECK(contains(text, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"));
  CHECK_FALSE(contains(text, "<nav"));
  CHECK(text.substr(text.size() - 8) == "</html>\n");
}

TEST_CASE("a page asks for nothing from elsewhere") {
  const std::string text = without_script(page_with([](Page& page) {
    page.add_figure("data:image/png;base64,", "", "black", "Black.", "");
    page.add_table(table_of(1));
  }));
  CHECK_FALSE(contains(text, "http:"));
  CHECK_FALSE(contains(text, "https:"));
  CHECK_FALSE(contains(text, "<link"));
  CHECK(count(text, "src=\"") == count(text, "src=\"data:image/"));
}

TEST_CASE("a page's policy knows its own style and script by their digests, and has nothing else run") {
  const std::string text = page_with([](Page& page) { page.add_script({"alert(1)", page_script.sha256}); });
  const std::string policy = policy_of(std::array{page_style}, std::array{page_script, page_script});
  CHECK(contains(text, "<meta http-equiv=\"Content-Security-Policy\" content=\"" + policy + "\">\n<meta name=\"viewport\""));
  CHECK(contains(text, "<style>" + std::string(page_style.text) + "</style>"));
  CHECK(contains(text, "<script>" + std::string(page_script.text) + "</script>\n<script>alert(1)</script>"));
  CHECK_FALSE(contains(text, " style=\""));
  CHECK_FALSE(contains(text, " onclick=\""));
}

TEST_CASE("data for scripts end no element, whatever their texts contain") {
  const std::string text = page_with([](Page& page) { page.add_data("data", "{\"scene\":\"</script><script>alert(1)\"}"); });
  CHECK(contains(text,
                 "<script type=\"application/json\" id=\"data\">{\"scene\":\"\\u003c/script>\\u003cscript>alert(1)\"}</script>"));
}

TEST_CASE("the list of contents leads to each section") {
  const std::string text = page_with([](Page& page) {
    page.begin_section("One & only");
    page.begin_section("Two");
  });
  CHECK(contains(text, "<a href=\"#s1\">One &amp; only</a>"));
  CHECK(contains(text, "<h2 id=\"s1\">One &amp; only</h2>"));
  CHECK(contains(text, "<h2 id=\"s2\">Two</h2>"));
}

TEST_CASE("a page opens with sentences that lead to their plots and sections, beside what was added before") {
  const std::string text = page_with([](Page& page) {
    page.add_text("First.");
    page.end_opening({{"A < b.", "Two"}, {"", "One"}, {"A plot.", "plot-losses"}});
    page.begin_section("One");
    page.begin_section("Two");
  });
  CHECK(
      contains(text,
               "</h1>\n<div class=\"opening\">\n<p>First.</p>\n<ul class=\"findings\">\n<li><a href=\"#s2\">A &lt; b.</a></li>\n"
               "<li><a href=\"#plot-losses\">A plot.</a></li>\n</ul>\n</div>\n<nav"));
  CHECK_FALSE(contains(page_with([](Page&) {}), "class=\"opening\""));
}

TEST_CASE("a plot is data for the page's script, which end no element, and nothing without rows") {
  const auto text_of_rows = [](std::size_t rows) {
    return page_with([rows](Page& page) {
      page.add_plot(curves("times", "</script>", "count", {}, {}, {{"time", "time"}}), table_of(rows), "A caption.");
    });
  };
  const std::string text = text_of_rows(2);
  CHECK(contains(text, "<figure class=\"plot\" id=\"plot-times\"><script type=\"application/json\" class=\"plot-data\">{"));
  CHECK(contains(text, "\"title\":\"\\u003c/script>\""));
  CHECK(contains(text, "A caption."));
  CHECK_FALSE(contains(text_of_rows(0), "<figure"));
}

TEST_CASE("texts are shown as they are") {
  const std::string text = page_with([](Page& page) {
    page.add_text("1 < 2");
    page.add_facts({{"na<me", "va>lue"}});
  });
  CHECK(contains(text, "<p>1 &lt; 2</p>"));
  CHECK(contains(text, "<dt>na&lt;me</dt>\n<dd>va&gt;lue</dd>"));
}

TEST_CASE("a table has its numbers as people read them") {
  const std::string text = page_with([](Page& page) {
    Table table = table_of(1);
    table.add_row({std::monostate(), std::monostate(), std::monostate()});
    table.add_note("No<te.");
    page.add_table(table);
  });
  CHECK(contains(text, "<caption>Ta&lt;ble</caption>"));
  CHECK(contains(text, "<th scope=\"col\" class=\"text\">na&lt;me</th><th scope=\"col\">time (s)</th>"));
  CHECK(contains(text, "<tr><td class=\"text\">a&lt;b</td><td>0.12</td><td>1,234,567</td></tr>"));
  CHECK(contains(text, "<tr><td></td><td></td><td></td></tr>"));
  CHECK(contains(text, "<li>No&lt;te.</li>"));
}

TEST_CASE("a table that is named by its section is not named again") {
  const std::string text = page_with([](Page& page) {
    page.begin_section("Ta<ble");
    page.add_table(table_of(1));
    page.begin_section("Other");
    page.add_table(table_of(1));
  });
  CHECK(count(text, "<caption>") == 1);
}

TEST_CASE("long tables are folded") {
  const auto with_rows = [](std::size_t rows) { return page_with([&](Page& page) { page.add_table(table_of(rows)); }); };
  CHECK_FALSE(contains(with_rows(0), "<details>"));
  CHECK_FALSE(contains(with_rows(16), "<details>"));
  CHECK(contains(with_rows(17), "<details>\n<summary>Ta&lt;ble (17 rows)</summary>"));
}

TEST_CASE("elements that are opened are closed") {
  const std::string text = page_with([](Page& page) {
    page.begin_section("One");
    page.add_facts({{"a", "b"}});
    page.add_figure("data:image/png;base64,", "", "", "c", "");
    page.add_table(table_of(20));
    page.add_conclusion("d");
    page.add_origin({.command = "dmpc", .program = "dmpc 1", .date = "2026-11-22", .computer = "one"}, {{"film", "e"}});
  });
  for (const std::string name :
       {"main", "nav", "dl", "div", "figure", "table", "details", "summary", "thead", "tbody", "tr", "style", "pre", "a", "p"}) {
    CHECK_MESSAGE(count(text, "<" + name + " ") + count(text, "<" + name + ">") == count(text, "</" + name + ">"), name);
  }
}

TEST_CASE("what is between backticks is code, in paragraphs, cells and notes") {
  const std::string text = without_script(page_with([](Page& page) {
    page.add_text("as `dmpc <b>` does");
    Table table("Table", {{"a"}});
    table.add_row({"`x`"});
    table.add_note("`y`");
    page.add_table(table);
  }));
  CHECK(contains(text, "<p>as <code>dmpc &lt;b&gt;</code> does</p>"));
  CHECK(contains(text, "<td class=\"text\"><code>x</code></td>"));
  CHECK(contains(text, "<li><code>y</code></li>"));
  CHECK_FALSE(contains(text, "`"));
}

TEST_CASE("tables can be saved without a script") {
  const std::string text = page_with([](Page& page) { page.add_table(table_of(1)); });
  CHECK(contains(text, "href=\"data:text/csv;base64,"));
  CHECK(contains(text, "download=\"ta-ble.csv\""));
  CHECK(contains(text, data_url("text/csv", "na<me,time (s),count\na<b,0.125,1234567\n")));
}

TEST_CASE("a page says how it came about and how it is cited, with all that tells its run from others") {
  const std::string text = page_with([](Page& page) {
    page.add_origin({.command = "dmpc render '<a>.nff'",
                     .program = "dmpc 1.2 (release build)",
                     .date = "2026-11-22 21:40 UTC",
                     .computer = "2 processors",
                     .scene_digest = 0xabc},
                    {{"film", "1daa"}});
  });
  CHECK(contains(text, "<pre class=\"copy\">dmpc render &#39;&lt;a&gt;.nff&#39;</pre>"));
  CHECK(contains(text, "<dt>Film</dt>\n<dd>1daa</dd>"));
  CHECK(contains(text, "A &lt;title&gt;. dmpc 1.2, 2026-11-22, scene 0000000000000abc, film 1daa."));
}

TEST_CASE("words that occur on a page are explained at its end, and no others") {
  const std::string text = page_with([](Page& page) {
    page.begin_section("Faults");
    page.add_text("Service while busy time.");
  });
  CHECK(contains(text, "Glossary</h2>"));
  CHECK(contains(text, "<dt>fault</dt>"));
  CHECK(contains(text, "<dt>service while busy</dt>"));
  CHECK_FALSE(contains(text, "<dt>service while idle</dt>"));
}

}  // namespace dmpc::apps::html::page_page_test
