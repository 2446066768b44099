#include "nodes/ranks/nap.h"

#include <doctest/doctest.h>

namespace nap_test {

using dmpc::nodes::Idle;
using dmpc::nodes::Nap;

TEST_CASE("naps get longer up to a bound, in a long silence up to another, and start anew when something was done") {
  Nap nap;
  CHECK(nap.next() == Nap::shortest);
  CHECK(nap.next() == 2 * Nap::shortest);
  CHECK(nap.next() == Nap::longest);
  for (auto slept = 3 * Nap::shortest + Nap::longest; slept < Nap::silence; slept += Nap::longest) {
    CHECK(nap.next() == Nap::longest);
  }
  for (int i = 0; i < 5; ++i) {
    nap.next();
  }
  CHECK(nap.next() == 10 * Nap::longest);
  nap.end();
  CHECK(nap.next() == Nap::shortest);
}

TEST_CASE("who has a core of its own does not sleep") {
  Nap nap(Idle::spin);
  CHECK(nap.next() == nap.next().zero());
}

}  // namespace nap_test
