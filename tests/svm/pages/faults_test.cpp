#include "svm/pages/faults.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace faults_test {

using namespace dmpc;
using svm::Faults;
using svm::PageId;

namespace {

struct SmallFaults {
  explicit SmallFaults(std::uint32_t slots) : memory(Faults::layout(slots, slots)), faults(memory, slots, slots) {}
  /// Parks and requests; returns whether the fault is new.
  bool park(std::uint32_t slot, std::uint32_t page) {
    Faults::Fault* fault = faults.park(slot, PageId{page}, page % 2);
    if (fault != nullptr) {
      fault->requested = true;
    }
    return fault != nullptr;
  }
  std::vector<std::uint32_t> arrived(std::uint32_t page) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t slot = faults.arrived(PageId{page}); slot != svm::no_slot; slot = faults.next(slot)) {
      slots.push_back(slot);
    }
    return slots;
  }
  nodes::LocalMemory memory;
  Faults faults;
};

using Slots = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("the first slot that misses a page makes a fault, the others wait with it") {
  SmallFaults small(4);
  CHECK(small.park(0, 7));
  CHECK_FALSE(small.park(2, 7));
  CHECK_FALSE(small.park(1, 7));
  CHECK(small.park(3, 8));
  CHECK(small.faults.count() == 2);
  CHECK(small.arrived(7) == Slots{0, 2, 1});
  CHECK(small.arrived(8) == Slots{3});
  CHECK(small.faults.count() == 0);
}

TEST_CASE("a slot that was resumed may wait for the next page at once") {
  SmallFaults small(1);
  for (std::uint32_t page = 0; page < 10; ++page) {
    CHECK(small.park(0, page));
    CHECK(small.arrived(page) == Slots{0});
  }
}

TEST_CASE("there are as many faults as slots, and no more") {
  SmallFaults small(2);
  CHECK(small.park(0, 1));
  CHECK(small.park(1, 2));
  CHECK_THROWS_AS(small.park(0, 3), core::InternalError);
}

TEST_CASE("a page that nobody asked for is an error") {
  SmallFaults small(2);
  CHECK_THROWS_AS(small.arrived(1), core::InternalError);
  small.faults.park(0, PageId{1}, 0);
  CHECK_THROWS_AS(small.arrived(1), core::InternalError);
}

TEST_CASE("refused requests to a home come back oldest first") {
  SmallFaults small(4);
  small.park(0, 2);
  small.faults.park(1, PageId{4}, 0);
  small.faults.park(2, PageId{3}, 1);
  small.faults.park(3, PageId{6}, 0);
  REQUIRE(small.faults.oldest_refused(0) != nullptr);
  CHECK(small.faults.oldest_refused(0)->page == PageId{4});
  small.faults.oldest_refused(0)->requested = true;
  CHECK(small.faults.oldest_refused(0)->page == PageId{6});
  CHECK(small.faults.oldest_refused(1)->page == PageId{3});
  CHECK(small.faults.oldest_refused(2) == nullptr);
}

}  // namespace faults_test
