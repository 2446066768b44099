// Programs of tasks over pages as their users meet them, on every runner.
#include <doctest/doctest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/frontend/show/references/reference_file.h"
#include "svm/pages/observers/miss_curve.h"
#include "tests/apps/computer/adder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::pages_test {

TEST_CASE("tasks come to the same on threads and machines, with any nodes, pages, caches and policies, and disturbed") {
  const std::string expected = "sum " + std::to_string(expected_sum()) + "\n";
  for (const Lines& words :
       std::vector<Lines>{{"--nodes=1"},
                          {"--nodes=64", "--page-size=512"},
                          {"--nodes=3", "--cache-pages=1"},
                          {"--nodes=4", "--cache-pages=2", "--in-flight=1"},
                          {"--nodes=4", "--runner=virtual"},
                          {"--nodes=4", "--runner=virtual", "--machine=hdr", "--replacement=arc", "--cache-pages=3"}}) {
    const Ran done = run_adding(adding(), words);
    CHECK_MESSAGE(done.status == 0, done.errors);
    CHECK(done.output.starts_with(expected));
    CHECK(done.output.find("1,000 look-ups") != std::string::npos);
  }
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed ", seed);
    CHECK(run_adding(adding(), {"--nodes=4", "--cache-pages=1", "--chaos=" + std::to_string(seed), "--quiet"}).output ==
          expected);
  }
}

TEST_CASE("what a task does that it may not ends the run, and is said") {
  const std::vector<std::pair<Misdeed, std::string>> misdeeds = {
      {Misdeed::looks_between, "the place 4 is looked up: expected a multiple of 8 within 16384 bytes"},
      {Misdeed::looks_beyond, "the place 16777216 is looked up: expected a multiple of 8 within 16384 bytes"},
      {Misdeed::waits_for_nothing, "a task says that a page is absent, but all that it looked up was there"},
      {Misdeed::charges_what_is_not_declared, "operation 1 is charged: 1 are declared"}};
  for (const auto& [misdeed, message] : misdeeds) {
    for (const std::string runner : {"threads", "virtual"}) {
      const Ran done = run_adding(adding(1, misdeed), {"--nodes=2", "--runner=" + runner});
      CHECK(done.status == 3);
      CHECK_MESSAGE(done.complains("adder: the program: " + message), done.errors);
      CHECK(done.output.empty());
    }
  }
  CHECK(run_adding(adding(0), {}).complains("the program: no tasks were run"));
}

TEST_CASE("a program's operations have their price beside those of pages, and a modelled run is repeated to the last event") {
  const Lines words = {"--nodes=4", "--runner=virtual", "--machine=hdr", "--cache-pages=2"};
  const nlohmann::json stats = adding_stats(adding(), words), again = adding_stats(adding(), words);
  CHECK(stats["run_hash"].is_string());
  CHECK(stats["run_hash"] == again["run_hash"]);
  CHECK(stats["operations"]["addition"] == adders * additions_a_task);
  const nlohmann::json free = adding_stats(adding(1, Misdeed::none, 0), words);
  const auto computing_ns = [](const nlohmann::json& of) { return of["computing_ns"].get<std::int64_t>(); };
  CHECK(computing_ns(free) > 0);
  CHECK(free["pages"]["references"] == stats["pages"]["references"]);
  CHECK(computing_ns(stats) >= 10 * adders * additions_a_task);
}

TEST_CASE("counters add up over nodes and runs") {
  const Lines words = {"--nodes=3", "--cache-pages=2", "--runner=virtual"};
  const nlohmann::json once = adding_stats(adding(), words), twice = adding_stats(adding(2), words);
  CHECK(once["format"] == 2);
  CHECK(once["page_count"] == 16);
  CHECK(once["cache_pages"] == 2);
  CHECK(twice["runs"] == 2);
  CHECK(twice["tasks"] == 2 * adders);
  for (const std::string key : {"references", "home_hits", "cache_hits", "misses", "faults", "evictions", "served"}) {
    std::uint64_t of_nodes = 0;
    for (const nlohmann::json& node : once["per_node"]) {
      of_nodes += node["pages"][key].get<std::uint64_t>();
    }
    CHECK(once["pages"][key] == of_nodes);
    CHECK(twice["pages"][key] == 2 * of_nodes);
  }
  CHECK(once["pages"]["references"] == adders * additions_a_task);
  CHECK(once["packets"]["page_request"]["packets"] == once["pages"]["faults"]);
  CHECK(once["packets"]["page_reply"]["packets"] == once["pages"]["faults"]);
}

TEST_CASE("references are those of the last run, and tell what an lru cache of any size faults") {
  const TemporaryFolder folder;
  const std::string file = folder / "references.csv";
  REQUIRE(run_adding(adding(2), {"--nodes=2", "--references=" + file}).status == 0);
  const apps::ReferenceTrace trace = apps::read_references(file);
  REQUIRE(trace.nodes.size() == 2);
  for (const int cache_pages : {1, 3, 5}) {
    const nlohmann::json stats =
        adding_stats(adding(), {"--nodes=2", "--in-flight=1", "--cache-pages=" + std::to_string(cache_pages)});
    for (std::size_t node = 0; node < 2; ++node) {
      CHECK(stats["per_node"][node]["pages"]["faults"] ==
            svm::MissCurve(trace.nodes[node]).misses(static_cast<std::uint32_t>(cache_pages)));
    }
  }
}

TEST_CASE("a trace of tasks shows their operations, and pages that come") {
  const TemporaryFolder folder;
  REQUIRE(run_adding(adding(2), {"--nodes=2", "--runner=virtual", "--trace=" + (folder / "a.pftrace").string()}).status == 0);
  const std::string text = file_text(folder / "a.pftrace");
  for (const char* part : {"addition", "compute", "page_request", "page_reply"}) {
    CHECK_MESSAGE(text.find(part) != std::string::npos, part);
  }
  CHECK(text.find("shade") == std::string::npos);
}

TEST_CASE("pages and caches that cannot be are refused in the words of the options") {
  const auto refused = [](const Lines& words, int status, const std::string& message) {
    const Ran done = run_adding(adding(), words);
    CHECK(done.status == status);
    CHECK_MESSAGE(done.complains(message), done.errors);
  };
  refused({"--page-size=700"}, 2, "--page-size=700: expected a power of two from 512B to 64KiB");
  refused({"--cache-pages=0"}, 2, "--cache-pages=0");
  refused({"--references=r.csv", "--in-flight=2"}, 2, "--references goes with --in-flight=1");
  refused({"--replacement=mru"}, 2, "--replacement=mru");
  refused({"--node-memory=1KiB"}, 4, "--node-memory=1KiB: a node takes ");
  refused({"--stats=/none/stats.json"}, 1, "/none/stats.json");
  PagedApplication greedy = adding();
  greedy.operations.assign(9, {"addition", 1});
  CHECK(run_adding(greedy, {}).complains("9 operations are declared: a program of tasks has at most 8"));
  PagedApplication unclear = adding();
  unclear.operations = {{"addition", 1}, {"addition", 2}};
  CHECK(run_adding(unclear, {}).complains("two operations are called 'addition'"));
  unclear.operations = {{"addition", -1}};
  CHECK(run_adding(unclear, {}).complains("the operation 'addition' takes -1 ns: expected 0 to 1,000,000"));
  const std::string help = run_adding(adding(), {"--help"}).output;
  for (const char* part :
       {"Usage: adder [options]", "--cache-pages", "--replacement", "--references", "--heat", "--report", "Add entries"}) {
    CHECK_MESSAGE(help.find(part) != std::string::npos, part);
  }
}

}  // namespace dmpc::tests::pages_test
