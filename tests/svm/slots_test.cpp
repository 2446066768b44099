#include "svm/slots.h"

#include <doctest/doctest.h>

#include "tests/support/small_machine.h"

namespace slots_test {

using namespace dmpc;

namespace {

struct SmallSlots {
  explicit SmallSlots(std::uint32_t count) : memory(svm::Slots<core::PixelTask>::layout(count, 5)), slots(memory, count, 5) {}
  nodes::LocalMemory memory;
  svm::Slots<core::PixelTask> slots;
};

}  // namespace

TEST_CASE("every slot is free at first and there are no more") {
  SmallSlots small(3);
  CHECK(small.slots.active() == 0);
  CHECK(small.slots.take_free() == 0);
  CHECK(small.slots.take_free() == 1);
  CHECK(small.slots.take_free() == 2);
  CHECK(small.slots.active() == 3);
  CHECK_FALSE(small.slots.has_free());
  CHECK_THROWS_AS(small.slots.take_free(), core::InternalError);
}

TEST_CASE("the slot that was made runnable last runs first") {
  SmallSlots small(3);
  CHECK_THROWS_AS(small.slots.take_runnable(), core::InternalError);
  small.slots.make_runnable(1);
  small.slots.make_runnable(2);
  CHECK(small.slots.take_runnable() == 2);
  CHECK(small.slots.take_runnable() == 1);
  CHECK_FALSE(small.slots.has_runnable());
}

TEST_CASE("a slot given back too often is an error") {
  SmallSlots small(1);
  CHECK_THROWS_AS(small.slots.make_free(0), core::InternalError);
  small.slots.make_free(small.slots.take_free());
  CHECK(small.slots.active() == 0);
}

TEST_CASE("slots take exactly the memory that they say they need") {
  for (const std::uint32_t count : {1U, 2U, 64U}) {
    SmallSlots small(count);
    CHECK(small.memory.used().bytes == nodes::MemoryPlan(svm::Slots<core::PixelTask>::layout(count, 5)).bytes);
  }
}

}  // namespace slots_test
