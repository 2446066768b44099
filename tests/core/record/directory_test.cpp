#include "core/record/directory.h"

#include <doctest/doctest.h>

#include <set>

namespace directory_test {

using namespace dmpc::core;

namespace {

using Triple = std::array<std::int32_t, 3>;

Triple corner(std::int32_t x, std::int32_t y, std::int32_t z) {
  return {x * finest_per_macro, y * finest_per_macro, z * finest_per_macro};
}

}  // namespace

TEST_CASE("every macro cell has an entry of its own inside the directory") {
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

TEST_CASE("neighbours along x are neighbours in the directory") {
  const Triple size{8, 8, 8};
  CHECK(directory_index(size, corner(3, 2, 1)) == directory_index(size, corner(2, 2, 1)) + 1);
  CHECK(directory_index(size, corner(2, 3, 1)) == directory_index(size, corner(2, 2, 1)) + 8);
  CHECK(directory_index(size, corner(2, 2, 2)) == directory_index(size, corner(2, 2, 1)) + 64);
}

TEST_CASE("an odd number of entries is made even, since records hold two") {
  CHECK(directory_entry_count({1, 1, 1}) == 2);
  CHECK(directory_entry_count({3, 5, 7}) == 106);
  CHECK(directory_entry_count({2, 5, 7}) == 70);
}

TEST_CASE("any place in a macro cell leads to its entry") {
  const Triple size{8, 8, 8};
  CHECK(directory_index(size, {256, 512, 768}) == directory_index(size, {511, 512 + 255, 768 + 1}));
}

TEST_CASE("two entries share a record, and a directory may begin anywhere") {
  DatabaseHeader header;
  header.directory = Address{10};
  header.directory_size = {8, 8, 8};
  header.directory_low = corner(5, 0, 0);
  const std::uint64_t first = directory_index(header, corner(7, 0, 0)), second = directory_index(header, corner(8, 0, 0));
  CHECK(first == 2);
  CHECK(directory_address(header, first) == Address{11});
  CHECK(directory_address(header, second) == Address{11});
  CHECK(directory_offset(first) == 0);
  CHECK(directory_offset(second) == 4);
}

}  // namespace directory_test
