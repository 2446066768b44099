#include "nodes/ranks/ranks_runner.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "nodes/observer.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/failure.h"
#include "nodes/threads/clock.h"
#include "tests/nodes/toy_machine.h"
#include "tests/nodes/toy_programs.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::tests::ranks_ranks_runner_test {
namespace {

using namespace nodes;

/// What a rank's run came to.
struct RankRun {
  RunEnd end;
  RankTraffic traffic;
};

constexpr RankSilence short_silence{.heartbeat = std::chrono::milliseconds(50), .longest = std::chrono::milliseconds(1000)};

/// Runs `specifications` on so many ranks, and looks at each rank's runner with look(runner) after a regular end.
template <class Look>
std::vector<RankResult<RankRun>> run_on(std::uint32_t ranks, const std::vector<NodeSpecification>& specifications,
                                        const Look& look, const LoopbackTrouble& trouble = {}, std::stop_token stop = {},
                                        const RankSilence& silence = {}) {
  return on_ranks(ranks, trouble, [&](Fabric& fabric) {
    RankLinks links(fabric, silence);
    RanksRunner runner(specifications, links);
    const RunEnd end = runner.run(fabric.rank() + 1 == ranks ? stop : std::stop_token());
    look(runner);
    return RankRun{end, runner.traffic()};
  });
}

constexpr auto no_look = [](RanksRunner& /*runner*/) {};

/// Says whether any thread but its maker's takes frames.
class WatchedFabric final : public Fabric {
 public:
  WatchedFabric(Fabric& fabric, std::atomic<bool>& others_take) : fabric_(&fabric), others_take_(&others_take) {}

  std::uint32_t rank() const override { return fabric_->rank(); }
  std::uint32_t rank_count() const override { return fabric_->rank_count(); }
  std::string name_of(std::uint32_t rank) const override { return fabric_->name_of(rank); }
  std::size_t frame_bytes() const override { return fabric_->frame_bytes(); }
  std::size_t arrival_bytes() const override { return fabric_->arrival_bytes(); }
  std::span<std::byte> room(std::uint32_t rank) override { return fabric_->room(rank); }
  void send(std::uint32_t rank, std::size_t bytes) override { fabric_->send(rank, bytes); }
  std::optional<Arrival> take() override {
    if (std::this_thread::get_id() != maker_) {
      others_take_->store(true);
    }
    return fabric_->take();
  }

 private:
  Fabric* fabric_;
  std::atomic<bool>* others_take_;
  std::thread::id maker_ = std::this_thread::get_id();
};

/// Works until that is so, or for a minute.
class WorkerUntil : public ToyProgram {
 public:
  WorkerUntil(Node& node, const std::atomic<bool>* is_so) : ToyProgram(node), is_so_(is_so) {}
  bool work() override { return !(is_over_ = is_so_->load() || std::chrono::steady_clock::now() > end_); }
  bool finished() const override { return is_over_; }

 private:
  const std::atomic<bool>* is_so_;
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  bool is_over_ = false;
};

/// Expects that all ranks have ended regularly, and that nothing is lost between them; returns the packets between them.
std::uint64_t check_ended(const std::vector<RankResult<RankRun>>& results) {
  std::uint64_t sent = 0, received = 0;
  for (const RankResult<RankRun>& result : results) {
    CHECK(result.failure_text() == "");
    CHECK((result.value && result.value->end == RunEnd::finished));
    if (result.value) {
      sent += result.value->traffic.packets_sent;
      received += result.value->traffic.packets_received;
    }
  }
  CHECK(sent == received);
  return sent;
}

/// Calls check(program, index) for each program of type T that is on the runner's rank.
template <class T, class Check>
void check_programs(RanksRunner& runner, std::uint32_t peers, const Check& check) {
  for (std::uint32_t i = 0; i < peers; ++i) {
    if (runner.is_here(i)) {
      check(program_of<T>(runner, i), i);
    }
  }
}

}  // namespace

TEST_CASE("blocks of nodes are on each rank, the host on rank 0") {
  CHECK(rank_of(0, 5, 3) == 0);
  CHECK(rank_of(1, 5, 3) == 0);
  CHECK(rank_of(2, 5, 3) == 1);
  CHECK(rank_of(3, 5, 3) == 1);
  CHECK(rank_of(4, 5, 3) == 2);
  CHECK(rank_of(5, 5, 3) == 0);
  for (std::uint32_t ranks = 1; ranks < 20; ++ranks) {
    for (std::uint32_t index = 0; index + 1 < ranks; ++index) {
      CHECK(rank_of(index + 1, ranks, ranks) == rank_of(index, ranks, ranks) + 1);  // none is without a node
    }
  }
}

TEST_CASE("nodes that are awake take frames themselves, on threads and in a pool") {
  for (const std::optional<std::uint32_t> pool_threads : {std::optional<std::uint32_t>(), std::optional(1U)}) {
    std::atomic<bool> others_take = false;
    const std::atomic<bool>* const is_so = &others_take;
    const auto specifications = equal_nodes(5, {}, making<WorkerUntil>(is_so));
    const auto results = on_ranks(2, {}, [&](Fabric& fabric) {
      WatchedFabric watched(fabric, others_take);
      RankLinks links(watched);
      RanksRunner runner(specifications, links, std::nullopt, nullptr, pool_threads);
      return runner.run({});
    });
    CHECK(others_take);
    CHECK((results[0].value == RunEnd::finished && results[1].value == RunEnd::finished));
  }
}

TEST_CASE("a token goes round the ring across ranks") {
  for (const std::uint32_t ranks : {1U, 2U, 3U, 5U}) {
    const auto check = [](const TokenRound& program, std::uint32_t /*index*/) { CHECK(program.passed() == 20); };
    const auto look = [&](RanksRunner& runner) { check_programs<TokenRound>(runner, 8, check); };
    const std::uint64_t crossed = check_ended(run_on(ranks, equal_nodes(8, TokenRound::mailbox, making<TokenRound>(20U)), look));
    CHECK(crossed == (ranks == 1 ? 0U : 20U * ranks));  // the host sits beside node 0
  }
}

TEST_CASE("every request is answered across ranks, with one credit or many, however late frames are") {
  for (const std::uint32_t ranks : {1U, 2U, 3U, 5U}) {
    for (const auto& [peers, window] : {std::pair{6U, 1U}, std::pair{6U, 7U}, std::pair{24U, 2U}}) {
      for (const std::uint32_t late : {0U, 9U}) {
        CAPTURE(ranks);
        CAPTURE(peers);
        CAPTURE(window);
        const auto check = [](const Requester& program, std::uint32_t /*index*/) { CHECK(program.all_right()); };
        const auto look = [&, count = peers](RanksRunner& runner) { check_programs<Requester>(runner, count, check); };
        check_ended(run_on(ranks, equal_nodes(peers, Requester::mailbox(peers, window), making<Requester>(20U, window)), look,
                           {.seed = peers, .late_polls_max = late}));
      }
    }
  }
}

TEST_CASE("packets that may wait arrive at another rank in order, overtaken by none") {
  std::vector<std::uint32_t> expected(Patient::count);
  std::iota(expected.begin(), expected.end(), 0);
  auto specifications = equal_nodes(3, Patient::mailbox, making<ToyProgram>());
  specifications[1].make_program = making<Patient>(6U);
  specifications[1].batching = {.kinds = 1U << 1U, .packets = 5};
  specifications[2].make_program = making<Patient>(6U);
  const auto look = [&](RanksRunner& runner) {
    if (runner.is_here(2)) {
      CHECK(program_of<Patient>(runner, 2).received() == expected);
    }
  };
  CHECK(check_ended(run_on(2, specifications, look)) == Patient::count);
}

TEST_CASE("full frames are few, and hold what their way has no room for") {
  const auto results =
      run_on(2, equal_nodes(12, Requester::mailbox(12, 40), making<Requester>(200U, 40U)), no_look, {.late_polls_max = 20});
  const std::uint64_t packets = check_ended(results);
  CHECK(results[0].value->traffic.frames_sent + results[1].value->traffic.frames_sent < packets / 4);
}

TEST_CASE("a stall is found on all ranks, and the report of rank 0 has every node") {
  const auto results = run_on(2, equal_nodes(4, {}, making<Waiter>()), no_look);
  const std::string report = results[0].failure_text();
  CHECK(report.find("all nodes sleep") != std::string::npos);
  CHECK(report.find("node 0 (finished): waits for Godot") != std::string::npos);
  CHECK(report.find("node 1: waits for Godot") != std::string::npos);
  CHECK(report.find("node 2: waits for Godot") != std::string::npos);
  CHECK(report.find("host: waits for Godot") != std::string::npos);
  CHECK(results[1].failure_text().find("node 2: waits for Godot") != std::string::npos);
}

TEST_CASE("an exception of a program ends the run on all ranks, and others say where it was") {
  auto specifications = equal_nodes(8, {}, making<Waiter>());
  specifications[3].make_program = making<Worker>(true);
  const auto results = run_on(3, specifications, no_look);
  CHECK(results[0].failure_text() == "rank 1: the hundredth quantum");
  CHECK(results[1].failure_text() == "the hundredth quantum");
  CHECK(results[2].failure_text() == "rank 1: the hundredth quantum");
}

TEST_CASE("what a failed run has told rank 0 is not told again by a rank that says its failure behind it") {
  auto specifications = equal_nodes(6, {}, making<Waiter>());
  specifications[1].make_program = making<Worker>(true);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const auto results = on_ranks(3, {.seed = seed, .late_polls_max = 200}, [&](Fabric& fabric) {
      RankLinks links(fabric);
      RanksRunner runner(specifications, links);
      try {
        return runner.run({});
      } catch (const Dismissed&) {  // before it knew
        return RunEnd::interrupted;
      } catch (...) {
        if (fabric.rank() == 0) {
          dismiss(links, 3);
          throw;
        }
        say_failure(links, failure_of(std::current_exception()));
        wait_for_dismissal(links);
        return RunEnd::interrupted;
      }
    });
    CHECK(results[0].failure_text() == "the hundredth quantum");
  }
}

TEST_CASE("a mailbox smaller than the credits is found out by the rank whose node it is") {
  const auto results = run_on(
      2, equal_nodes(5, {.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 200}, making<Requester>(50U, 40U)), no_look);
  CHECK(results[0].failure_text().find("credits leave room") != std::string::npos);
  CHECK(results[1].failure_text().find("credits leave room") != std::string::npos);
}

TEST_CASE("a stop that is requested on one rank interrupts all, workers and sleepers alike") {
  auto specifications = equal_nodes(8, {}, making<Waiter>());
  specifications[0].make_program = making<Worker>(false);
  std::stop_source stop;
  std::jthread stopper([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop.request_stop();
  });
  for (const RankResult<RankRun>& result : run_on(3, specifications, no_look, {}, stop.get_token())) {
    CHECK(result.failure_text() == "");
    CHECK((result.value && result.value->end == RunEnd::interrupted));
  }
}

TEST_CASE("a frame that is lost is found out, whichever it is") {
  for (std::uint64_t frame = 0; frame < 6; ++frame) {
    CAPTURE(frame);
    const auto results = run_on(3, equal_nodes(7, Requester::mailbox(7, 2), making<Requester>(20U, 2U)), no_look,
                                {.seed = frame, .late_polls_max = 4, .loss = LoopbackTrouble::Loss{1, 2, frame}});
    for (const RankResult<RankRun>& result : results) {
      CHECK(result.failure_text().find("a frame from rank 1 to rank 2 is lost") != std::string::npos);
    }
  }
}

TEST_CASE("a frame that is lost while ranks compare their clocks is found out, whichever it is and between whom" *
          doctest::test_suite("slow")) {
  class PacketCounter final : public Observer {};
  for (const auto& [from, to] : {std::pair{0U, 1U}, {1U, 0U}, {2U, 0U}}) {
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
      CAPTURE(from);
      CAPTURE(to);
      CAPTURE(frame);
      const auto results = on_ranks(3, {.seed = frame, .loss = LoopbackTrouble::Loss{from, to, frame}}, [](Fabric& fabric) {
        RankLinks links(fabric);
        PacketCounter packet_counter;
        return RanksRunner(equal_nodes(7, Requester::mailbox(7, 2), making<Requester>(20U, 2U)), links, std::nullopt,
                           &packet_counter)
            .run({});
      });
      for (const RankResult<RunEnd>& result : results) {
        CHECK(result.failure_text().find(" is lost") != std::string::npos);
      }
    }
  }
}

TEST_CASE("a rank of which nothing is heard is named") {
  const auto results =
      run_on(3, equal_nodes(7, TokenRound::mailbox, making<TokenRound>(20U)), no_look, {.dead_rank = 2}, {}, short_silence);
  CHECK(results[0].failure_text() == "rank 2 is lost: nothing has been heard of it for 1000 ms");
  CHECK(results[1].failure_text() == "rank 2 is lost: nothing has been heard of it for 1000 ms");
}

TEST_CASE("a rank whose nodes work for long without a word is not taken for lost") {
  class WorksAlone : public ToyProgram {
   public:
    using ToyProgram::ToyProgram;
    bool work() override {
      if (index() == 0 && !is_done_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
      }
      is_done_ = true;
      return false;
    }
    bool finished() const override { return is_done_; }

   private:
    bool is_done_ = false;
  };
  check_ended(run_on(2, equal_nodes(3, {}, making<WorksAlone>()), no_look, {}, {}, short_silence));
}

TEST_CASE("what nodes have to say after a run comes to rank 0, however long it is") {
  const auto text = [](std::size_t index) { return std::string(index * 20'000, static_cast<char>('a' + index)); };
  const auto results = on_ranks(3, {.late_polls_max = 3}, [&](Fabric& fabric) {
    RankLinks links(fabric);
    RanksRunner runner(equal_nodes(6, TokenRound::mailbox, making<TokenRound>(3U)), links);
    CHECK(runner.run({}) == RunEnd::finished);
    return runner.gather(text);
  });
  for (std::size_t index = 0; index < 6; ++index) {
    CHECK(results[0].value->at(index) == text(index));
  }
  CHECK(results[1].value->at(2) == text(2));
  CHECK(results[1].value->at(4).empty());
}

TEST_CASE("after the nodes each rank speaks for itself, and rank 0 hears what went between them") {
  const auto results = on_ranks(3, {.late_polls_max = 30}, [&](Fabric& fabric) {
    RankLinks links(fabric);
    RanksRunner runner(equal_nodes(6, TokenRound::mailbox, making<TokenRound>(5U)), links);
    CHECK(runner.run({}) == RunEnd::finished);
    static_cast<void>(runner.gather([](std::size_t index) { return std::string(index * 10'000, 'a'); }));
    return runner.gather_ranks(std::string(fabric.rank() * 50'000, static_cast<char>('0' + fabric.rank())));
  });
  for (const auto& result : results) {
    REQUIRE(result.failure_text() == "");
  }
  CHECK(results[1].value->empty());
  const std::vector<RankReport>& heard = *results[0].value;
  REQUIRE(heard.size() == 3);
  for (std::uint32_t rank = 0; rank < 3; ++rank) {
    CAPTURE(rank);
    CHECK(heard[rank].reported == std::string(rank * 50'000, static_cast<char>('0' + rank)));
    CHECK(heard[rank].traffic.packets_sent == 5);  // a rank's last node, or the host's neighbour, passes the token on
    CHECK(heard[rank].traffic.packets_received == 5);
    CHECK(heard[rank].traffic.frames_sent > 5);
    CHECK(heard[rank].traffic.bytes_sent > 5 * (sizeof(FrameNumber) + sizeof(ItemHeader)));
    CHECK(heard[rank].traffic.waves > 1);
  }
}

TEST_CASE("nodes that are made anew on the same ranks begin to count what is sent anew, as those do that run again") {
  for (const bool are_made_anew : {true, false}) {
    CAPTURE(are_made_anew);
    const auto results = on_ranks(2, {}, [&](Fabric& fabric) {
      RankLinks links(fabric);
      std::vector<RankReport> sums;
      std::optional<RanksRunner> runner;
      for (const std::uint32_t rounds : {200U, 1U}) {
        if (!runner || are_made_anew) {
          runner.emplace(equal_nodes(4, TokenRound::mailbox, making<TokenRound>(rounds)), links);
        }
        CHECK(runner->run({}) == RunEnd::finished);
        const std::vector<RankReport> reports = runner->gather_ranks("");
        sums.insert(sums.end(), reports.begin(), reports.begin() + std::min<std::ptrdiff_t>(1, std::ssize(reports)));
      }
      return sums;
    });
    for (const auto& result : results) {
      REQUIRE(result.failure_text() == "");
    }
    const std::vector<RankReport>& heard = *results[0].value;
    REQUIRE(heard.size() == 2);
    CHECK(heard[0].traffic.frames_sent >= 200);
    CHECK(heard[1].traffic.frames_sent < 100);
    CHECK(heard[1].traffic.bytes_sent < heard[0].traffic.bytes_sent / 2);
  }
}

TEST_CASE("where somebody looks on, each rank's clock is set to that of rank 0, and compared with it after the run") {
  class Sees final : public Observer {
   public:
    void ended(const Span& span, const Program& /*program*/) override { last_ns = std::max(last_ns.load(), span.end_ns); }
    void received(const Passing& packet) override { last_ns = std::max(last_ns.load(), packet.times.received_ns); }

    std::atomic<std::uint64_t> last_ns{0};
  };
  struct Heard {
    std::vector<RankReport> reports;
    std::uint64_t last_ns;
  };
  const std::uint64_t begin_ns = nanoseconds(CLOCK_MONOTONIC);
  const auto results = on_ranks(3, {.late_polls_max = 9}, [&](Fabric& fabric) {
    Sees observer;
    RankLinks links(fabric);
    RanksRunner runner(equal_nodes(6, TokenRound::mailbox, making<TokenRound>(5U)), links, std::nullopt, &observer);
    CHECK(runner.run({}) == RunEnd::finished);
    static_cast<void>(runner.gather([](std::size_t) { return std::string(); }));
    return Heard{runner.gather_ranks({}), observer.last_ns};
  });
  const std::uint64_t length_ns = nanoseconds(CLOCK_MONOTONIC) - begin_ns;
  for (const auto& result : results) {
    REQUIRE(result.failure_text() == "");
    CHECK(result.value->last_ns > 0);
    CHECK(result.value->last_ns < length_ns);  // by a clock that was not set it would be some other number
  }
  const std::vector<RankReport>& reports = results[0].value->reports;
  CHECK(reports[0].clock.error_ns() == 0);
  for (const std::size_t rank : {1U, 2U}) {
    CHECK(reports[rank].clock.error_ns() > 0);
    CHECK(reports[rank].clock.error_ns() < length_ns);
    // All of them read one clock here.
    CHECK(std::abs(reports[rank].clock.gained_ns()) <= static_cast<std::int64_t>(2 * reports[rank].clock.error_ns()));
  }
}

TEST_CASE("a packet that fits no frame is refused before the run") {
  const auto results = on_ranks(2, {}, [&](Fabric& fabric) {
    RankLinks links(fabric);
    RanksRunner(equal_nodes(4, {.bulk_slots = 1, .bulk_payload_bytes = frame_bytes_min}, making<ToyProgram>()), links);
    return 0;
  });
  CHECK(results[0].failure_text().find("every packet fits a frame") != std::string::npos);
}

TEST_CASE("a computer with fewer nodes than ranks is refused") {
  for (const RankResult<RankRun>& result : run_on(3, equal_nodes(3, {}, making<ToyProgram>()), no_look)) {
    CHECK(result.failure_text().find("each rank has a node") != std::string::npos);
  }
}

}  // namespace dmpc::tests::ranks_ranks_runner_test
