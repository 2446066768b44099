// CMake cuts a list at semicolons and joins what brackets enclose, so a test's name with one of them is run as something else or
// not at all.

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/style/sources.h"

namespace dmpc::tests::names_test {

namespace {

namespace fs = std::filesystem;

/// The name that a line gives to a test case; empty if it gives none.
std::string_view test_name(std::string_view line) {
  const std::size_t macro = line.find("TEST_CASE");
  const std::size_t begin = line.find('"', macro);
  const std::size_t end = line.find('"', begin + 1);
  return macro != 0 || end == std::string_view::npos ? std::string_view() : line.substr(begin + 1, end - begin - 1);
}

bool breaks_cmake(std::string_view line) { return test_name(line).find_first_of("[];\\$") != std::string_view::npos; }

/// "file:line" of each such name in our tests.
std::vector<std::string> broken_names() {
  std::vector<std::string> found;
  for (const std::string& file : sources_below(DMPC_SOURCE_DIR, "tests")) {
    std::ifstream text(fs::path(DMPC_SOURCE_DIR) / file);
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
      if (breaks_cmake(line)) {
        found.push_back(file + ":" + std::to_string(number));
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("no test has a name that CMake would cut or join") {
  CHECK(test_name("TEST_CASE(\"a name\") {") == "a name");
  CHECK(breaks_cmake("TEST_CASE(\"values in [0, 1)\") {"));
  CHECK(breaks_cmake("TEST_CASE_TEMPLATE(\"one; two\", T, int) {"));
  CHECK_FALSE(breaks_cmake("TEST_CASE(\"a plain, (ordinary) name\") { values[0]; }"));
  CHECK_FALSE(breaks_cmake("TEST_CASE(\"text\") { CHECK(text(\"[;]\") == 1); }"));
  for (const std::string& place : broken_names()) {
    FAIL_CHECK(place);
  }
}

}  // namespace dmpc::tests::names_test
