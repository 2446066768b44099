#include "core/database/record_writer.h"

#include <doctest/doctest.h>

#include "apps/lab/bench/stability/random.h"

namespace record_writer_test {

using namespace dmpc::apps;
using namespace dmpc::core;
using dmpc::apps::Random;

TEST_CASE("no record crosses a page's border, and addresses ascend") {
  for (std::size_t page_size = 512; page_size <= 65536; page_size *= 2) {
    RecordWriter writer(page_size);
    Random random(page_size);
    std::uint64_t behind = 0;
    for (int i = 0; i < 2000; ++i) {
      const std::size_t bytes = 1 + random.below(record_bytes_max);
      const std::uint64_t first = byte_offset(writer.allocate(bytes));
      CHECK(first >= behind);
      CHECK(first / page_size == (first + bytes - 1) / page_size);
      behind = first + bytes;
    }
    CHECK((std::move(writer).finish().size() - overread_bytes) % page_size == 0);
  }
}

TEST_CASE("a record that just fits a page's rest stays in it") {
  RecordWriter writer(512);
  writer.allocate(448);
  CHECK(byte_offset(writer.allocate(64)) == 448);
  CHECK(byte_offset(writer.allocate(8)) == 512);
  CHECK(byte_offset(writer.allocate(448)) == 520);
  CHECK(byte_offset(writer.allocate(57)) == 1024);
}

TEST_CASE("records with a share of pages take that on the average, and none crosses a page's border") {
  RecordWriter writer(1024);
  writer.allocate_array<std::uint32_t>(100);
  std::uint64_t last = 0;
  for (int i = 0; i < 800; ++i) {
    const std::uint64_t at = byte_offset(writer.allocate(96, 129));
    CHECK(at / 1024 == (at + 95) / 1024);
    CHECK((i == 0 || at >= last + 96));
    last = at;
  }
  CHECK(last >= 400 + 799 * 129 - 129);
  CHECK(last <= 400 + 799 * 129 + 129);
  CHECK(writer.page_bytes() == round_up(std::size_t{400 + 800 * 129}, std::size_t{1024}));
}

TEST_CASE("in a run of shares a record without one takes what it needs, and those behind it take theirs nevertheless") {
  RecordWriter writer(1024);
  std::uint64_t last = 0;
  for (int i = 0; i < 400; ++i) {
    last = byte_offset(writer.allocate(40, 120));
    writer.allocate(40, 0);
  }
  CHECK(last >= 399 * 160 - 160);
  CHECK(last <= 399 * 160 + 160);
}

TEST_CASE("records of nothing and of too much are refused") {
  RecordWriter writer(512);
  CHECK_THROWS_AS(writer.allocate(0), InternalError);
  CHECK_THROWS_AS(writer.allocate(449), InternalError);
}

TEST_CASE("an array's records do not cross a page's border") {
  RecordWriter writer(512);
  writer.allocate(20);
  const std::uint64_t first = byte_offset(writer.allocate_array<LightRecord>(1000));
  CHECK(first % sizeof(LightRecord) == 0);
  CHECK(byte_offset(writer.allocate(8)) >= first + 1000 * sizeof(LightRecord));
}

TEST_CASE("what is written is found again, the rest is zero") {
  RecordWriter writer(512);
  const Address address = writer.allocate(16);
  writer.write(address, 8, std::uint32_t{77});
  const auto bytes = std::move(writer).finish();
  CHECK(bytes.size() == 512 + overread_bytes);
  CHECK(bytes[byte_offset(address) + 8] == std::byte{77});
  CHECK(bytes[byte_offset(address) + 12] == std::byte{0});
}

TEST_CASE("with all room made at once the pages take no more than their bytes, and nothing is moved in the end") {
  RecordWriter writer(512);
  writer.write(writer.allocate(16), 0, std::uint32_t{1});
  for (int record = 0; record < 1000; ++record) {
    writer.allocate(100);
  }
  writer.make_room();
  const auto bytes = std::move(writer).finish();
  CHECK(bytes.capacity() == bytes.size());
}

TEST_CASE("nothing written is one empty page") { CHECK(RecordWriter(1024).finish().size() == 1024 + overread_bytes); }

TEST_CASE("more than 16 GiB are refused as bad input") {
  RecordWriter writer(65536);
  CHECK_THROWS_AS(writer.allocate_array<LightRecord>(std::size_t{1} << 30U), InputError);
}

}  // namespace record_writer_test
