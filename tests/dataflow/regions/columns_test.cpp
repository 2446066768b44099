#include "dataflow/regions/columns.h"

#include <doctest/doctest.h>

namespace dmpc::tests::columns_test {

using dataflow::ColumnLattice;

TEST_CASE("a lattice puts every finest index into the column between whose lines it lies") {
  for (const std::int32_t size : {1, 3, 64, 640, 1000}) {
    const ColumnLattice lattice({size, 7, 64}, {0, 2}, 48);
    CHECK(lattice.line(0, 0) == 0);
    CHECK(lattice.line(0, lattice.count(0)) == size);
    for (std::int32_t finest = 0; finest < size; ++finest) {
      const std::int32_t column = lattice.column_at(0, finest);
      CHECK((lattice.line(0, column) <= finest && finest < lattice.line(0, column + 1)));
    }
  }
}

TEST_CASE("a lattice finer than the finest cells has one column a cell") {
  const ColumnLattice lattice({5, 64, 64}, {1, 0}, 256);
  CHECK(lattice.count(0) == 64);
  CHECK(lattice.count(1) == 5);
  CHECK(lattice.column_count() == 320);
  CHECK(lattice.column_of({4, 63, 17}) == 319);
}

TEST_CASE("a column does not depend on where along the third axis a cell is") {
  const ColumnLattice lattice({128, 192, 64}, {0, 1}, 16);
  CHECK(lattice.column_of({9, 100, 0}) == lattice.column_of({9, 100, 63}));
}

TEST_CASE("a lattice without columns or with one axis twice is refused") {
  CHECK_THROWS_AS(ColumnLattice({64, 64, 64}, {1, 1}, 4), core::InternalError);
  CHECK_THROWS_AS(ColumnLattice({64, 64, 64}, {0, 3}, 4), core::InternalError);
  CHECK_THROWS_AS(ColumnLattice({64, 64, 64}, {0, 1}, 0), core::InternalError);
  CHECK_THROWS_AS(ColumnLattice({64, 0, 64}, {0, 1}, 4), core::InternalError);
}

}  // namespace dmpc::tests::columns_test
