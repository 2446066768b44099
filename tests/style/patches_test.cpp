// The known bugs that tests/mutation puts back still find the lines that they change: the part `slow` alone builds them.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/support/documents.h"

namespace dmpc::tests::patches_test {

namespace {

namespace fs = std::filesystem;

/// A fault for each hunk whose old lines do not stand one after the other in the file that it names.
Faults faults_of(const Lines& patch, const fs::path& root, const std::string& name) {
  Lines file, old;
  Faults faults;
  const auto end_hunk = [&] {
    if (!old.empty() && std::search(file.begin(), file.end(), old.begin(), old.end()) == file.end()) {
      faults.push_back(name + ": its file does not have the line: " + old.front());
    }
    old.clear();
  };
  for (const std::string& line : patch) {
    if (line.starts_with("--- a/")) {
      end_hunk();
      file = lines_of(root / line.substr(6));
    } else if (line.starts_with("@@")) {
      end_hunk();
    } else if (!file.empty() && (line.starts_with("-") || line.starts_with(" "))) {
      old.push_back(line.substr(1));
    }
  }
  end_hunk();
  return faults;
}

}  // namespace

TEST_CASE("each known bug still finds the lines that it changes") {
  const fs::path root = DMPC_SOURCE_DIR;
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "tests/mutation")) {
    if (entry.path().extension() == ".patch") {
      for (const std::string& fault : faults_of(lines_of(entry.path()), root, entry.path().filename())) {
        FAIL_CHECK(fault);
      }
      ++count;
    }
  }
  CHECK(count > 10);
}

TEST_CASE("a line that changed since is told") {
  const Lines patch = {"A bug.", "", "--- a/README.md", "+++ b/README.md", "@@ -1,1 +1,1 @@", "-no such line", "+another"};
  CHECK(faults_of(patch, DMPC_SOURCE_DIR, "a.patch") == Faults{"a.patch: its file does not have the line: no such line"});
}

}  // namespace dmpc::tests::patches_test
