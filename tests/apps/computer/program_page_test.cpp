// The page of a program with packets as its user gets it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/computer/reported.h"
#include "tests/apps/computer/requester.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::program_page_test {

namespace {

std::string requester_page(const Application<Requester>& application, const std::vector<std::string>& words) {
  return reported([&](const std::vector<std::string>& all) { return run_with(application, all); }, words);
}

}  // namespace

TEST_CASE("the page of a modelled run says what it was, came to, took and lost, in the program's words") {
  const std::string page = requester_page(requester(10), {"--nodes=3", "--runner=virtual", "--machine=hdr"});
  check_has(page, {"<title>Run of requester</title>", "<pre class=\"copy\">sum 855</pre>", "<dd>3 nodes of hdr</dd>",
                   "virtual, in the time of a modelled hdr", "Where the time went</h2>", "waiting for square", "Over time</h2>",
                   "Who sent packets to whom", "Who sent bytes to whom", "The busiest links", "multiplication",
                   "each on this machine", "What each node did", "Memory of each node", "sums", "<dt>Run</dt>"});
  // 10 questions and 10 squares of each node; the second number is of bytes, with heads.
  check_has(page, {"60 packets, 720 B, of which 50 % are of kind &quot;question&quot;.", "<td>30</td>"});
}

TEST_CASE("the page of a run on threads is of the wall clock, and says by what it was disturbed") {
  const std::string page = requester_page(requester(10), {"--nodes=2", "--chaos=7"});
  check_has(page, {"<dd>2 nodes on threads</dd>", "disturbed by seed 7", "waiting for a core", "Wall clock. Asleep: "});
  CHECK_FALSE(contains(page, "The busiest links"));
  CHECK_FALSE(contains(page, "each on this machine"));
}

TEST_CASE("the page says how to make it again") {
  const std::string page = requester_page(requester(1), {"--nodes=2"});
  check_has(page, {"To reproduce and to cite it</h2>", "requester on dmpc ", "Run of requester. requester on dmpc "});
}

// On the page stands the command line, too: with this name, where a test is called by it.
TEST_CASE("a page speaks the words of programs alone") {
  const std::string page = requester_page(requester(10), {"--nodes=3", "--runner=virtual"});
  check_knows_no_rays(page);
}

TEST_CASE("a node alone sends to itself, and has a page, too") {
  const std::string page = requester_page(requester(10), {"--nodes=1", "--runner=virtual"});
  check_has(page, {"20 packets", "<dd>1 node of"});
  CHECK_FALSE(contains(page, "Who sent packets to whom"));
}

TEST_CASE("of more nodes than can be told apart a page does not show who sends to whom, and says so; bars become bands") {
  const std::string many = requester_page(requester(1), {"--nodes=257", "--runner=virtual"});
  check_has(many, {"The traffic of pairs is shown of up to 256 nodes", "What each node did"});
  const std::string few = requester_page(requester(1), {"--nodes=256", "--runner=virtual"});
  CHECK_FALSE(contains(many, "Who sent packets to whom"));
  CHECK(contains(few, "Who sent packets to whom"));
  for (const std::string& page : {few, many}) {
    check_has(page, {"Plot: Where each node", "Plot: Memory of each node", "Over all nodes: the line is"});
  }
}

TEST_CASE("names and results are shown as they are, whatever they contain") {
  Application<Requester> program = requester(10);
  program.needs = [needs = program.needs](std::uint32_t nodes) {
    Needs hostile = needs(nodes);
    hostile.packets[0].name = "<b>'quest\"ion', & co";
    hostile.packets[1].answers = hostile.packets[0].name;
    hostile.packets[1].name = "'squ\"are'";  // for which nodes wait
    hostile.operations[0].name = "node";
    hostile.memory[0].name = "<script>";
    hostile.memory[1].name = "a \"late\" one";
    return hostile;
  };
  program.result = [](const std::vector<std::uint64_t>&) { return std::string("<script>alert(1)</script>\n\xff"); };
  const std::string page = requester_page(program, {"--nodes=3", "--runner=virtual"});
  CHECK(count(page, "<script>") == 1);  // the page's own
  for (const std::string plot : {"Plot: Where each node", "Plot: Memory of each node"}) {
    CHECK_MESSAGE(contains(page, plot), plot);
  }
  CHECK_FALSE(contains(page, "<b>"));
  check_has(page, {"&lt;b&gt;&#39;quest&quot;ion&#39;, &amp; co", "&lt;script&gt;alert(1)", "&#39;node&#39;", "\xef\xbf\xbd"});
}

TEST_CASE("a program that declares no operations and no memory has a page without them") {
  Application<Requester> program = requester(0);
  program.needs = [needs = program.needs](std::uint32_t nodes) {
    Needs few = needs(nodes);
    few.operations.clear();
    return few;
  };
  program.result = {};
  const std::string page = requester_page(program, {"--nodes=2"});
  check_has(page, {"No packet was sent.", "Memory of each node"});
  CHECK_FALSE(contains(page, "Operations</h2>"));
  CHECK_FALSE(contains(page, "What it came to"));
}

TEST_CASE("a report changes nothing of the run, and goes with a trace") {
  const TemporaryFolder folder;
  const auto hash = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--nodes=3", "--runner=virtual", "--stats=" + (folder / "stats.json").string()});
    REQUIRE(run_with(requester(10), words).status == 0);
    return nlohmann::json::parse(file_text(folder / "stats.json"))["run_hash"].get<std::string>();
  };
  const std::string page = "--report=" + (folder / "page.html").string(), trace = "--trace=" + (folder / "t.pftrace").string();
  CHECK(hash({page}) == hash({}));
  CHECK(hash({page, trace}) == hash({}));
  CHECK(contains(file_text(folder / "t.pftrace"), "multiplication"));
  check_has(file_text(folder / "page.html"), {"Over time</h2>", "Who sent packets to whom"});
}

TEST_CASE("a report that is no page, or cannot be written, is refused before the run") {
  CHECK(run_with(requester(1), {"--report=page.txt"}).complains("--report=page.txt: expected a file with the ending .html"));
  CHECK(run_with(requester(1), {"--report=/none/page.html"}).status == 1);
  CHECK(run_with(requester(1), {"--report=a.html", "--stats=a.html"}).status == 2);
}

}  // namespace dmpc::tests::program_page_test
