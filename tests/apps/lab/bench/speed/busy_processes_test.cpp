// Processes that keep the processors busy, and programs that `bench speed` times beside them.
#include "apps/lab/bench/speed/busy_processes.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "apps/lab/bench/speed/timed_process.h"
#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::busy_processes_test {

using apps::BusyProcesses;
using apps::Interrupt;

namespace {

bool is_there(pid_t id) { return ::kill(id, 0) == 0 || errno != ESRCH; }

bool are_gone(const std::vector<pid_t>& ids) { return std::none_of(ids.begin(), ids.end(), is_there); }

}  // namespace

TEST_CASE("a process is timed with those that it waits for") {
  Interrupt interrupt;
  const auto timed =
      apps::time_process("sh", {"-c", "(i=0; while [ $i -lt 50000 ]; do i=$((i + 1)); done); echo done >&2"}, interrupt);
  CHECK(timed.times.processor_seconds > 0);
  CHECK(timed.times.wall_seconds > 0);
  CHECK(timed.complaint == "done\n");
}

TEST_CASE("a process that is timed runs where it is told to") {
  const TemporaryFolder folder;
  Interrupt interrupt;
  apps::time_process("sh", {"-c", "echo here > found"}, interrupt, folder.path());
  CHECK(file_text(folder / "found") == "here\n");
}

TEST_CASE("a process that cannot be timed to its end is an error with what it said") {
  Interrupt interrupt;
  CHECK_THROWS_WITH_AS(apps::time_process("sh", {"-c", "echo oh >&2; exit 3"}, interrupt),
                       "sh was to be timed and ended with status 3, saying: oh\n", core::InputError);
  CHECK_THROWS_AS(apps::time_process("/no/such/program", {}, interrupt), core::InputError);
}

TEST_CASE("a program is found where a shell would find it") {
  CHECK(apps::program_on_path("sh").has_value());
  CHECK_FALSE(apps::program_on_path("no-such-program-anywhere"));
}

TEST_CASE("busy processes are as many as asked for, and gone with their owner") {
  std::vector<pid_t> ids;
  {
    const BusyProcesses busy(8);
    ids = busy.ids();
    CHECK(std::set(ids.begin(), ids.end()).size() == 8);
    CHECK(std::all_of(ids.begin(), ids.end(), is_there));
  }
  CHECK(are_gone(ids));
}

TEST_CASE("a signal ends what is timed and those busy beside it") {
  const TemporaryFolder folder;
  std::vector<pid_t> ids;
  const auto time_beside = [&] {
    Interrupt interrupt;
    const BusyProcesses busy(2);
    ids = busy.ids();
    const std::jthread killer([&] {
      while (!std::filesystem::exists(folder / "started")) {
        ::usleep(1000);
      }
      ::kill(::getpid(), SIGINT);
    });
    apps::time_process("sh", {"-c", "echo $$ > started.new; mv started.new started; while :; do :; done"}, interrupt,
                       folder.path());
  };
  CHECK_THROWS_AS(time_beside(), apps::Interrupted);
  ids.push_back(static_cast<pid_t>(std::stol(file_text(folder / "started"))));
  CHECK(are_gone(ids));
}

}  // namespace dmpc::tests::busy_processes_test
