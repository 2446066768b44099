// How many lines each library and its tests may have: who adds some raises a number here, and says why in the commit, or takes
// others out.

#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "tests/style/sources.h"
#include "tests/support/documents.h"

namespace dmpc::tests::line_budget_test {

namespace {

namespace fs = std::filesystem;

/// A folder with all below it that no other row names.
struct Row {
  std::string folder;
  std::size_t lines_max;
};
using Rows = std::vector<Row>;

// What was there on 2026-11-30, and 3 %.
const Rows sources = {
    {"apps", 23'970},           {"apps/computer", 5'535},  {"apps/frontend", 14'280},
    {"apps/foreign", 14'380},   {"apps/lab", 2'105},       {"apps/lab/bench", 7'575},
    {"apps/lab/oracle", 5'192}, {"apps/lab/study", 1'960}, {"apps/main", 230},
    {"apps/manual", 60},        {"apps/modules", 670},     {"apps/policy", 1'080},
    {"core", 29'140},           {"core/base", 1'580},      {"dataflow", 8'880},
    {"nodes", 9'897},           {"nodes/pictures", 490},   {"svm", 3'379},
    {"svm/forest", 690},        {"svm/pages", 3'694},
};
const Rows tests = {
    {"tests", 5'750},
    {"tests/apps", 16'710},
    {"tests/apps/computer", 2'210},
    {"tests/apps/frontend", 5'870},
    {"tests/apps/foreign", 6'260},
    {"tests/apps/lab", 6'660},
    {"tests/core", 17'900},
    {"tests/dataflow", 7'600},
    {"tests/nodes", 8'440},
    {"tests/support", 5'055},
    {"tests/svm", 5'350},
    {"tests/whole", 3'980},
};

/// Limit for all sources together, which may be less than the sum of the rows.
constexpr std::size_t sources_max = 133'000;

/// The row of a file: the longest folder that it lies in.
const Row* row_of(const std::string& file, const Rows& rows) {
  const Row* found = nullptr;
  for (const Row& row : rows) {
    if (file.rfind(row.folder + "/", 0) == 0 && (found == nullptr || row.folder.size() > found->folder.size())) {
      found = &row;
    }
  }
  return found;
}

std::string said_of(const std::string& folder, std::size_t lines, std::size_t lines_max) {
  return folder + " has " + std::to_string(lines) + " lines, and its budget is " + std::to_string(lines_max) +
         ": take something out, or raise the number in tests/style/line_budget_test.cpp and say why in the commit";
}

/// A fault for each folder of too many lines and each file that no row has.
Faults faults_of(const std::map<std::string, std::size_t>& lines_of_files, const Rows& rows) {
  std::map<std::string, std::size_t> lines;
  Faults faults;
  for (const auto& [file, count] : lines_of_files) {
    if (const Row* row = row_of(file, rows)) {
      lines[row->folder] += count;
    } else {
      faults.push_back(file + " lies in no folder that has a budget: give it one in tests/style/line_budget_test.cpp");
    }
  }
  for (const Row& row : rows) {
    if (lines[row.folder] > row.lines_max) {
      faults.push_back(said_of(row.folder, lines[row.folder], row.lines_max));
    }
  }
  return faults;
}

std::map<std::string, std::size_t> count_below(const std::vector<std::string>& folders) {
  const fs::path root = DMPC_SOURCE_DIR;
  std::map<std::string, std::size_t> counts;
  for (const std::string& folder : folders) {
    for (const std::string& file : sources_below(root, folder)) {
      counts[file] = lines_of(root / file).size();
    }
  }
  return counts;
}

const std::vector<std::string> layers = {"core", "nodes", "svm", "dataflow", "apps"};

}  // namespace

TEST_CASE("no library has more lines than its budget") { CHECK(faults_of(count_below(layers), sources) == Faults{}); }

TEST_CASE("no library's tests have more lines than their budget") { CHECK(faults_of(count_below({"tests"}), tests) == Faults{}); }

TEST_CASE("all sources together have no more lines than their limit") {
  const auto counts = count_below(layers);
  const auto add = [](std::size_t sum, const auto& file) { return sum + file.second; };
  CHECK(std::accumulate(counts.begin(), counts.end(), std::size_t{0}, add) <= sources_max);
}

TEST_CASE("a line too many is told with its folder, and a file without a budget by its name") {
  const Rows rows = {{"core", 3}, {"core/base", 2}};
  CHECK(faults_of({{"core/a.h", 3}, {"core/base/b.h", 2}}, rows) == Faults{});
  CHECK(faults_of({{"core/a.h", 1}, {"core/base/b.h", 3}}, rows) == Faults{said_of("core/base", 3, 2)});
  CHECK(faults_of({{"core/a.h", 4}}, rows) == Faults{said_of("core", 4, 3)});
  CHECK(faults_of({{"corer/a.h", 1}}, rows).size() == 1);
}

}  // namespace dmpc::tests::line_budget_test
