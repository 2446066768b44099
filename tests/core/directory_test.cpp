#include "core/directory.h"

#include <doctest/doctest.h>

#include <set>

using namespace dmpc::core;

namespace {

using Triple = std::array<std::int32_t, 3>;

Triple corner(std::int32_t x, std::int32_t y, std::int32_t z) {
  return {x * finest_per_top, y * finest_per_top, z * finest_per_top};
}

}  // namespace

TEST_CASE("every top cell has an entry of its own inside the directory") {
  for (const Triple& size : {Triple{1, 1, 1}, Triple{5, 1, 9}, Triple{4, 4, 4}, Triple{3, 7, 2}}) {
    std::set<std::uint64_t> indices;
    for (std::int32_t z = 0; z < size[2]; ++z) {
      for (std::int32_t y = 0; y < size[1]; ++y) {
        for (std::int32_t x = 0; x < size[0]; ++x) {
          const std::uint64_t index = directory_index(size, corner(x, y, z));
          CHECK(index < directory_entry_count(size));
          indices.insert(index);
        }
      }
    }
    CHECK(indices.size() == static_cast<std::size_t>(size[0] * size[1] * size[2]));
  }
}

TEST_CASE("cells of one tile share 256 bytes") {
  const Triple size{8, 8, 8};
  for (std::int32_t i = 0; i < 64; ++i) {
    CHECK(directory_index(size, corner(i % 4, i / 4 % 4, i / 16)) < 64);
  }
  CHECK(directory_index(size, corner(4, 0, 0)) == 64);
}

TEST_CASE("any place in a top cell leads to its entry") {
  const Triple size{8, 8, 8};
  CHECK(directory_index(size, {256, 512, 768}) == directory_index(size, {511, 512 + 255, 768 + 1}));
}

TEST_CASE("a record of two entries gives each cell its own") {
  DatabaseHeader header;
  header.directory = Address{10};
  header.directory_size = {8, 8, 8};
  const DirectoryEntry entries[2] = {{7}, {9}};
  const auto* record = reinterpret_cast<const std::byte*>(entries);
  CHECK(directory_address(header, corner(2, 0, 0)) == Address{11});
  CHECK(directory_address(header, corner(3, 0, 0)) == Address{11});
  CHECK(directory_entry(record, corner(2, 0, 0)).bits == 7);
  CHECK(directory_entry(record, corner(3, 0, 0)).bits == 9);
}
