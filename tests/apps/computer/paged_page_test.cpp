// The page of a program of tasks as its user gets it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/computer/adder.h"
#include "tests/apps/computer/reported.h"

namespace dmpc::tests::paged_page_test {

namespace {

std::string adder_page(const PagedApplication& application, const std::vector<std::string>& words) {
  return reported([&](const std::vector<std::string>& all) { return run_adding(application, all); }, words);
}

}  // namespace

TEST_CASE("the page of tasks has their heat, what pages travelled, what a fetch takes and what other caches would miss") {
  const std::string page = adder_page(adding(), {"--nodes=4", "--runner=virtual", "--machine=hdr", "--cache-pages=2"});
  check_has(page, {"<title>Run of adder</title>", "<dd>50 in 1 run</dd>", "<dd>16 pages of 1KiB</dd>",
                   "<dd>2 pages, replaced by lru</dd>", "page wait", "What each task took</h2>", "The faults of each task",
                   "The look-ups of each task", "The computing of each task", "Who fetched pages from whom", "The hottest pages",
                   "What fetching a page takes", "Faults by the size of the caches", "addition", "What each node did",
                   "page reply", "<dt>Run</dt>"});
  CHECK(contains(page, " of 1,000 look-ups missed ("));
  CHECK_FALSE(contains(page, "Of the last of"));
  check_knows_no_rays(page);
}

TEST_CASE("of several runs the counters are of all of them, and what was watched is of the last, as the page says") {
  const std::string page = adder_page(adding(3), {"--nodes=2", "--runner=virtual", "--cache-pages=2"});
  check_has(page,
            {"<dd>150 in 3 runs</dd>", "Of the last of 3 runs.",
             "Times and counters are of all 3 runs together, where it does not say otherwise.", " of 1,000 look-ups missed ("});
  const std::string stats = adding_stats(adding(3), {"--nodes=2", "--runner=virtual", "--cache-pages=2"})["run_hash"];
  CHECK(contains(page, stats));
}

TEST_CASE("on threads there is no computing of tasks, and time is the wall clock's") {
  const std::string page = adder_page(adding(), {"--nodes=2", "--cache-pages=2"});
  check_has(page, {"The look-ups of each task", "waiting for a core", "The tasks with the most look-ups"});
  CHECK_FALSE(contains(page, "The computing of each task"));
}

TEST_CASE("a node alone fetches nothing, and the page says so") {
  const std::string page = adder_page(adding(), {"--nodes=1", "--runner=virtual"});
  check_has(page, {"No page was fetched: each node found all that it looked up at home.", "No packet was sent."});
  CHECK_FALSE(contains(page, "Fetching a page</h2>"));
  CHECK_FALSE(contains(page, "The faults of each task"));
}

TEST_CASE("more nodes than tasks, and tasks whose page is of one place each, have a page") {
  CHECK(contains(adder_page(adding(), {"--nodes=64", "--runner=virtual", "--page-size=512"}), "<dd>64 nodes of"));
}

TEST_CASE("operations are shown under the names that they have, whatever these contain") {
  PagedApplication program = adding();
  program.operations = {{"<script>", 1}, {"faults", 1}, {"'it''s'", 1}};
  const std::string page = adder_page(program, {"--nodes=2", "--runner=virtual"});
  CHECK(count(page, "<script>") == 1);  // the page's own; others are data
  check_has(page, {"&lt;script&gt;", "&#39;faults&#39;"});
}

TEST_CASE("a report changes nothing of the runs, and goes with references and a trace") {
  const TemporaryFolder folder;
  const Lines words = {"--nodes=3", "--runner=virtual", "--cache-pages=2", "--in-flight=1"};
  Lines watched = words;
  watched.insert(watched.end(), {"--report=" + (folder / "page.html").string(), "--heat=" + (folder / "heat.csv").string(),
                                 "--references=" + (folder / "r.csv").string(), "--trace=" + (folder / "t.pftrace").string()});
  CHECK(adding_stats(adding(2), watched)["run_hash"] == adding_stats(adding(2), words)["run_hash"]);
  CHECK(file_text(folder / "r.csv").size() > 100);
  CHECK(contains(file_text(folder / "t.pftrace"), "addition"));
}

}  // namespace dmpc::tests::paged_page_test
