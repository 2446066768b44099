#include "apps/lab/study/references/command.h"

#include <doctest/doctest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/show/page/escaped.h"
#include "apps/frontend/show/references/reference_file.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/lab/study/references/gzip_text.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::references_command_test {

namespace {

/// What the command writes of a file with these lines.
std::string output_of(const std::string& lines, const std::vector<std::uint32_t>& cache_pages,
                      const apps::ReferenceColumns& columns = {}) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "trace.csv").string();
  std::ofstream(path) << lines;
  apps::Interrupt interrupt;
  std::ostringstream output;
  const apps::ReferencesOptions options{
      .file = path, .columns = columns, .cache_pages = cache_pages, .table = {.format = apps::TableFormat::csv}, .quiet = true};
  CHECK(apps::study_references_command(options, interrupt, output) == 0);
  return output.str();
}

}  // namespace

TEST_CASE("the faults of a trace that was worked out on paper: fifo's anomaly") {
  // Belady, Nelson and Shedler (1969): fifo faults 9 times with 3 frames and 10 times with 4, lru 10 and 8 times; the least are 7
  // and 6.
  const std::string output = output_of("page\n1\n2\n3\n4\n1\n2\n5\n1\n2\n3\n4\n5\n", {3, 4});
  CHECK(output.find("cache pages,share of pages (%),misses lru (%),faults lru,faults clock,faults fifo") != std::string::npos);
  CHECK(output.find("\n3,60,83.33333333333333,10,9,9,") != std::string::npos);
  CHECK(output.find("\n4,80,66.66666666666667,8,10,10,") != std::string::npos);
  CHECK(output.find(",7\n") != std::string::npos);
  CHECK(output.find(",6\n") != std::string::npos);
}

TEST_CASE("each node has a cache of its own, and faults are those of all") {
  const std::string output = output_of("node,page\n0,1\n1,2\n0,1\n1,2\n0,3\n0,1\n", {1});
  CHECK(output.find("\n1,33.333333333333336,66.66666666666667,4,4,4,4,4,4,4,4\n") != std::string::npos);
}

TEST_CASE("a cache larger than all memory costs none for pages that there are not, and takes each page in once") {
  const std::string output = output_of("node,page\n0,1\n0,2\n0,1\n2,7\n", {2'147'483'647});
  CHECK(output.find(",75,3,3,3,3,3,3,3,3\n") != std::string::npos);
}

TEST_CASE("without sizes there are those from one page to all") {
  const std::string output = output_of("page\n1\n2\n3\n1\n", {});
  CHECK(output.find("\n1,") != std::string::npos);
  CHECK(output.find("\n3,100,75,3,") != std::string::npos);
}

TEST_CASE("references come from a pipe, whose columns are called as one says") {
  const TemporaryFolder folder;
  write_text(folder / "trace.csv", "thread,block\n0,1\n0,2\n0,1\n");
  const std::string line = "cat " + (folder / "trace.csv").string() +
                           " | " DMPC_PROGRAM
                           " study references - --page-column=block --node-column=thread --cache-pages=2 --format=csv --quiet";
  ChildProcess shell({"/bin/sh", "-c", line});
  CHECK(shell.status() == 0);
  CHECK(contains(shell.output(), "\n2,100,"));
}

TEST_CASE("references packed by gzip, in one piece or several, are read as they are, and said to be cut short or damaged") {
  const TemporaryFolder folder;
  const std::string path = folder / "trace.csv.gz";
  ChildProcess shell({"/bin/sh", "-c", "(printf 'page\\n1\\n2\\n' | gzip; printf '3\\n1\\n' | gzip) > " + path});
  REQUIRE(shell.status() == 0);
  const apps::ReferencesOptions options{
      .file = path, .cache_pages = {3}, .table = {.format = apps::TableFormat::csv}, .quiet = true};
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_references_command(options, interrupt, output) == 0);
  CHECK(contains(output.str(), "\n3,100,75,3,"));
  const std::string packed = file_text(path);
  write_text(path, packed.substr(0, packed.size() - 3));
  CHECK_THROWS_WITH_AS(apps::study_references_command(options, interrupt, output),
                       (path + ": is packed by gzip and cut short; pack it anew").c_str(), core::InputError);
  write_text(path, packed.substr(0, 12) + "damaged" + packed.substr(19));
  CHECK_THROWS_WITH_AS(apps::study_references_command(options, interrupt, output),
                       (path + ": is packed by gzip and damaged; pack it anew").c_str(), core::InputError);
}

TEST_CASE("references that were damaged while they were packed are said to be, and not their lines to be wrong") {
  const TemporaryFolder folder;
  const std::string path = folder / "trace.csv.gz";
  std::string lines = "page\n";
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    lines += std::to_string((i * i * i * 2654435761U >> 9U) % 100'003) + "\n";
  }
  write_text(folder / "trace.csv", lines);
  REQUIRE(ChildProcess({"/bin/sh", "-c", "gzip -1 " + (folder / "trace.csv").string()}).status() == 0);
  const std::string packed = file_text(path);
  int damaged = 0;
  for (std::size_t at = packed.size() / 4; at < packed.size() - 8; at += packed.size() / 16) {
    std::string bytes = packed;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    write_text(path, bytes);
    try {
      apps::read_references(path, {}, [](std::istream& text) { return std::make_unique<apps::GzipText>(text); });
    } catch (const core::InputError& error) {
      CAPTURE(at);
      CHECK_MESSAGE(contains(error.what(), path + ": is packed by gzip and "), error.what());
      ++damaged;
    }
  }
  CHECK(damaged > 8);
}

TEST_CASE("the study of references draws its curves, in a folder and on a page") {
  const TemporaryFolder folder;
  write_text(folder / "trace.csv", "page\n1\n2\n3\n1\n");
  const apps::ReferencesOptions options{
      .file = folder / "trace.csv", .table = {.report = folder / "page.html", .plots = folder / "plots"}, .quiet = true};
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_references_command(options, interrupt, output) == 0);
  const apps::Plot plot = apps::CacheCurves::plot({});
  CHECK(file_text(folder / "plots" / (plot.name + ".json")).size() > 100);
  CHECK(contains(file_text(folder / "page.html"), "Plot: " + apps::html::escaped(plot.title)));
}

TEST_CASE("with prices policies are compared by what their faults cost, too") {
  // Belady's anomaly again, where page 1 costs 10 and the others 1. With 3 frames lru, clock and fifo fault twice on page 1, at
  // first and after it has left, and 8, 7 and 7 times on others; the optimum once, and 6 times on others.
  const std::string lines = "cost,page\n10,1\n1,2\n1,3\n1,4\n10,1\n1,2\n1,5\n10,1\n1,2\n1,3\n1,4\n1,5\n";
  const std::string output = output_of(lines, {3}, {.price = "cost"});
  CHECK(contains(output, ",faults optimum,cost lru,cost clock,cost fifo,"));
  CHECK(contains(output, "\n3,60,83.33333333333333,10,9,9,"));
  CHECK(contains(output, ",7,28,27,27,"));
  CHECK(contains(output, ",16\n"));
  CHECK_FALSE(contains(output_of(lines, {3}), "cost"));
}

TEST_CASE("a price that is repeated with its page counts once, and nodes pay together") {
  const std::string output = output_of("node,page,ns\n0,1,5\n0,1,900\n2,7,4000000000\n", {1}, {.price = "ns"});
  CHECK(contains(output, "\n1,50,66.66666666666667,2,2,2,2,2,2,2,2,4000000005,4000000005,"));
  CHECK_THROWS_WITH_AS(output_of("page,ns\n1,4294967296\n", {1}, {.price = "ns"}),
                       doctest::Contains("the price is '4294967296'; expected a whole number up to 4294967295"),
                       core::InputError);
  CHECK_THROWS_WITH_AS(output_of("page\n1\n", {1}, {.price = "ns"}), doctest::Contains("no column is called ns"),
                       core::InputError);
}

TEST_CASE("a policy of one's own has a column beside dmpc's, on plots, too") {
  const TemporaryFolder folder;
  write_text(folder / "trace.csv", "node,page\n0,1\n0,2\n0,3\n0,4\n0,1\n0,2\n0,5\n0,1\n0,2\n0,3\n0,4\n0,5\n1,7\n");
  const std::string clock =
      "python:" + std::filesystem::canonical(DMPC_SOURCE_DIR "/apps/python/examples/clock.py").string() + ":Clock";
  const apps::ReferencesOptions options{.file = folder / "trace.csv",
                                        .cache_pages = {3, 4},
                                        .policies = {clock},
                                        .table = {.format = apps::TableFormat::csv, .plots = folder / "plots"},
                                        .quiet = true};
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_references_command(options, interrupt, output) == 0);
  CHECK(contains(output.str(), "faults s3-fifo,faults Clock,faults optimum"));
  CHECK(contains(output.str(), ",10,8\n"));  // fifo's anomaly, as the clock has it, and the optimum
  CHECK(contains(file_text(folder / "plots" / "cache_faults.json"), "Clock"));
}

TEST_CASE("a file that cannot be read leaves no table") { CHECK_THROWS_AS(output_of("x\n", {}), core::InputError); }

}  // namespace dmpc::tests::references_command_test
