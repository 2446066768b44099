#include "apps/lab/compare/pages.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "apps/frontend/line/exit_status.h"
#include "apps/lab/compare/command.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::compare_pages_test {

namespace {

using tests::contains;
using tests::file_text;
using tests::TemporaryFolder;
using tests::write_text;

/// A page of a small render on a modelled machine.
void render(const std::string& page, const std::string& cache) {
  const TemporaryFolder folder;
  tests::ChildProcess program({DMPC_PROGRAM, "render", "balls-2", "--nodes=2", "--resolution=16x12", "--runner=virtual",
                               "--quiet", "--page-size=512", "--cache-pages=" + cache, "--report=" + page, "-o",
                               (folder / "p.png").string()});
  REQUIRE_MESSAGE(program.status() == 0, program.errors());
}

struct Reported {
  int status;
  std::string output;
};

Reported compared(const CompareOptions& options) {
  std::ostringstream output;
  Interrupt interrupt;
  const int status = compare_command(options, interrupt, output);
  return {status, output.str()};
}

/// What is said of two files that are refused.
std::string refusal(const CompareOptions& options) {
  return tests::complaint_of([&] { compared(options); });
}

}  // namespace

TEST_CASE("of two pages the counters are compared as those of --stats are, and --report puts both runs on one clock") {
  const TemporaryFolder folder;
  render(folder / "a.html", "1");
  render(folder / "b.html", "2");
  CompareOptions options{folder / "a.html", folder / "b.html"};
  options.report = folder / "ab.html";
  const Reported reported = compared(options);
  CHECK(reported.status == differs_status);
  CHECK(contains(reported.output, "pages.faults"));
  const std::string page = file_text(folder / "ab.html");
  CHECK(contains(page, "The pictures are the same in all 192 pixels, as eight bits a colour."));
  CHECK(contains(page, "Counters that differ"));
  CHECK(contains(page, "{\"runs\":[{"));
  options.figures.only = {"film_hash", "rays"};
  CHECK(compared(options).status == 0);
  CHECK(contains(refusal({folder / "ab.html", folder / "b.html"}), "two runs side by side already"));
}

TEST_CASE("a page that was cut off, or changed, is refused with its name, and no page is written") {
  const TemporaryFolder folder;
  render(folder / "a.html", "4");
  const std::string whole = file_text(folder / "a.html");
  CompareOptions options{folder / "a.html", folder / "b.html"};
  options.report = folder / "ab.html";
  write_text(folder / "b.html", whole.substr(0, whole.find("id=\"data\">") + 100));
  CHECK(contains(refusal(options), "b.html: this page ends within its data"));
  std::string changed = whole;
  changed.replace(changed.find("src=\"data:image/png;base64,") + 27, 8, "AAAAAAAA");
  write_text(folder / "b.html", changed);
  CHECK(contains(refusal(options), "b.html: its picture is no PNG"));
  changed = whole;
  changed.replace(changed.find("\"stats\":"), 8, "\"other\":");
  write_text(folder / "b.html", changed);
  CHECK(contains(refusal({folder / "a.html", folder / "b.html"}), "b.html: this page has no counters"));
  CHECK_FALSE(std::filesystem::exists(folder / "ab.html"));
  CHECK(compared(options).status == 0);
  CHECK(contains(file_text(folder / "ab.html"), "b.html: this page has no counters"));
}

TEST_CASE("a page that would replace one of the two is refused") {
  const TemporaryFolder folder;
  write_text(folder / "a.html", "x");
  CompareOptions options{folder / "a.html", folder / "b.html"};
  options.report = folder / "a.html";
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command(options, interrupt, output), core::UsageError);
}

}  // namespace dmpc::apps::compare_pages_test
