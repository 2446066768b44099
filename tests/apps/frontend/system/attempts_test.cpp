#include "apps/frontend/system/attempts.h"

#include <doctest/doctest.h>

#include <sstream>
#include <stdexcept>

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/surroundings.h"
#include "core/base/expect.h"

namespace dmpc::apps::attempts_test {

TEST_CASE("what fails is said, a line each, and keeps nothing that follows from its turn") {
  std::ostringstream messages;
  Attempts attempts(messages);
  int made = 0;
  CHECK_FALSE(attempts.make([] { throw core::InputError("a: cannot be written"); }));
  CHECK(attempts.make([&made] { ++made; }));
  CHECK_FALSE(attempts.make([] { throw core::InputError("b: cannot be written"); }));
  CHECK(made == 1);
  CHECK(messages.str() == "dmpc: a: cannot be written\ndmpc: b: cannot be written\n");
  CHECK(attempts.status() == 1);
}

TEST_CASE("want of room is said, too, and is no bad input, and the first that fails counts") {
  std::ostringstream messages;
  Attempts attempts(messages);
  CHECK_FALSE(attempts.make([] { throw core::CapacityError("a: Cannot allocate memory"); }));
  CHECK(attempts.status() == 4);
  CHECK_FALSE(attempts.make([] { throw core::InputError("b: cannot be written"); }));
  CHECK(messages.str() == "dmpc: a: Cannot allocate memory\ndmpc: b: cannot be written\n");
  CHECK(attempts.status() == 4);
}

TEST_CASE("where all succeeds the status is 0") {
  std::ostringstream messages;
  Attempts attempts(messages);
  attempts.make([] {});
  CHECK(attempts.status() == 0);
  CHECK(messages.str().empty());
}

TEST_CASE("an error of our own does not look like bad input, and waits until all have had their turn") {
  std::ostringstream messages;
  Attempts attempts(messages);
  int made = 0;
  attempts.make([] { throw std::logic_error("ours"); });
  attempts.make([&made] { ++made; });
  CHECK(made == 1);
  CHECK_THROWS_AS(attempts.status(), std::logic_error);
}

TEST_CASE("a broken pipe is not said, keeps nothing that follows from its turn, and is what all come to") {
  std::ostringstream messages;
  Attempts attempts(messages);
  int made = 0;
  attempts.make([] { throw BrokenPipe("nobody reads"); });
  attempts.make([&made] { ++made; });
  CHECK(made == 1);
  CHECK(messages.str().empty());
  CHECK_THROWS_AS(attempts.status(), BrokenPipe);
}

TEST_CASE("an interruption ends all") {
  std::ostringstream messages;
  Attempts attempts(messages);
  CHECK_THROWS_AS(attempts.make([] { throw Interrupted{}; }), Interrupted);
}

}  // namespace dmpc::apps::attempts_test
