#include "nodes/ranks/backoff.h"

#include <doctest/doctest.h>

namespace backoff_test {

using dmpc::nodes::Backoff;
using dmpc::nodes::Idle;

TEST_CASE("sleeps get longer up to a bound, in a long silence up to another, and start anew when something was done") {
  Backoff backoff;
  CHECK(backoff.next() == Backoff::shortest);
  CHECK(backoff.next() == 2 * Backoff::shortest);
  CHECK(backoff.next() == Backoff::longest);
  for (auto slept = 3 * Backoff::shortest + Backoff::longest; slept < Backoff::silence; slept += Backoff::longest) {
    CHECK(backoff.next() == Backoff::longest);
  }
  for (int i = 0; i < 5; ++i) {
    backoff.next();
  }
  CHECK(backoff.next() == 10 * Backoff::longest);
  backoff.end();
  CHECK(backoff.next() == Backoff::shortest);
}

TEST_CASE("who has a core of its own does not sleep") {
  Backoff backoff(Idle::spin);
  CHECK(backoff.next() == backoff.next().zero());
}

}  // namespace backoff_test
