// The global operators of this executable, replaced by counting ones, and that they count.
#include "tests/support/allocation_guard.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <new>

// All forms, since a sanitizer's own ones do not call the plain one.
void* operator new(std::size_t bytes) { return dmpc::tests::allocation_guard::allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return dmpc::tests::allocation_guard::try_allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return dmpc::tests::allocation_guard::allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return dmpc::tests::allocation_guard::try_allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes) {
  return dmpc::tests::allocation_guard::allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return dmpc::tests::allocation_guard::try_allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return dmpc::tests::allocation_guard::allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return dmpc::tests::allocation_guard::try_allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* place) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete(void* place, std::size_t /*bytes*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete(void* place, std::align_val_t /*alignment*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete(void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  dmpc::tests::allocation_guard::release(place);
}
void operator delete(void* place, const std::nothrow_t& /*tag*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete(void* place, std::align_val_t /*alignment*/, const std::nothrow_t& /*tag*/) noexcept {
  dmpc::tests::allocation_guard::release(place);
}
void operator delete[](void* place) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete[](void* place, std::size_t /*bytes*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete[](void* place, std::align_val_t /*alignment*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete[](void* place, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  dmpc::tests::allocation_guard::release(place);
}
void operator delete[](void* place, const std::nothrow_t& /*tag*/) noexcept { dmpc::tests::allocation_guard::release(place); }
void operator delete[](void* place, std::align_val_t /*alignment*/, const std::nothrow_t& /*tag*/) noexcept {
  dmpc::tests::allocation_guard::release(place);
}

namespace dmpc::tests::allocation_guard_test {
namespace {

TEST_CASE("array and aligned forms are counted like the plain one") {
  const Allocations before = watched_allocations();
  allocation_guard::is_watched = true;
  // Calls of the operators themselves: a compiler may leave out a new-expression whose value is deleted at once.
  ::operator delete[](::operator new[](3));
  ::operator delete (::operator new (128, std::align_val_t{128}), std::align_val_t{128});
  ::operator delete(::operator new(1, std::nothrow));
  allocation_guard::is_watched = false;
  CHECK(watched_allocations().allocated - before.allocated == 3);
  CHECK(watched_allocations().freed - before.freed == 3);
}

TEST_CASE("a thread that is not under watch is not counted") {
  const Allocations before = watched_allocations();
  ::operator delete(::operator new(1));
  CHECK(watched_allocations().allocated == before.allocated);
  CHECK(watched_allocations().freed == before.freed);
}

}  // namespace
}  // namespace dmpc::tests::allocation_guard_test
