#include "apps/frontend/system/watched_process.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"

namespace dmpc::tests::watched_process_test {

TEST_CASE("anonymous memory is read from a process's status") {
  CHECK(apps::anonymous_bytes_in("VmHWM:\t    9 kB\nRssAnon:\t   12 kB\nRssFile:\t 7 kB\n") == 12 * 1024);
  CHECK(apps::anonymous_bytes_in("") == 0);
  CHECK(apps::anonymous_bytes_in("RssAnon:") == 0);
}

TEST_CASE("a watched process that fails or cannot be started is an error") {
  const apps::Interrupt interrupt;
  CHECK_THROWS_AS(apps::peak_anonymous_bytes(DMPC_PROGRAM, {"no-command"}, interrupt), core::InputError);
  CHECK_THROWS_AS(apps::peak_anonymous_bytes("/no/program", {}, interrupt), core::InputError);
  CHECK(apps::peak_anonymous_bytes(DMPC_PROGRAM, {"machine", "ipsc2"}, interrupt) > 10'000);
}

TEST_CASE("a watched process tells how it ended and what it complained of") {
  const apps::Interrupt interrupt;
  const apps::WatchedProcess good = apps::watch_process(DMPC_PROGRAM, {"machine", "ipsc2"}, interrupt);
  CHECK(good.status == 0);
  CHECK(good.complaint.empty());
  const apps::WatchedProcess bad = apps::watch_process(DMPC_PROGRAM, {"machine", "no-machine"}, interrupt);
  CHECK(bad.status == 1);
  CHECK(bad.complaint.find("no-machine") != std::string::npos);
  CHECK(apps::watch_process("/bin/sh", {"-c", "kill -9 $$"}, interrupt).status == -9);
}

TEST_CASE("more complaints than a pipe holds do not block a watched process") {
  const apps::Interrupt interrupt;
  const auto watched = apps::watch_process("/bin/sh", {"-c", "head -c 200000 /dev/zero >&2"}, interrupt);
  CHECK(watched.complaint.size() == 200'000);
}

}  // namespace dmpc::tests::watched_process_test
