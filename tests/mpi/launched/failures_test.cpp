// What goes wrong on several ranks is said once, and ends all of them.
#include <doctest/doctest.h>

#include <dirent.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/mpi/launched/mpirun.h"
#include "tests/support/film_in.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::failures_test {

namespace {

namespace fs = std::filesystem;

/// A process of this rank among the children of mpirun; 0 if there is none.
pid_t process_of_rank(pid_t mpirun, int rank) {
  const std::string mark = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
  std::istringstream children(file_text("/proc/" + std::to_string(mpirun) + "/task/" + std::to_string(mpirun) + "/children"));
  for (pid_t child = 0; children >> child;) {
    const std::string surroundings = file_text("/proc/" + std::to_string(child) + "/environ");
    if (surroundings.find(mark + '\0') != std::string::npos) {
      return child;
    }
  }
  return 0;
}

/// Waits a minute at most.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int attempt = 0; attempt < 6000; ++attempt) {
    if (condition()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

void check_said_once(const std::vector<std::string>& arguments, int status, const std::string& text) {
  const TemporaryFolder folder;
  std::vector<std::string> line = arguments;
  line.insert(line.end(), {"--runner=mpi", "-o", folder / "a.png"});
  const Said ended = run(mpirun(3, line));
  CHECK(ended.status == status);
  CHECK_MESSAGE(count(ended.errors, "dmpc: ") == 1, ended.errors);
  CHECK_MESSAGE(contains(ended.errors, text), ended.errors);
  CHECK(folder.entry_count() == 0);
}

}  // namespace

TEST_CASE("a scene that is not there is said by rank 0 alone") {
  check_said_once({"render", "/nowhere/scene.nff"}, 1, "/nowhere/scene.nff");
}

TEST_CASE("fewer nodes than ranks are refused before anything is read") {
  check_said_once({"render", "tetra-3", "--nodes=2"}, 2, "--nodes");
}

TEST_CASE("too little memory of nodes is an error that names what would do") {
  check_said_once({"render", "tetra-6", "--nodes=4", "--node-memory=1KiB"}, 4, "memory");
}

TEST_CASE("a computer without room for its nodes ends all before the run, and is named with its rank") {
  const TemporaryFolder folder;
  std::vector<std::string> command = mpirun(
      1, {"render", "tetra-3", "--nodes=20", "--strategy=dataflow", "--ray-queue=16384", "--runner=mpi", "-o", folder / "a.png"});
  const std::vector<std::string> line(command.end() - 9, command.end());
  command.insert(command.end(), {":", "-n", "1", "/bin/sh", "-c", "ulimit -d 500000; exec \"$0\" \"$@\""});
  command.insert(command.end(), line.begin(), line.end());
  const Said ended = run(command);
  CHECK(ended.status == 4);
  CHECK_MESSAGE(contains(ended.errors, "dmpc: rank 1 on host "), ended.errors);
  CHECK_MESSAGE(contains(ended.errors, ": this computer has no room for 10 nodes, with what lies between ranks: they take "),
                ended.errors);
  CHECK_MESSAGE(contains(ended.errors, "(ulimit -d)"), ended.errors);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("ranks with other words are named with both, whatever they make of them") {
  const TemporaryFolder folder;
  const std::vector<std::string> words = {"render", "tetra-1", "--resolution=8x8", "--nodes=3", "-o", folder / "a.png"};
  for (const std::string other : {"--runner=mpi --depth=3", "--runner=mpi --dept=3", ""}) {
    std::vector<std::string> command = mpirun(1, words);
    command.insert(command.end(), {"--runner=mpi", ":", "-n", "1", "/bin/sh", "-c", "exec \"$0\" \"$@\" " + other, DMPC_PROGRAM});
    command.insert(command.end(), words.begin(), words.end());
    const Said ended = run(command);
    CHECK(ended.status != 0);
    CHECK_MESSAGE(count(ended.errors, "dmpc: ") == 1, ended.errors);
    CHECK_MESSAGE(contains(ended.errors, "rank 1 on host "), ended.errors);
    CHECK_MESSAGE(contains(ended.errors, " has the words render tetra-1 "), ended.errors);
    CHECK_MESSAGE(contains(ended.errors, other.empty() ? "a.png, rank 0" : other), ended.errors);
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("ranks that are all stopped for longer than a silence may last go on when they wake" * doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  ChildProcess process(mpirun(3, {"render", "rings-3-t1", "--resolution=512x512", "--samples=64", "--quiet", "--runner=mpi",
                                  "--nodes=3", "-o", folder / "a.png"}));
  CHECK(comes_true([&] { return process_of_rank(process.id(), 2) > 0; }));
  std::this_thread::sleep_for(std::chrono::seconds(2));  // they have begun
  for (const int signal : {SIGSTOP, SIGCONT}) {
    for (const int rank : {0, 1, 2}) {
      ::kill(process_of_rank(process.id(), rank), signal);
    }
    std::this_thread::sleep_for(std::chrono::seconds(signal == SIGSTOP ? 35 : 0));
  }
  CHECK(process.status() == 0);
  CHECK(fs::exists(folder / "a.png"));
}

TEST_CASE("srun that tells MPI nothing of its ranks is said by the first of them, and none renders") {
  const TemporaryFolder folder;
  for (const std::string rank : {"0", "2"}) {
    const Said ended = run({"/usr/bin/env", "SLURM_STEP_NUM_TASKS=3", "SLURM_PROCID=" + rank, DMPC_PROGRAM, "render", "tetra-1",
                            "--runner=mpi", "-o", folder / "a.png"});
    CHECK(ended.status == 2);
    CHECK_MESSAGE(contains(ended.errors, "dmpc: srun has started 3 processes, of which MPI (") == (rank == "0"), ended.errors);
    CHECK(contains(ended.errors, " knows 1: start it by srun --mpi=pmi") == (rank == "0"));
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("a process that is killed ends all, and the picture goes on from what was kept, on another number of ranks" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  const std::string kept = folder / "kept", stats = "--stats=" + (folder / "s.json").string();
  const std::vector<std::string> line = {"render",        "rings-3-t1",           "--resolution=256x256",    "--samples=64",
                                         "--quiet",       "--checkpoint=" + kept, "--checkpoint-every=0.05", "-o",
                                         folder / "a.exr"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = line;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  {
    ChildProcess process(mpirun(3, with({"--runner=mpi", "--nodes=5"})));
    CHECK(comes_true([&] { return fs::exists(kept); }));
    const pid_t lost = process_of_rank(process.id(), 2);
    REQUIRE(lost > 0);
    ::kill(lost, SIGKILL);
    CHECK(process.status() != 0);
    CHECK_FALSE(fs::exists(folder / "a.exr"));
    CHECK(contains(process.errors(), "rank 2"));
  }
  const Said resumed = run(mpirun(2, with({"--runner=mpi", "--nodes=4", "--resume", stats})));
  CHECK_MESSAGE(resumed.status == 0, resumed.errors);
  const std::string film = film_in(folder / "s.json");
  std::vector<std::string> alone = {DMPC_PROGRAM};
  const std::vector<std::string> whole = with({"--nodes=2", stats});
  alone.insert(alone.end(), whole.begin(), whole.end());
  CHECK(run(alone).status == 0);
  CHECK(film == film_in(folder / "s.json"));
}

}  // namespace dmpc::tests::failures_test
