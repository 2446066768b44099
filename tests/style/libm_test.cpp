// Repeatable on every machine: what decides a picture or a count uses nothing of libm beyond sqrt, fma and exact functions, whose
// results differ from one version to the next.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/style/sources.h"

namespace libm_test {

namespace {

/// Where in `line` an inexact function of libm is called, or npos.
std::size_t inexact_call(const std::string& line) {
  static const std::vector<std::string> names = {"cbrt", "hypot", "pow",  "exp",  "exp2", "expm1", "log",  "log2", "log10", "sin",
                                                 "cos",  "tan",   "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh"};
  for (const std::string& name : names) {
    const std::size_t at = line.find("std::" + name + "(");
    if (at != std::string::npos && at < line.find("//")) {
      return at;
    }
  }
  return std::string::npos;
}

}  // namespace

TEST_CASE("nothing that decides a picture or a count calls an inexact function of libm") {
  int files = 0;
  for (const char* folder : {"core", "nodes", "svm", "dataflow"}) {
    for (const std::string& source : dmpc::tests::sources_below(DMPC_SOURCE_DIR, folder)) {
      ++files;
      std::ifstream file(std::filesystem::path(DMPC_SOURCE_DIR) / source);
      std::string line;
      for (int number = 1; std::getline(file, line); ++number) {
        INFO(source << ":" << number << ": " << line);
        CHECK(inexact_call(line) == std::string::npos);
      }
    }
  }
  CHECK(files > 100);
}

TEST_CASE("a call of an inexact function is seen, its name in a comment is not") {
  CHECK(inexact_call("  return std::hypot(x, y);") == 9);
  CHECK(inexact_call("  return x;  // not std::hypot(x, y)") == std::string::npos);
  CHECK(inexact_call("  return std::sqrt(x);") == std::string::npos);
}

}  // namespace libm_test
