// Where memory runs out while a picture is packed, it is std::bad_alloc and nothing else, though the libraries that pack are C's.
// This executable has an allocator that fails on demand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "apps/picture/exr_file.h"
#include "apps/picture/png_file.h"

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
}

namespace dmpc::tests::picture_files_allocation_test {
namespace {

struct FailingAllocator {
  bool is_armed = false;
  std::size_t calls = 0, failing = 0;

  bool fails() { return is_armed && calls++ == failing; }
};

FailingAllocator allocator;

}  // namespace
}  // namespace dmpc::tests::picture_files_allocation_test

extern "C" {
void* malloc(std::size_t size) noexcept {
  return dmpc::tests::picture_files_allocation_test::allocator.fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  return dmpc::tests::picture_files_allocation_test::allocator.fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) noexcept {
  return dmpc::tests::picture_files_allocation_test::allocator.fails() ? nullptr : __libc_realloc(block, size);
}
}

namespace dmpc::tests::picture_files_allocation_test {
namespace {

template <class Pack>
bool is_bad_alloc(const Pack& pack, std::size_t failing) {
  bool is = false;
  allocator = {.is_armed = true, .failing = failing};
  try {
    pack();
  } catch (const std::bad_alloc&) {
    is = true;
  } catch (...) {  // a bug: `is` stays false
  }
  allocator.is_armed = false;
  return is;
}

/// Fails each allocation of packing, one in each try. Returns how many there are.
template <class Pack>
std::size_t fail_each(const Pack& pack) {
  allocator = {.is_armed = true, .failing = SIZE_MAX};
  const std::string file = pack();
  allocator.is_armed = false;
  const std::size_t calls = allocator.calls;
  for (std::size_t failing = 0; failing < calls; ++failing) {
    CAPTURE(failing);
    CHECK(is_bad_alloc(pack, failing));
  }
  CHECK(pack() == file);
  return calls;
}

constexpr int width = 33, height = 40;
constexpr std::size_t count = std::size_t{3} * width * height;

template <class Number>
auto taking(const std::vector<Number>& rgb) {
  return [&rgb](std::size_t first, std::span<Number> some) {
    std::ranges::copy(std::span(rgb).subspan(3 * first, some.size()), some.begin());
  };
}

}  // namespace

TEST_CASE("whichever allocation fails while an EXR file is packed, it is std::bad_alloc") {
  std::vector<float> rgb(count);
  for (std::size_t i = 0; i < count; ++i) {
    rgb[i] = static_cast<float>(i * i % 977);
  }
  const apps::ExrRows picture{width, height, {"R", "G", "B"}, taking(rgb), {{"name", "value"}}};
  CHECK(fail_each([&] { return apps::exr_file(picture, 1); }) > 20);
}

TEST_CASE("whichever allocation fails while a PNG file is packed, it is std::bad_alloc") {
  std::vector<std::uint8_t> rgb(count);
  for (std::size_t i = 0; i < count; ++i) {
    rgb[i] = static_cast<std::uint8_t>(i * i % 97);
  }
  CHECK(fail_each([&] { return apps::png_file({width, height, taking(rgb)}, 1); }) > 5);
}

}  // namespace dmpc::tests::picture_files_allocation_test
