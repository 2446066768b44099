// Files of tests are compiled many at a time, as the batches fall: what two of them name alike must not meet.

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "tests/style/sources.h"

namespace dmpc::tests::names_test {

namespace {

namespace fs = std::filesystem;

/// The name of the namespace that a line opens; empty if it opens none, or one without a name.
std::string opened(std::string_view line) {
  constexpr std::string_view word = "namespace ", brace = " {";
  return line.starts_with(word) && line.ends_with(brace) && line.size() > word.size() + brace.size()
             ? std::string(line.substr(word.size(), line.size() - word.size() - brace.size()))
             : "";
}

/// The first namespace of the file that ends as the file is called; empty if there is none.
std::string own_namespace(const std::string& file) {
  std::ifstream text(fs::path(DMPC_SOURCE_DIR) / file);
  const std::string stem = fs::path(file).stem();
  for (std::string line; std::getline(text, line);) {
    if (const std::string name = opened(line); name.ends_with(stem)) {
      return name;
    }
  }
  return "";
}

}  // namespace

TEST_CASE("each file of tests has a namespace of its own, which ends as the file is called") {
  CHECK(opened("namespace dmpc::svm::pager_test {") == "dmpc::svm::pager_test");
  CHECK(opened("namespace {") == "");
  CHECK(opened("namespace fs = std::filesystem;") == "");
  std::map<std::string, std::string> file_of;
  for (const std::string& file : sources_below(DMPC_SOURCE_DIR, "tests")) {
    if (!file.ends_with("_test.cpp")) {
      continue;
    }
    const std::string name = own_namespace(file);
    CHECK_MESSAGE(!name.empty(), file, " has no namespace that ends in ", fs::path(file).stem());
    const auto [place, is_new] = file_of.emplace(name, file);
    CHECK_MESSAGE(is_new, file, " has the namespace of ", place->second);
  }
  CHECK(file_of.size() > 400);
}

}  // namespace dmpc::tests::names_test
