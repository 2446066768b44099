#include "core/base/zeroed_array.h"

#include <doctest/doctest.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace dmpc::core::zeroed_array_test {
namespace {

/// Nothing, one, less than a large page, and several.
constexpr std::size_t counts[] = {0, 1, 1000, std::size_t{3} << 20U};

TEST_CASE("a zeroed array is zero, where another array was before, too") {
  for (const std::size_t count : counts) {
    for (int again = 0; again < 2; ++again) {
      ZeroedArray<std::uint64_t> array(count);
      REQUIRE(array.size() == count);
      CHECK(std::all_of(array.span().begin(), array.span().end(), [](std::uint64_t one) { return one == 0; }));
      for (std::size_t i = 0; i < count; ++i) {
        array[i] = ~std::uint64_t{0};
      }
    }
  }
}

TEST_CASE("a copy of a zeroed array is another array with its values") {
  for (const std::size_t count : counts) {
    ZeroedArray<std::uint64_t> array(count);
    for (std::size_t i = 0; i < count; ++i) {
      array[i] = i + 1;
    }
    ZeroedArray<std::uint64_t> copy = array;
    CHECK(std::equal(copy.span().begin(), copy.span().end(), array.span().begin(), array.span().end()));
    if (count > 0) {
      copy[count - 1] = 0;
      CHECK(array[count - 1] == count);
      array = copy;
      CHECK(array[count - 1] == 0);
    }
  }
}

TEST_CASE("a zeroed array that is moved keeps its place and leaves nothing behind") {
  for (const std::size_t count : counts) {
    ZeroedArray<std::uint64_t> array(count);
    const std::uint64_t* const first = array.span().data();
    ZeroedArray<std::uint64_t> moved = std::move(array);
    CHECK(moved.span().data() == first);
    CHECK(moved.size() == count);
    CHECK(array.size() == 0);  // NOLINT(bugprone-use-after-move): that is the promise
    ZeroedArray<std::uint64_t> other(7);
    other = std::move(moved);
    CHECK(other.span().data() == first);
    CHECK(other.size() == count);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose allocators end the process instead
TEST_CASE("an array larger than the real computer's memory is refused") {
  CHECK_THROWS_AS(ZeroedArray<std::uint64_t>(std::size_t{1} << 57U), std::bad_alloc);
}
#endif

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a large array takes nothing of the real computer until it is written") {
  constexpr std::size_t bytes = std::size_t{64} << 20U, page_bytes = 4096;
  ZeroedArray<std::uint8_t> array(bytes);
  std::vector<unsigned char> is_resident(bytes / page_bytes);
  array[bytes / 2] = 1;
  REQUIRE(::mincore(&array[0], bytes, is_resident.data()) == 0);
  const auto resident = std::count_if(is_resident.begin(), is_resident.end(), [](unsigned char one) { return (one & 1U) != 0; });
  CHECK(resident >= 1);
  CHECK(resident <= 512);  // a large page at most
}
#endif

}  // namespace
}  // namespace dmpc::core::zeroed_array_test
