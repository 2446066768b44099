// Programs of one's own on ranks: what comes to the same as in one process, and what goes wrong.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/mpi/launched/mpirun.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/trace_events.h"

namespace dmpc::tests::programs_test {

namespace {

using Words = std::vector<std::string>;

std::string program_named(const std::string& name) { return std::string(DMPC_PROGRAMS) + "/" + name; }

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Said alone(const std::string& name, const Words& words) { return run(joined({program_named(name)}, words)); }

Said on_ranks(int ranks, const std::string& name, const Words& words, const std::string& way = shared_memory) {
  return run(mpirun_of(ranks, program_named(name), joined(words, {"--runner=mpi"}), way));
}

nlohmann::json json_in(const std::string& file) { return nlohmann::json::parse(file_text(file)); }

/// What all ranks end with, since it is said by rank 0 alone.
void check_program_fault(const std::string& name, const Words& words, int status, const std::string& text) {
  const TemporaryFolder folder;
  const Said ended = on_ranks(3, name, joined(words, {"--nodes=6", "--stats=" + (folder / "s.json").string()}));
  INFO(words.front());
  CHECK(ended.status == status);
  CHECK_MESSAGE(count(ended.errors, name + ": ") == 1, ended.errors);
  CHECK_MESSAGE(contains(ended.errors, text), ended.errors);
  CHECK(ended.output.empty());
  CHECK(folder.entry_count() == 0);
}

}  // namespace

TEST_CASE("a program comes to the same on any number of ranks, over shared memory and TCP, and disturbed") {
  for (const int ranks : {1, 2, 3, 5}) {
    CHECK(on_ranks(ranks, "requester", {"--nodes=6", "--quiet"}, ranks == 2 ? tcp : shared_memory).output == "sum 1710\n");
  }
  for (int seed = 0; seed < 4; ++seed) {
    INFO("seed ", seed);
    const std::string chaos = "--chaos=" + std::to_string(seed);
    CHECK(on_ranks(3, "requester", {"--nodes=7", "--quiet", chaos}).output == "sum 1995\n");
    CHECK(on_ranks(3, "tasks", {"--nodes=7", "--quiet", chaos, "--cache-pages=1"}).output == "sum 8000\n");
  }
}

TEST_CASE("the examples come to the same on ranks" * doctest::test_suite("slow")) {
  CHECK(contains(on_ranks(3, "ring_product", {"--size=64", "--nodes=4", "--quiet"}).output, "as expected"));
  CHECK(contains(on_ranks(3, "sample_sort", {"--keys=20000", "--nodes=5", "--quiet"}).output, "100000 keys, sorted"));
  CHECK(contains(on_ranks(3, "page_rank", {"--vertices=5000", "--nodes=6", "--quiet"}).output, "as in one memory"));
  const Said film = alone("image_parallel", {"--nodes=5", "--quiet"});
  CHECK(film.output.starts_with("film "));
  CHECK(on_ranks(3, "image_parallel", {"--nodes=5", "--quiet"}).output == film.output);
}

TEST_CASE("counters on ranks add up to those of one process, and say what went between ranks") {
  const TemporaryFolder folder;
  const std::string here = folder / "here.json", there = folder / "there.json";
  REQUIRE(alone("requester", {"--nodes=6", "--stats=" + here}).status == 0);
  const Said ended = on_ranks(3, "requester", {"--nodes=6", "--stats=" + there});
  REQUIRE_MESSAGE(ended.status == 0, ended.errors);
  CHECK(contains(ended.output, "6 nodes on ranks: "));
  CHECK(contains(ended.output, "; 60 packets between 3 ranks; "));
  const nlohmann::json one = json_in(here), several = json_in(there);
  CHECK(several["runner"] == "mpi");
  CHECK(one["ranks"].is_null());
  CHECK(several["ranks"].size() == 3);
  CHECK(several["ranks"][0]["packets"]["sent"] == 20);
  for (const std::string key : {"result", "packets", "operations"}) {
    CHECK(one[key] == several[key]);
  }
  for (std::size_t node = 0; node < 6; ++node) {
    CHECK(one["per_node"][node]["operations"] == several["per_node"][node]["operations"]);
    CHECK(one["per_node"][node]["memory_bytes"] == several["per_node"][node]["memory_bytes"]);
  }
}

TEST_CASE("pages, references and results of tasks on ranks are those of one process") {
  const TemporaryFolder folder;
  const auto words = [&](const std::string& name) -> Words {
    return {"--tasks=5000",
            "--nodes=5",
            "--in-flight=1",
            "--cache-pages=3",
            "--stats=" + (folder / (name + ".json")).string(),
            "--references=" + (folder / (name + ".csv")).string()};
  };
  REQUIRE(alone("tasks", words("here")).status == 0);
  const Said ended = on_ranks(3, "tasks", words("there"));
  REQUIRE_MESSAGE(ended.status == 0, ended.errors);
  CHECK(file_text(folder / "here.csv") == file_text(folder / "there.csv"));
  const nlohmann::json one = json_in(folder / "here.json"), several = json_in(folder / "there.json");
  for (const std::string key : {"result", "runs", "tasks", "pages", "packets"}) {
    CHECK(one[key] == several[key]);
  }
  CHECK(one["pages"]["faults"] > 0);
  CHECK(several["ranks"].size() == 3);
}

TEST_CASE("a trace of ranks has the spans and messages of all nodes") {
  const TemporaryFolder folder;
  for (const auto& [name, once] : {std::pair<std::string, std::string>{"requester", "--questions=10"}, {"tasks", "--rounds=1"}}) {
    const std::string file = folder / (name + ".pftrace"), stats = folder / (name + "-stats.json");
    const Said ended = on_ranks(3, name, {"--nodes=6", once, "--trace=" + file, "--stats=" + stats});
    REQUIRE_MESSAGE(ended.status == 0, ended.errors);
    const std::vector<TraceEvent> trace = trace_events(file_text(file));
    std::set<std::uint64_t> nodes;
    for (const TraceEvent& event : trace) {
      if (event.type == TraceEvent::Type::slice_begin && event.track <= 6) {
        nodes.insert(event.track);
      }
    }
    CHECK_MESSAGE(nodes.size() == 6, name);
    std::size_t packets = 0;
    const nlohmann::json counted = json_in(stats);
    for (const nlohmann::json& kind : counted["packets"]) {
      packets += kind["packets"].get<std::size_t>();
    }
    CHECK_MESSAGE(messages_in_order(trace) == packets, name);
  }
}

TEST_CASE("pages for a browser have the nodes of all ranks, and the heat of tasks is that of one process" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  for (const std::string name : {"requester", "tasks"}) {
    const std::string file = folder / (name + ".html");
    const Said ended = on_ranks(3, name, {"--nodes=6", "--report=" + file});
    REQUIRE_MESSAGE(ended.status == 0, ended.errors);
    const std::string page = file_text(file);
    for (const std::string part :
         {"threads on ranks, one a node", "How busy each node was over time", "<caption>Ranks</caption>", "rank 2 on host "}) {
      CHECK_MESSAGE(contains(page, part), name);
    }
  }
  CHECK(contains(file_text(folder / "requester.html"), "Who sent packets to whom"));
  CHECK(contains(file_text(folder / "tasks.html"), "Who fetched pages from whom"));
  const auto heat = [&](const std::string& name) -> Words {
    return {"--nodes=6", "--in-flight=1", "--cache-pages=1", "--heat=" + (folder / name).string()};
  };
  REQUIRE(alone("tasks", heat("here.csv")).status == 0);
  REQUIRE(on_ranks(3, "tasks", heat("there.csv")).status == 0);
  CHECK(file_text(folder / "here.csv") == file_text(folder / "there.csv"));
}

TEST_CASE("what a program does wrong on ranks is said once, and ends all of them" * doctest::test_suite("slow")) {
  check_program_fault("requester", {"--fault=13"}, 3, "what it threw is no std::exception");
  check_program_fault("requester", {"--fault=5"}, 3, "a packet 'question' of 80 bytes");
  check_program_fault("requester", {"--fault=2"}, 3, "had no answer 'square'");
  check_program_fault("requester", {"--fewer=1"}, 1, "needs of the program");
  check_program_fault("requester", {"--node-memory=1KiB"}, 4, "--node-memory=1024");
  check_program_fault("requester", {"--questions=x"}, 2, "--questions");
  check_program_fault("tasks", {"--fault=7"}, 2, "--fault=7: no such use");
}

TEST_CASE("nodes of several ranks that stand still are found out, with the circle in which they wait") {
  const Said ended = on_ranks(3, "requester", {"--nodes=3", "--fault=1"});
  CHECK(ended.status == 3);
  CHECK_MESSAGE(contains(ended.errors, "node 1: 2 asked; waits for 2 'square' of node 2; owes 2 'square' to node 0\n"),
                ended.errors);
  CHECK_MESSAGE(contains(ended.errors, "in a circle: node 0 waits for node 1, that for node 2, that for node 0\n"), ended.errors);
}

TEST_CASE("ranks whose acts part are found out before anything waits for ever" * doctest::test_suite("slow")) {
  const std::string parted = ": the ranks have parted: here comes ";
  check_program_fault("tasks", {"--fault=1"}, 3, parted + "the end, on rank 0 on host ");
  check_program_fault("tasks", {"--fault=2"}, 3, parted + "run 4 of 1,000 tasks of 64 B over 4.0 KiB of data ");
  check_program_fault("tasks", {"--fault=3"}, 3, parted + "run 2 of 1,000 tasks of 64 B over 4.0 KiB of data ");
  check_program_fault("tasks", {"--fault=4"}, 3, "rank 1 on host ");
  check_program_fault("tasks", {"--fault=4"}, 3, ": this rank cannot go on");
  check_program_fault("tasks", {"--fault=5"}, 3, "task 500 fails");
}

TEST_CASE("ranks that take their time between runs are waited for") {
  const Said ended = on_ranks(3, "tasks", {"--nodes=6", "--fault=6", "--quiet"});
  CHECK(ended.status == 0);
  CHECK(ended.output == "sum 8000\n");
}

TEST_CASE("as many nodes as there are processors for them are made where nobody says, and fewer than ranks are refused") {
  CHECK(on_ranks(3, "tasks", {"--quiet"}).output == "sum 8000\n");
  check_program_fault("tasks", {"--rounds=1", "--tasks=1", "--cache-pages=0"}, 2, "--cache-pages");
  const Said ended = on_ranks(3, "requester", {"--nodes=2"});
  CHECK(ended.status == 2);
  CHECK_MESSAGE(contains(ended.errors, "requester: --nodes=2: expected at least one node for each of the 3 ranks"), ended.errors);
}

TEST_CASE("a process that is alone on ranks says so, unless it is to be quiet") {
  const std::string said = "requester: --runner=mpi: this is the only process, so that all nodes are in it\n";
  CHECK(contains(on_ranks(1, "requester", {"--nodes=2"}).errors, said));
  CHECK_FALSE(contains(on_ranks(1, "requester", {"--nodes=2", "--quiet"}).errors, said));
}

TEST_CASE("processes that are started together without --runner=mpi are told of it once") {
  const Said ended = run(mpirun_of(3, program_named("requester"), {}));
  CHECK(ended.status == 2);
  CHECK(count(ended.errors, "requester: ") == 1);
  CHECK_MESSAGE(contains(ended.errors, "mpirun has started 3 processes"), ended.errors);
  CHECK(contains(ended.errors, "or let them run it together: --runner=mpi"));
}

TEST_CASE("what does not go with ranks is refused") {
  for (const std::string option : {"--machine=hdr", "--topology=mesh"}) {
    const Said ended = on_ranks(2, "requester", {option});
    CHECK(ended.status == 2);
    CHECK_MESSAGE(contains(ended.errors, " does not go with --runner=mpi: ranks run on a real machine"), ended.errors);
  }
}

TEST_CASE("a program of one's own takes no module from around it, but from where it was linked to take it") {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  const fs::path program = folder / "bin/requester", module = fs::path(DMPC_PROGRAM).parent_path() / "dmpc_mpi.so";
  for (const std::string place : {"bin", "apps", "lib/dmpc"}) {
    fs::create_directories(folder / place);
    fs::copy_file(module, folder / place / "dmpc_mpi.so");
  }
  fs::copy_file(program_named("requester"), program);
  const Said ended = run({program, "--nodes=2", "--runner=mpi"});
  CHECK(ended.status == 3);
  CHECK_MESSAGE(contains(ended.errors, "is in none of its places"), ended.errors);
}

}  // namespace dmpc::tests::programs_test
