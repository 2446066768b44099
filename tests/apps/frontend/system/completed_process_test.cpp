#include "apps/frontend/system/completed_process.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"

namespace dmpc::tests::completed_process_test {

TEST_CASE("a process that has ended tells how, and what it complained of") {
  const apps::Interrupt interrupt;
  const apps::CompletedProcess good = apps::run_process(DMPC_PROGRAM, {"machine", "ipsc2"}, interrupt);
  CHECK(good.status == 0);
  CHECK(good.complaint.empty());
  const apps::CompletedProcess bad = apps::run_process(DMPC_PROGRAM, {"machine", "no-machine"}, interrupt);
  CHECK(bad.status == 1);
  CHECK(bad.complaint.find("no-machine") != std::string::npos);
  CHECK(apps::run_process("/bin/sh", {"-c", "kill -9 $$"}, interrupt).status == -9);
  CHECK_THROWS_AS(apps::run_process("/no/program", {}, interrupt), core::InputError);
}

TEST_CASE("more complaints than a pipe holds do not block a process") {
  const apps::Interrupt interrupt;
  const auto ended = apps::run_process("/bin/sh", {"-c", "head -c 200000 /dev/zero >&2"}, interrupt);
  CHECK(ended.complaint.size() == 200'000);
}

}  // namespace dmpc::tests::completed_process_test
