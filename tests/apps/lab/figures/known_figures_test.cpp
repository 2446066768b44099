#include "apps/lab/figures/known_figures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps::known_figures_test {

namespace {

bool is_known(const std::string& name) {
  const auto& all = known_figures();
  return std::any_of(all.begin(), all.end(), [&](const KnownFigure& figure) { return figure.name == name; });
}

std::string meant(const std::string& typed) { return figure_meant(typed, "--columns"); }

}  // namespace

TEST_CASE("what the schema allows is known by its name, within what it refers to, in lists and by kinds of packets, too") {
  for (const char* const name : {"film_hash", "pages.faults", "nodes.*.pages.faults", "links.rows.*.*", "options.samples",
                                 "packets.by_kind.rays.bytes", "virtual_seconds.waiting.page_reply", "regions.grid.*"}) {
    CHECK_MESSAGE(is_known(name), name);
  }
  CHECK_FALSE(is_known("pages"));
}

TEST_CASE("numbers are told from texts and truths") {
  for (const char* const name : {"pages.faults", "virtual_seconds.total", "events", "packets.by_kind.rays.bytes"}) {
    CHECK_MESSAGE(is_number(name), name);
  }
  for (const char* const name : {"film_hash", "runner", "options.count_pages", "none"}) {
    CHECK_MESSAGE(!is_number(name), name);
  }
}

TEST_CASE("a figure is meant by its name, by its last words, and by what it is the total of") {
  CHECK(meant("pages.faults") == "pages.faults");
  CHECK(meant("faults") == "pages.faults");
  CHECK(meant("virtual_seconds") == "virtual_seconds.total");
  CHECK(meant("rays") == "rays.total");
  CHECK(meant("overflow.share") == "travel.overflow.share");
}

TEST_CASE("what is asked for is meant only where no counter is") {
  CHECK(meant("cache_pages") == "options.cache_pages");
  CHECK(meant("token_rounds") == "host.token_rounds");
}

TEST_CASE("what may be any of several is refused with all of them, and what is none with one that is near") {
  CHECK_THROWS_WITH_AS(meant("packets"), doctest::Contains("--columns=packets: "), core::UsageError);
  CHECK_THROWS_WITH_AS(meant("bytes"), doctest::Contains("database.bytes, packets.bytes"), core::UsageError);
  CHECK_THROWS_WITH_AS(meant("pages.fautls"), doctest::Contains("Did you mean pages.faults?"), core::UsageError);
  CHECK_THROWS_WITH_AS(meant("fautls"), doctest::Contains("Did you mean faults?"), core::UsageError);
  CHECK_THROWS_WITH_AS(meant("jugglery"), doctest::Contains("there is no such figure"), core::UsageError);
}

}  // namespace dmpc::apps::known_figures_test
