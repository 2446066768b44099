// Node programs run over MPI as they do over the loopback.
#include "nodes/ranks/ranks_runner.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "tests/mpi/here.h"
#include "tests/nodes/toy_machine.h"
#include "tests/nodes/toy_programs.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::mpi_ranks_runner_test {

using namespace nodes;

namespace {

/// How a run of `specifications` over all ranks ends; look(runner) after a regular end, the error's text after another.
template <class Look>
std::string end_of(const std::vector<NodeSpecification>& specifications, const Look& look, const RankSilence& silence = {}) {
  RankLinks links(here().fabric, silence);
  RanksRunner runner(specifications, links);
  try {
    const RunEnd end = runner.run({});
    CHECK(end == RunEnd::finished);
    look(runner);
  } catch (const LostRank&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("every request is answered across processes") {
  const auto count = static_cast<std::uint32_t>(scaled(400));
  const auto look = [](RanksRunner& runner) {
    for (std::uint32_t index = 0; index < 12; ++index) {
      CHECK((!runner.is_here(index) || program_of<Requester>(runner, index).all_right()));
    }
  };
  CHECK(end_of(equal_nodes(12, Requester::mailbox(12, 20), making<Requester>(count, 20U)), look) == "");
}

TEST_CASE("an exception of a program ends the run in all processes, and others say whose it was") {
  if (here().rank_count() == 1) {
    return;
  }
  auto specifications = equal_nodes(9, {}, making<Waiter>());
  specifications[7].make_program = making<Worker>(true);
  const std::uint32_t rank = rank_of(7, 8, here_now->rank_count());
  const std::string expected =
      rank == here_now->rank() ? "the hundredth quantum" : here_now->group.name_of(rank) + ": the hundredth quantum";
  CHECK(end_of(specifications, [](RanksRunner&) {}) == expected);
}

TEST_CASE("what nodes have to say after a run comes to rank 0") {
  const auto text = [](std::size_t index) { return std::string(index * 20'000, static_cast<char>('a' + index)); };
  const auto look = [&](RanksRunner& runner) {
    const std::vector<std::string> reported = runner.gather(text);
    for (std::size_t index = 0; index < reported.size() && runner.is_here(reported.size() - 1); ++index) {
      CHECK(reported[index] == text(index));
    }
  };
  CHECK(end_of(equal_nodes(6, TokenRound::mailbox, making<TokenRound>(3U)), look) == "");
}

/// To be run alone, as nothing comes after it: the last rank stands still, or is killed, in the midst of a run.
class Stops : public Worker {
 public:
  Stops(Node& node, int signal) : Worker(node, false), signal_(signal) {}
  bool work() override {
    if (++quanta_ == 1000) {
      std::raise(signal_);
    }
    return Worker::work();
  }

 private:
  int signal_;
  std::uint32_t quanta_ = 0;
};

void lose_last_rank(int signal) {
  auto specifications = equal_nodes(9, {}, making<Waiter>());
  specifications[7].make_program = making<Stops>(signal);
  try {
    end_of(specifications, [](RanksRunner&) {},
           {.heartbeat = std::chrono::milliseconds(50), .longest = std::chrono::milliseconds(1000)});
  } catch (const LostRank&) {
    is_lost = std::current_exception();
  }
}

TEST_CASE("a process that stands still is named, and all end" * doctest::skip()) { lose_last_rank(SIGSTOP); }
TEST_CASE("a process that is killed takes all with it" * doctest::skip()) { lose_last_rank(SIGKILL); }

}  // namespace dmpc::tests::mpi_ranks_runner_test
