// Programs of one's own as their users meet them, on every runner.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/computer/requester.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::computer_run_test {

namespace {

using Words = std::vector<std::string>;

bool says(const Ran& ran, const std::string& part) { return ran.complains(part); }

nlohmann::json stats_of(const Application<Requester>& application, Words words) {
  const TemporaryFolder folder;
  const std::string file = folder / "stats.json";
  words.push_back("--stats=" + file);
  const Ran ran = run_with(application, words);
  REQUIRE_MESSAGE(ran.status == 0, ran.errors);
  return nlohmann::json::parse(file_text(file));
}

}  // namespace

TEST_CASE("a program comes to the same on threads, on a pool, on modelled machines, with any number of nodes, and disturbed") {
  const Application<Requester> program = requester(10);
  for (const Words& words : std::vector<Words>{{"--nodes=4"},
                                               {"--nodes=4", "--runner=pool"},
                                               {"--nodes=4", "--runner=pool", "--pool-threads=1"},
                                               {"--nodes=4", "--runner=virtual"},
                                               {"--nodes=4", "--runner=virtual", "--machine=hdr", "--topology=mesh"}}) {
    const Ran ran = run_with(program, words);
    CHECK(ran.status == 0);
    CHECK(ran.output.starts_with("sum " + std::to_string(4 * 285) + "\n"));
    CHECK(ran.output.find("80 packets") != std::string::npos);
  }
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed ", seed);
    const std::string chaos = "--chaos=" + std::to_string(seed);
    CHECK(run_with(program, {"--nodes=4", chaos, "--quiet"}).output == "sum 1140\n");
    CHECK(run_with(program, {"--nodes=4", chaos, "--runner=pool", "--pool-threads=2", "--quiet"}).output == "sum 1140\n");
  }
  CHECK(run_with(program, {"--nodes=1", "--quiet"}).output == "sum 285\n");
  CHECK(run_with(program, {"--nodes=64", "--quiet"}).output == "sum 18240\n");
}

TEST_CASE("what a program does that it has not declared ends the run, and is said") {
  const std::vector<std::pair<Fault, std::string>> faults = {
      {Fault::leaves_unanswered, "2 packets 'question' had no answer 'square' when all nodes had finished"},
      {Fault::answers_twice, "the packet 'square' to node "},
      {Fault::sends_answer, "the packet 'square' is an answer: answer() sends it"},
      {Fault::sends_too_much, "a packet 'question' of 80 bytes: at most 56 are declared"},
      {Fault::names_no_packet, "packet 2 to node "},
      {Fault::names_no_node, "to node 2: there are 2 packets and 2 nodes"},
      {Fault::charges_nothing_declared, "operation 1 is charged: 1 are declared"},
      {Fault::allocates_too_much, "the memory 'sums' has 0 of 64 bytes left: 64 are asked for"},
      {Fault::allocates_all_there_could_be, "the memory 'sums' has 0 of 64 bytes left: 18446744073709551552 are asked for"},
      {Fault::allocates_late, "the memory 'late' is asked for after the start"},
      {Fault::takes_for_other, "a packet of 4 bytes is copied to 1 values of 8"},
      {Fault::throws_a_number, "what it threw is no std::exception"}};
  for (const auto& [fault, message] : faults) {
    for (const std::string runner : {"threads", "pool", "virtual"}) {
      const Ran ran = run_with(requester(10, fault), {"--nodes=2", "--runner=" + runner});
      CHECK(ran.status == 3);
      CHECK(says(ran, "requester: the program: "));
      CHECK_MESSAGE(says(ran, message), ran.errors);
      CHECK(ran.output.empty());
    }
  }
}

TEST_CASE("a program without needs is told to declare them, and its name stands before what it says") {
  Application<Requester> program = requester(1);
  program.needs = {};
  const Ran ran = run_with(program, {"--nodes=2"});
  CHECK(ran.status == 3);
  CHECK(says(ran, "requester: the program: it declares no needs"));
}

TEST_CASE("nodes that stand still are found out, with what each says of itself, who waits for whom, and in which circle") {
  for (const std::string runner : {"threads", "pool", "virtual"}) {
    const Ran ran = run_with(requester(10, Fault::answers_nothing, 3), {"--nodes=3", "--runner=" + runner});
    CHECK(ran.status == 3);
    for (const std::string line : {"node 0: 3 asked; waits for 3 'square' of node 1; owes 3 'square' to node 2\n",
                                   "node 1: 3 asked; waits for 3 'square' of node 2; owes 3 'square' to node 0\n",
                                   "in a circle: node 0 waits for node 1, that for node 2, that for node 0\n"}) {
      CHECK_MESSAGE(says(ran, line), ran.errors);
    }
  }
}

TEST_CASE("a modelled run is repeated to the last event, and its operations have their price") {
  const Words words = {"--nodes=4", "--runner=virtual", "--machine=hdr"};
  const nlohmann::json first = stats_of(requester(10), words), again = stats_of(requester(10), words);
  CHECK(first["run_hash"].is_string());
  CHECK(first["run_hash"] == again["run_hash"]);
  CHECK(first["virtual_seconds"] == again["virtual_seconds"]);
  CHECK(first["run_hash"] != stats_of(requester(11), words)["run_hash"]);
  // 10 of 100 ns each, on a core of today.
  CHECK(first["per_node"][2]["virtual_time"]["computing_ns"] == 1000);
  CHECK(first["per_node"][2]["operations"]["multiplication"] == 10);
}

TEST_CASE("counters add up: by packet, by node and by piece of memory") {
  const nlohmann::json stats = stats_of(requester(10), {"--nodes=3", "--node-memory=1MiB"});
  CHECK(stats["format"] == 2);
  CHECK(stats["program"] == "requester");
  CHECK(stats["result"] == "sum 855");
  CHECK(stats["runner"] == "threads");
  CHECK(stats["machine"].is_null());
  CHECK(stats["packets"]["question"]["packets"] == 30);
  CHECK(stats["packets"]["square"]["bytes"] == 30 * (8 + 4));
  CHECK(stats["operations"]["multiplication"] == 30);
  std::size_t sent = 0, received = 0;
  for (const nlohmann::json& node : stats["per_node"]) {
    sent += node["packets_sent"].get<std::size_t>();
    received += node["packets_received"].get<std::size_t>();
    const nlohmann::json& bytes = node["memory_bytes"];
    CHECK(bytes["of_program"]["sums"] == 64);
    CHECK(bytes["of_program"]["late"] == 0);
    CHECK(bytes["total"] ==
          bytes["mailbox"].get<std::size_t>() + bytes["queues"].get<std::size_t>() + bytes["stack"].get<std::size_t>() + 64 + 64);
  }
  CHECK(sent == 60);
  CHECK(received == 60);
}

TEST_CASE("a trace calls packets and operations as the program does, and what has none computing") {
  const TemporaryFolder folder;
  const std::string file = folder / "trace.pftrace";
  REQUIRE(run_with(requester(10), {"--nodes=2", "--runner=virtual", "--trace=" + file}).status == 0);
  const std::string text = file_text(file);
  for (const char* const name : {"question", "multiplication", "compute"}) {
    CHECK_MESSAGE(count(text, name) >= 1, name);
  }
  CHECK(text.find("shade") == std::string::npos);
}

TEST_CASE("options that do not go together, or are none, are refused with a hint at the program's own help") {
  const auto complaint = [](const Words& words) {
    const Ran ran = run_with(requester(1), words);
    CHECK(ran.status == 2);
    return ran.errors;
  };
  CHECK(complaint({"--machine=hdr"}).find("--machine does not go with --runner=threads") != std::string::npos);
  CHECK(complaint({"--topology=mesh"}).find("--topology does not go with --runner=threads") != std::string::npos);
  CHECK(complaint({"--pool-threads=2"}).find("--pool-threads does not go with --runner=threads") != std::string::npos);
  CHECK(complaint({"--runner=virtual", "--pool-threads=2"}).find("--pool-threads does not go with --runner=virtual") !=
        std::string::npos);
  CHECK(complaint({"--chaos=1", "--runner=virtual"}).find("chaos disturbs threads only") != std::string::npos);
  CHECK(complaint({"--trace=a.txt"}).find("--trace=a.txt: expected a file with the ending .pftrace") != std::string::npos);
  CHECK(complaint({"--trace=a.json"}).find("traceconv json a.pftrace a.json") != std::string::npos);
  CHECK(complaint({"--node=3"}).find("Try: requester --help") != std::string::npos);
  CHECK(complaint({"word"}).find("expected requester") != std::string::npos);
  CHECK(run_with(requester(1), {"--runner=virtual", "--machine=none"}).status == 1);
  CHECK(run_with(requester(1), {"--stats=/none/stats.json"}).status == 1);
  CHECK(run_with(requester(1), {"--node-memory=1KiB"}).status == 4);
}

TEST_CASE("a program has options of its own, which its needs may refuse") {
  std::uint32_t size = 12;
  Application<Requester> program = requester(1);
  program.options = {{"--size", &size, 1, 100, "How large"}};
  program.needs = [&size, needs = program.needs](std::uint32_t nodes) {
    if (size % nodes != 0) {
      throw UsageError("--size=" + std::to_string(size) + " is no multiple");
    }
    return needs(nodes);
  };
  CHECK(run_with(program, {"--nodes=3"}).status == 0);
  const Ran refused = run_with(program, {"--nodes=3", "--size=20"});
  CHECK(refused.status == 2);
  CHECK(refused.errors == "requester: --size=20 is no multiple\n");
  CHECK(run_with(program, {"--size=101"}).status == 2);
  const std::string help = run_with(program, {"--help"}).output;
  for (const char* part : {"Usage: requester [options]", "--size 1..100 [20]", "--runner", "--stats", "Ask for squares"}) {
    CHECK_MESSAGE(help.find(part) != std::string::npos, part);
  }
}

}  // namespace dmpc::tests::computer_run_test
