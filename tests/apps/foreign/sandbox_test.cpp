#include "apps/foreign/sandbox.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <new>
#include <thread>

namespace dmpc::tests::sandbox_test {

namespace {

/// The status of a process that enters the sandbox and then does this; -1 if it is filtered no calls, below that: a signal.
int status_within(const std::function<int()>& act, std::uint64_t memory_bytes = std::uint64_t{1} << 40U) {
  const pid_t id = ::fork();
  if (id == 0) {
    const apps::Confinement confinement = apps::enter_sandbox(memory_bytes);
    ::_exit(confinement.are_calls_filtered && confinement.are_limits_set ? act() : 99);
  }
  int status = 0;
  ::waitpid(id, &status, 0);
  return WIFSIGNALED(status) ? -1 - WTERMSIG(status) : WEXITSTATUS(status) == 99 ? -1 : WEXITSTATUS(status);
}

int works(bool does) { return does ? 1 : 0; }

}  // namespace

TEST_CASE("calls of a reader are filtered here") {
  CHECK(status_within([] { return 0; }) == 0);
}

TEST_CASE("a reader can neither open files, reach the network nor start programs") {
  CHECK(status_within([] { return works(::open("/etc/passwd", O_RDONLY) >= 0); }) == 0);
  CHECK(status_within([] { return works(::open("/tmp/dmpc-sandbox-test", O_CREAT | O_WRONLY, 0600) >= 0); }) == 0);
  CHECK(status_within([] { return works(::socket(AF_INET, SOCK_STREAM, 0) >= 0); }) == 0);
  CHECK(status_within([] { return works(::fork() >= 0); }) == 0);
  CHECK(status_within([] { return works(::execl("/bin/true", "true", nullptr) == 0); }) == 0);
  CHECK(status_within([] { return works(::kill(::getppid(), 0) == 0); }) == 0);
  CHECK(status_within([] {
          return works(::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED);
        }) == 0);
}

TEST_CASE("a reader gets the memory that it may have, and no more") {
  const auto allocates = [](std::size_t bytes) {
    return works(::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED);
  };
  constexpr std::size_t may = std::size_t{64} << 20U;
  CHECK(status_within([&] { return allocates(may / 2); }, may) == 1);
  CHECK(status_within([&] { return allocates(2 * may); }, may) == 0);
}

TEST_CASE("without files a process opens none, where the kernel knows how") {
  const pid_t id = ::fork();
  if (id == 0) {
    const bool opened_before = ::open("/etc/passwd", O_RDONLY) >= 0, is_forbidden = apps::forbid_by_landlock().are_files;
    ::_exit(!is_forbidden ? 0 : opened_before && ::open("/etc/passwd", O_RDONLY) < 0 ? 0 : 1);
  }
  int status = 0;
  ::waitpid(id, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("by Landlock alone a process reaches no port, and signals nobody, where the kernel knows how") {
  const pid_t id = ::fork();
  if (id == 0) {
    const int line = ::socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in place{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
    const bool is_forbidden = apps::forbid_by_landlock().is_reach;
    const bool binds = ::bind(line, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
    ::_exit(is_forbidden && (binds || ::kill(::getppid(), 0) == 0) ? 1 : 0);
  }
  int status = 0;
  ::waitpid(id, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("a process that nothing hinders ends with its parent") {
  const pid_t id = ::fork();
  if (id == 0) {
    ::_exit(apps::tie_to_parent() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(id, &status, 0);
  CHECK(status == 0);
}

}  // namespace dmpc::tests::sandbox_test
