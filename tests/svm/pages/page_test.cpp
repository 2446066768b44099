#include "svm/pages/page.h"

#include <doctest/doctest.h>

namespace pages_page_test {

using namespace dmpc;

TEST_CASE("a page is a power of two from 512 B to 64 KiB") {
  CHECK(svm::is_page_size(512));
  CHECK(svm::is_page_size(65536));
  CHECK_FALSE(svm::is_page_size(0));
  CHECK_FALSE(svm::is_page_size(256));
  CHECK_FALSE(svm::is_page_size(1000));
  CHECK_FALSE(svm::is_page_size(131072));
  CHECK_THROWS_AS(svm::PageGeometry(1000), core::InternalError);
}

TEST_CASE("a record lies at its byte offset divided by the page size") {
  for (const std::size_t size : {512U, 1024U, 4096U, 65536U}) {
    const svm::PageGeometry geometry(size);
    for (const std::uint32_t address : {0U, 1U, 63U, 64U, 127U, 128U, 8191U, 8192U, 123456789U}) {
      const std::uint64_t bytes = std::uint64_t{address} * 8;
      CHECK(svm::index_of(geometry.page_of(core::Address{address})) == bytes / size);
      CHECK(geometry.offset_of(core::Address{address}) == bytes % size);
    }
  }
}

TEST_CASE("the last record of the address space is found") {
  const svm::PageGeometry geometry(512);
  CHECK(svm::index_of(geometry.page_of(core::Address{0xfffffffeU})) == 0x3ffffffU);
  CHECK(geometry.offset_of(core::Address{0xfffffffeU}) == 496);
}

}  // namespace pages_page_test
