#include "apps/lab/study/memory_rule.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::tests::memory_rule_test {

TEST_CASE("rules of memory are read as they are written") {
  const std::vector<apps::MemoryRule> rules = apps::parse_memory_rules("rays,25%,1000%,1MiB");
  REQUIRE(rules.size() == 4);
  CHECK(rules[0].text() == "rays");
  CHECK(rules[1].text() == "25%");
  CHECK(rules[2].text() == "1000%");
  CHECK(rules[3].text() == "1MiB");
  CHECK(apps::parse_memory_rules("0.5%")[0].text() == "0.5%");
}

TEST_CASE("a rule gives what rays need, a share of the database, or its size") {
  const std::vector<apps::MemoryRule> rules = apps::parse_memory_rules("rays,25%,200%,1MiB");
  CHECK(rules[0].bytes_of(4000, 300) == 300);
  CHECK(rules[1].bytes_of(4000, 300) == 1000);
  CHECK(rules[2].bytes_of(4000, 300) == 8000);
  CHECK(rules[3].bytes_of(4000, 300) == 1 << 20U);
}

TEST_CASE("what is no rule of memory is bad usage") {
  for (const char* const text : {"", "rays,", "auto", "0%", "1001%", "-1%", "x%", "%", "25 %", "much"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(apps::parse_memory_rules(text), doctest::Contains("--node-memory"), core::UsageError);
  }
}

}  // namespace dmpc::tests::memory_rule_test
