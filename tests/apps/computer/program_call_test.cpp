// Programs that misbehave: what is said names the node and the call.
#include "apps/computer/program_call.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/computer/bounded_charge.h"
#include "nodes/call_board.h"
#include "tests/apps/computer/ran.h"
#include "tests/support/forked_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::program_call_test {

namespace {

enum class Way {
  makes_nothing,
  throws_in_make,
  throws_in_work,
  throws_a_number,
  throws_in_receive,
  throws_in_finished,
  throws_in_describe,
  throws_in_outcome,
  takes_all_memory,
  goes_too_deep,
  crashes,
  aborts,
  exits,
  charges_too_much,
  charges_too_much_in_all
};

Way way{};  // over all nodes; node 1 goes it

/// Deeper than any node's stack.
[[gnu::noinline]] int deep(int left) {
  volatile char large[4096];
  large[static_cast<std::size_t>(left) % sizeof(large)] = 1;
  return left <= 0 ? 0 : deep(left - 1) + large[0];
}

/// Each node sends one packet to the next one.
class Misbehaver final : public dmpc::Program {
 public:
  explicit Misbehaver(dmpc::Node& node) : node_(node) { go(Way::throws_in_make); }

  void receive(const dmpc::Packet& /*packet*/) override {
    go(Way::throws_in_receive);
    has_received_ = true;
  }
  bool work() override {
    for (const Way own : {Way::throws_in_work, Way::throws_a_number, Way::takes_all_memory, Way::goes_too_deep, Way::crashes,
                          Way::aborts, Way::exits, Way::charges_too_much, Way::charges_too_much_in_all}) {
      go(own);
    }
    has_sent_ = has_sent_ || (way != Way::throws_in_describe && node_.try_send(node_.next(), 0, std::span<const int>()));
    return false;
  }
  bool finished() const override {
    go(Way::throws_in_finished);
    return has_sent_ && has_received_;
  }
  std::string describe() const override {
    go(Way::throws_in_describe);
    return "stands";
  }
  int outcome() const {
    go(Way::throws_in_outcome);
    return 1;
  }

 private:
  void go(Way own) const {
    if (way != own || node_.id() != 1) {
      return;
    }
    switch (own) {
      case Way::throws_a_number:
        throw 42;
      case Way::takes_all_memory:
        throw std::bad_alloc();
      case Way::goes_too_deep:
        std::exit(100 + deep(1'000'000));
      case Way::crashes:
        std::raise(SIGSEGV);
        return;
      case Way::aborts:
        std::abort();
      case Way::exits:
        std::exit(0);
      case Way::charges_too_much:
        return node_.charge(0, ~std::uint64_t{0});
      case Way::charges_too_much_in_all:
        node_.charge(0, apps::charges_max);
        return node_.charge(0, 1);
      default:
        throw std::runtime_error("own words \x1b]0;");
    }
  }

  dmpc::Node& node_;
  bool has_sent_ = false, has_received_ = false;
};

Ran run_way(Way chosen, const std::string& runner) {
  way = chosen;
  return ran("misbehaver", {"--nodes=3", "--quiet", "--runner=" + runner}, [](int count, const char* const* words) {
    return dmpc::run<Misbehaver>(
        count, words,
        {.description = "misbehaves",
         .needs =
             [](std::uint32_t) {
               return dmpc::Needs{.packets = {{.name = "word", .senders = dmpc::from_previous()}}, .operations = {{"step", 10}}};
             },
         .make = [](dmpc::Node& node) -> std::unique_ptr<Misbehaver> {
           return way == Way::makes_nothing && node.id() == 1 ? nullptr : std::make_unique<Misbehaver>(node);
         },
         .result = [](const auto&) { return std::string("done"); }});
  });
}

void check_said(Way chosen, int status, const std::string& text) {
  for (const std::string runner : {"threads", "virtual"}) {
    const Ran done = run_way(chosen, runner);
    INFO(runner);
    CHECK(done.status == status);
    CHECK_MESSAGE(done.complains(text), done.errors);
    CHECK_FALSE(done.complains("\x1b"));
    CHECK(done.output.empty());
  }
}

/// What the process says that goes this way, and how it ends.
struct End {
  int status = 0;
  std::string errors;
};

template <Way chosen>
End end_of_process(bool is_virtual) {
  const TemporaryFolder folder;  // no static one, which would go when the child calls exit()
  static std::string errors, runner;
  errors = folder / "errors";
  runner = is_virtual ? "virtual" : "threads";
  const ForkedProcess process([] {
    const rlimit stack{8U << 20U, 8U << 20U};  // whatever the shell has: some have no limit
    ::setrlimit(RLIMIT_STACK, &stack);
    if (::open(errors.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600) != STDERR_FILENO) {
      return 200;
    }
    return run_way(chosen, runner).status;
  });
  return {process.status(), file_text(errors)};
}

bool says(const End& end, const std::string& part) { return end.errors.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("what a program throws is told with the call and its node, in letters that steer no terminal") {
  const std::string own = "misbehaver: the program: own words \\x1b]0;, in ";
  check_said(Way::throws_in_make, 3, own + "make() of node 1");
  check_said(Way::throws_in_work, 3, own + "work() of node 1");
  check_said(Way::throws_in_receive, 3, own + "receive() of node 1");
  check_said(Way::throws_in_finished, 3, own + "finished() of node 1");
  check_said(Way::throws_in_describe, 3, own + "describe() of node 1");
  check_said(Way::throws_in_outcome, 3, own + "outcome() of node 1");
  check_said(Way::throws_a_number, 3, "the program: what it threw is no std::exception, in work() of node 1");
  check_said(Way::takes_all_memory, 4, "there is no more memory, in work() of node 1: ask for fewer nodes");
}

TEST_CASE("a node without a program is told") {
  check_said(Way::makes_nothing, 3, "the program: what it returned is no program, in make() of node 1");
}

TEST_CASE("charges whose sum would wrap are refused") {
  check_said(Way::charges_too_much, 3,
             "the program: operation 'step' is charged 18446744073709551615 times more, beside 0 before");
  check_said(Way::charges_too_much_in_all, 3, ", in work() of node 1");
}

TEST_CASE("a program that ends the process is told with its node, and has not done well") {
  for (const bool is_virtual : {false, true}) {
    const End end = end_of_process<Way::exits>(is_virtual);
    CHECK(end.status == 3);
    CHECK_MESSAGE(says(end, "misbehaver: the program has ended the process in work() of node 1"), end.errors);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which tell more of a crash
TEST_CASE("a crash of a program is told with its node, and still is one") {
  const End crashed = end_of_process<Way::crashes>(false), aborted = end_of_process<Way::aborts>(true);
  CHECK(crashed.status == 1000 + SIGSEGV);
  CHECK_MESSAGE(says(crashed, "misbehaver: the program crashed in work() of node 1, by signal 11\n"), crashed.errors);
  CHECK(aborted.status == 1000 + SIGABRT);
  CHECK_MESSAGE(says(aborted, "misbehaver: the program crashed in work() of node 1, by signal 6\n"), aborted.errors);
}

TEST_CASE("a stack that is full is told with its node") {
  for (const bool is_virtual : {false, true}) {
    const End end = end_of_process<Way::goes_too_deep>(is_virtual);
    CHECK(end.status == 1000 + SIGSEGV);
    CHECK_MESSAGE(says(end, "the program crashed in work() of node 1, by signal 11: its stack is full, "), end.errors);
  }
}
#endif

TEST_CASE("a call that has not returned for so many looks is found, once") {
  nodes::CallBoard board(2);
  board.begin(3, "work()");
  CHECK(board.look().empty());
  CHECK(board.look().empty());
  const auto found = board.look();
  REQUIRE(found.size() == 1);
  CHECK(found.front().node == 3);
  CHECK(std::string(found.front().what) == "work()");
  CHECK(board.look().empty());
  for (int call = 0; call < 5; ++call) {
    board.end(3);
    board.begin(3, "work()");
    CHECK(board.look().empty());
  }
  board.end(3);
  for (int look = 0; look < 5; ++look) {
    CHECK(board.look().empty());
  }
}

}  // namespace dmpc::tests::program_call_test
