#include "apps/frontend/system/child_process.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "apps/frontend/system/scratch_folder.h"
#include "core/base/expect.h"
#include "tests/support/processes.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::child_process_test {

TEST_CASE("a child runs where it is told to, and its end and complaints are told") {
  const TemporaryFolder folder;
  apps::ChildProcess child({.program = "sh", .arguments = {"-c", "pwd >&2; exit 7"}, .folder = folder.path()});
  CHECK(child.wait() == 7);
  CHECK(std::filesystem::equivalent(child.errors().substr(0, child.errors().find('\n')), folder.path()));
  CHECK(apps::ChildProcess({.program = "/bin/sh", .arguments = {"-c", "kill -9 $$"}}).wait() == -9);
}

TEST_CASE("a program that cannot be started, or not there, is an error with the reason") {
  CHECK_THROWS_WITH_AS(apps::ChildProcess({.program = "/no/program"}), "/no/program cannot be started: No such file or directory",
                       core::InputError);
  CHECK_THROWS_AS(apps::ChildProcess({.program = "sh", .folder = "/no/folder"}), core::InputError);
}

TEST_CASE("what a child has started and left behind ends with it where it is to leave nothing") {
  int ends[2];
  REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
  {
    apps::ChildProcess child({.program = "sh",
                              .arguments = {"-c", "sleep 600 & exit 3"},
                              .gets_ctrl_c = false,
                              .output = ends[1],
                              .leaves_nothing = true});
    ::close(ends[1]);
    CHECK(child.wait() == 3);
  }
  pollfd heard{.fd = ends[0], .events = POLLIN, .revents = 0};
  constexpr int minute_ms = 60'000;
  CHECK(::poll(&heard, 1, minute_ms) == 1);  // nobody has the other end any more
  CHECK((heard.revents & POLLHUP) != 0);
  ::close(ends[0]);
}

TEST_CASE("a child ends when the process that made it is killed, and its scratch folder goes") {
  const TemporaryFolder place;
  const std::string seconds = "1000." + std::to_string(::getpid());  // by which the child is known
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::setenv("TMPDIR", place.path().c_str(), 1);
    const apps::ScratchFolder folder;
    write_text(folder / "file", "text");
    apps::ChildProcess child({.program = "sleep", .arguments = {seconds}, .gets_ctrl_c = false});
    child.wait();
    ::_exit(0);
  }
  CHECK(comes_to([&] { return processes_with(seconds).size() == 1 && place.entry_count() == 1; }));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  CHECK(comes_to([&] { return processes_with(seconds).empty(); }));
  CHECK(comes_to([&] { return place.entry_count() == 0; }));
}

}  // namespace dmpc::tests::child_process_test
