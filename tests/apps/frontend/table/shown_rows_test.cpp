#include "apps/frontend/table/shown_rows.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "tests/support/text.h"

namespace dmpc::tests::shown_rows_test {

namespace {

apps::Table rows_so_far(std::uint64_t count, double seconds) {
  apps::Table table("rows", {{"nodes"}, {"time", "s", 1}});
  for (std::uint64_t nodes = 1; nodes <= count; ++nodes) {
    table.add_row({nodes, seconds});
  }
  return table;
}

}  // namespace

TEST_CASE("each row is shown once, and again when it says something else") {
  std::ostringstream messages;
  apps::ShownRows shown(true, messages);
  shown.show(rows_so_far(1, 2));
  shown.show(rows_so_far(2, 2));
  CHECK(messages.str() == "\r\x1b[Knodes 1, time (s) 2.0\n\r\x1b[Knodes 2, time (s) 2.0\n");
  shown.show(rows_so_far(1, 4));
  CHECK(contains(messages.str(), "nodes 1, time (s) 4.0"));
}

TEST_CASE("rows alike of two tables are two rows") {
  std::ostringstream messages;
  apps::ShownRows shown(true, messages);
  apps::Table other("other rows", {{"nodes"}});
  other.add_row({std::uint64_t{1}});
  shown.show(rows_so_far(1, 2));
  shown.show(other);
  CHECK(count(messages.str(), "nodes 1") == 2);
}

TEST_CASE("no row is shown where nobody waits for it") {
  std::ostringstream messages;
  apps::ShownRows(false, messages).show(rows_so_far(3, 1));
  CHECK(messages.str().empty());
  CHECK_FALSE(apps::shows_rows({}, true));
  CHECK_FALSE(apps::shows_rows({.format = apps::TableFormat::csv}, false));
  CHECK_FALSE(apps::shows_rows({.file = "table.md"}, false));
}

}  // namespace dmpc::tests::shown_rows_test
