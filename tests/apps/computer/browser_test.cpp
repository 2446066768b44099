// The pages of programs in a real browser.
#include <doctest/doctest.h>

#include <string>

#include "tests/apps/computer/adder.h"
#include "tests/apps/computer/requester.h"
#include "tests/support/browser.h"

namespace dmpc::tests::computer_browser_test {

namespace {

void check_in_browser(const std::string& page) {
  const TemporaryFolder folder;
  for (const int width : {1280, 400}) {
    for (const bool is_dark : {false, true}) {
      CAPTURE(width);
      CAPTURE(is_dark);
      check_shown_whole(reported_by_browser(page, width, is_dark, folder / "shot.png"), page, width, is_dark);
    }
  }
}

}  // namespace

TEST_CASE("a browser shows the pages of programs whole, on a screen and on a telephone, light and dark" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  const std::string file = folder / "page.html", report = "--report=" + file;
  REQUIRE(run_with(requester(10), {"--nodes=8", "--runner=virtual", "--machine=hdr", report}).status == 0);
  check_in_browser(file_text(file));
  REQUIRE(run_adding(adding(2), {"--nodes=8", "--runner=virtual", "--cache-pages=2", report}).status == 0);
  check_in_browser(file_text(file));
}

}  // namespace dmpc::tests::computer_browser_test
