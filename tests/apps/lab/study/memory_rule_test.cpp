#include "apps/lab/study/memory_rule.h"

#include <doctest/doctest.h>

#include "apps/lab/study/studies.h"
#include "core/base/expect.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::memory_rule_test {

namespace {

using apps::MemoryRule;

/// The options of a system under a rule, on four nodes.
apps::StrategyOptions under(const MemoryRule& rule, const char* system, const core::Database& database) {
  apps::StrategyOptions options = strategy_of(apps::find_system(system));
  options.computer.node_count = 4;
  rule.apply(options, database);
  return options;
}

}  // namespace

TEST_CASE("rules of memory are read as they are written") {
  const std::vector<MemoryRule> rules = apps::parse_memory_rules("auto,25%,0.5%,1MiB");
  REQUIRE(rules.size() == 4);
  CHECK_FALSE(rules[0].share);
  CHECK_FALSE(rules[0].bytes);
  CHECK(*rules[1].share == 0.25);
  CHECK(*rules[3].bytes == 1 << 20U);
  CHECK(rules[0].text() == "auto");
  CHECK(rules[1].text() == "25%");
  CHECK(rules[2].text() == "0.5%");
  CHECK(rules[3].text() == "1MiB");
}

TEST_CASE("what is no rule of memory is bad usage") {
  for (const char* const text : {"", "auto,", "0%", "101%", "-1%", "x%", "%", "25 %", "much"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(apps::parse_memory_rules(text), doctest::Contains("--node-memory"), core::UsageError);
  }
}

TEST_CASE("a share changes what caches, a size changes all, and what is needed changes nothing") {
  for (const apps::System system : apps::SystemsStudy::all_systems()) {
    CAPTURE(name_of(system));
    CHECK_FALSE(MemoryRule{}.changes(system));
    CHECK(MemoryRule{.bytes = 1000}.changes(system));
    CHECK(MemoryRule{.share = 0.1}.changes(system) == (strategy_of(system).strategy == apps::Strategy::svm));
  }
}

TEST_CASE("a cache holds all pages of others, its share, or what a size leaves it, and never less than a page") {
  const StudySubject subject("tetra-4");
  const core::Database& database = subject.subject.database;
  CHECK(under({}, "svm", database).pages.cache_pages == database.page_count() - database.page_count() / 4);
  CHECK(under({.share = 0.5}, "svm", database).pages.cache_pages == database.page_count() / 2);
  CHECK(under({.share = 1e-9}, "svm", database).pages.cache_pages == 1);
  CHECK_FALSE(under({.bytes = 1 << 20U}, "svm", database).pages.cache_pages);
  CHECK(under({.bytes = 1 << 20U}, "svm", database).computer.node_memory_bytes == 1 << 20U);
  CHECK_FALSE(under({.share = 0.5}, "forest", database).pages.cache_pages);
}

TEST_CASE("a share allows a node its part and the share, in whole pages") {
  const StudySubject subject("tetra-4");
  const core::Database& database = subject.subject.database;
  const std::size_t page = database.page_size(), count = database.page_count();
  const MemoryRule half{.share = 0.5};
  const std::size_t allowed = ((count + 3) / 4 + count / 2 + 1) * page;
  CHECK(half.allows(0, database, 4));
  CHECK(half.allows(allowed, database, 4));
  CHECK_FALSE(half.allows(allowed + 1, database, 4));
  CHECK(half.allows(count * page, database, 1));
  CHECK(MemoryRule{}.allows(100 * count * page, database, 4));
}

}  // namespace dmpc::tests::memory_rule_test
