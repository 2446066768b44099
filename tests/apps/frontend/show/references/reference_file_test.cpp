#include "apps/frontend/show/references/reference_file.h"

#include <doctest/doctest.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::reference_file_test {

namespace {

using apps::ReferenceTrace;

ReferenceTrace read(const std::string& text) {
  std::istringstream input(text);
  return apps::read_references(input, "t.csv");
}

std::vector<std::uint32_t> pages_of(const ReferenceTrace& trace, std::size_t node) {
  std::vector<std::uint32_t> pages;
  for (const svm::PageId page : trace.nodes.at(node)) {
    pages.push_back(svm::index_of(page));
  }
  return pages;
}

void check_refused(const std::string& text, const char* message) {
  CHECK_THROWS_WITH_AS(read(text), doctest::Contains(message), core::InputError);
}

}  // namespace

TEST_CASE("references are sorted out by node, and pages are numbered in the order of their names") {
  const ReferenceTrace trace =
      read("node,number,page,bytes\n0,0,900,1024\n2,0,18446744073709551615,1024\n0,1,7,1024\n0,2,900,1024\n");
  CHECK(trace.nodes.size() == 3);
  CHECK(pages_of(trace, 0) == std::vector<std::uint32_t>{1, 0, 1});
  CHECK(pages_of(trace, 1).empty());
  CHECK(pages_of(trace, 2) == std::vector<std::uint32_t>{2});
  CHECK(trace.page_count == 3);
  CHECK(trace.reference_count == 4);
}

TEST_CASE("a column of pages is enough, and repeats of a page count but are not kept") {
  const ReferenceTrace trace = read("\xef\xbb\xbfpage\r\n5\r\n\r\n5\r\n5\r\n6");
  CHECK(trace.nodes.size() == 1);
  CHECK(pages_of(trace, 0) == std::vector<std::uint32_t>{0, 1});
  CHECK(trace.reference_count == 4);
}

TEST_CASE("columns are called as one says, and must be there then") {
  std::istringstream input("time,block,thread\n0,5,1\n1,6,0\n");
  const ReferenceTrace trace = apps::read_references(input, "t.csv", {.page = "block", .node = "thread"});
  CHECK(trace.nodes.size() == 2);
  CHECK(pages_of(trace, 1) == std::vector<std::uint32_t>{0});
  std::istringstream other("time,page\n0,5\n");
  CHECK_THROWS_WITH_AS(apps::read_references(other, "t.csv", {.node = "thread"}),
                       doctest::Contains("t.csv:1: no column is called thread"), core::InputError);
}

TEST_CASE("a packed file is told to be unpacked on the way") {
  check_refused("\x1f\x8b\x08 and so on", "t.csv: it is packed; expected a CSV file: zcat FILE | dmpc study references -");
}

TEST_CASE("what is wrong with a file is said with its line, and what was expected") {
  check_refused("", "t.csv:1: the file is empty; expected a line such as node,number,page,bytes");
  check_refused("node,number\n0,0\n", "t.csv:1: no column is called page");
  check_refused("page\n", "there is no reference; expected a line for each");
  check_refused("page\n1\nx\n", "t.csv:3: the page is 'x'; expected a whole number up to 18446744073709551615");
  check_refused("page\n-1\n", "t.csv:2: the page is '-1'");
  check_refused("page\n18446744073709551616\n", "t.csv:2: the page is '18446744073709551616'");
  check_refused("page,node\n1,5000\n", "t.csv:2: the node is '5000'; expected a whole number up to 4095");
  check_refused("page,node\n1\n", "t.csv:2: this line has 1 columns, the first one has 2");
  check_refused("page\n" + std::string(5000, '1') + "\n", "t.csv:2: the line has more than 4096 characters");
  check_refused("page\n" + std::string(4000, '1') + "\n", "t.csv:2: the page is '1111111111111111111111111111111111111111'");
}

TEST_CASE("what is written is read again, one reference a line") {
  std::vector<svm::ReferenceLog> logs(2);
  for (const std::uint32_t page : {3U, 1U, 3U, 3U}) {
    logs[0].note(svm::PageId{page});
  }
  logs[1].note(svm::PageId{9});
  std::stringstream text;
  apps::write_references(text, logs, 512);
  CHECK(text.str() == "node,number,page,bytes\n0,0,3,512\n0,1,1,512\n0,2,3,512\n1,0,9,512\n");
  const ReferenceTrace trace = apps::read_references(text, "again.csv");
  CHECK(pages_of(trace, 0) == std::vector<std::uint32_t>{1, 0, 1});
  CHECK(pages_of(trace, 1) == std::vector<std::uint32_t>{2});
}

TEST_CASE("a file that there is not, or a folder, is refused by name") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(apps::read_references(folder.path() / "none.csv"), doctest::Contains("none.csv"), core::InputError);
  CHECK_THROWS_WITH_AS(apps::read_references(folder.path()), doctest::Contains("a CSV file of page references was expected"),
                       core::InputError);
}

}  // namespace dmpc::tests::reference_file_test
