#include "nodes/ranks/nap.h"

#include <doctest/doctest.h>

namespace dmpc::tests::nap_test {

namespace {

using nodes::Nap;

}  // namespace

TEST_CASE("naps double, and are tenfold after a long silence") {
  Nap nap;
  CHECK(nap.next() == Nap::shortest);
  CHECK(nap.next() == 2 * Nap::shortest);
  std::chrono::nanoseconds slept = 3 * Nap::shortest, last{};
  while (slept < Nap::silence) {
    last = nap.next();
    CHECK(last <= Nap::longest);
    slept += last;
  }
  CHECK(last == Nap::longest);
  nap.next();
  CHECK(nap.next() > Nap::longest);
  for (int i = 0; i < 10; ++i) {
    last = nap.next();
  }
  CHECK(last == 10 * Nap::longest);
}

TEST_CASE("after something was done naps are short again") {
  Nap nap;
  for (int i = 0; i < 1000; ++i) {
    nap.next();
  }
  nap.end();
  CHECK(nap.next() == Nap::shortest);
}

TEST_CASE("who spins never sleeps") {
  Nap nap(nodes::Idle::spin);
  for (int i = 0; i < 1000; ++i) {
    CHECK(nap.next() == std::chrono::nanoseconds::zero());
  }
}

}  // namespace dmpc::tests::nap_test
