#include "apps/lab/study/cache.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/table/geometric_sizes.h"
#include "core/base/expect.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_cache_test {

namespace {

using apps::CacheStudy;
using apps::geometric_sizes;
using apps::Table;
using CacheSizes = std::vector<std::uint32_t>;

nodes::Machine ipsc2() { return apps::find_machine_preset("ipsc2")->machine; }

/// The study's faults of a policy, by a run on threads.
std::uint64_t faults_on_threads(StudySubject& subject, std::uint32_t cache_pages, svm::Replacement replacement) {
  const svm::RunOptions options{
      .computer = {.node_count = 4},
      .pages = {.cache_pages = cache_pages, .replacement = replacement, .in_flight = 1, .work_item_side = 0}};
  return subject.runs.run(options).pages().faults;
}

}  // namespace

TEST_CASE("sizes go from one page to all in steps of about the same ratio") {
  CHECK(geometric_sizes(2048, 12) == CacheSizes{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048});
  CHECK(geometric_sizes(3, 12) == CacheSizes{1, 2, 3});
  CHECK(geometric_sizes(1000, 2) == CacheSizes{1, 1000});
  CHECK(geometric_sizes(1, 12) == CacheSizes{1});
  CHECK(geometric_sizes(0, 12).empty());
  for (const std::uint32_t most : {5U, 77U, 12'345U, 4'000'000'000U}) {
    const CacheSizes sizes = geometric_sizes(most, 12);
    CHECK(sizes.size() <= 12);
    CHECK(sizes.front() == 1);
    CHECK(sizes.back() == most);
  }
}

TEST_CASE("the faults of every policy are those of its own run on threads, to the last one") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(CacheStudy{.node_count = 4, .cache_pages = {1, 5, 20}});
  REQUIRE(table.rows().size() == 3);
  for (std::size_t row = 0; row < 3; ++row) {
    CAPTURE(row);
    const auto cache_pages = static_cast<std::uint32_t>(whole(table, row, "cache pages"));
    for (std::size_t policy = 0; policy < svm::policy_kinds().size(); ++policy) {
      const auto replacement = static_cast<svm::Replacement>(policy);
      const std::string column = "faults " + std::string(svm::name_of(replacement));
      CHECK_MESSAGE(whole(table, row, column.c_str()) == faults_on_threads(subject, cache_pages, replacement), column);
    }
    CHECK(whole(table, row, "faults optimum") <= whole(table, row, "faults lru"));
  }
}

TEST_CASE("by default the sizes go from one page to all that are not at home, where all policies fault alike") {
  StudySubject subject("rings-2-t1", 16);
  const Table table = subject.measure(CacheStudy{.node_count = 2});
  const std::size_t last = table.rows().size() - 1;
  const std::uint64_t page_count = subject.subject.database.page_count();
  CHECK(whole(table, 0, "cache pages") == 1);
  CHECK(whole(table, last, "cache pages") == page_count - page_count / 2);
  CHECK(table.rows().size() == geometric_sizes(static_cast<std::uint32_t>(page_count - page_count / 2), 12).size());
  CHECK(real(table, last, "share of database") ==
        doctest::Approx(100 * static_cast<double>(page_count - page_count / 2) / static_cast<double>(page_count)));
  for (const std::size_t row : {std::size_t{0}, last}) {
    for (const char* const policy :
         {"faults clock", "faults fifo", "faults random", "faults 2q", "faults arc", "faults s3-fifo", "faults optimum"}) {
      CHECK(whole(table, row, policy) == whole(table, row, "faults lru"));
    }
  }
  CHECK(whole(table, last, "faults lru") < whole(table, 0, "faults lru"));
}

TEST_CASE("misses are faults over references, those at home included") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(CacheStudy{.node_count = 4, .cache_pages = {5}});
  const auto pages =
      subject.runs
          .run(svm::RunOptions{.computer = {.node_count = 4}, .pages = {.cache_pages = 5, .in_flight = 1, .work_item_side = 0}})
          .pages();
  CHECK(real(table, 0, "misses lru") ==
        doctest::Approx(100 * static_cast<double>(pages.misses) / static_cast<double>(pages.references)));
}

TEST_CASE("on a machine the times are those of its own runs") {
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(CacheStudy{.node_count = 4, .cache_pages = {4, 1000}, .machine = ipsc2()});
  const svm::RunOptions options{.computer = {.node_count = 4, .machine = ipsc2()}, .pages = {.cache_pages = 4, .in_flight = 1}};
  const svm::Report report = subject.runs.run(options);
  const svm::Report one =
      subject.runs.run(svm::RunOptions{.computer = {.node_count = 1, .machine = ipsc2()}, .pages = {.in_flight = 1}});
  const double seconds = static_cast<double>(report.virtual_time->total_ns) * 1e-9;
  const auto bytes = static_cast<double>(report.sent()[svm::number_of(svm::Kind::page_reply)].bytes);
  CHECK(real(table, 0, "virtual time") == doctest::Approx(seconds));
  CHECK(real(table, 0, "efficiency") ==
        doctest::Approx(100 * static_cast<double>(one.virtual_time->total_ns) * 1e-9 / 4 / seconds));
  CHECK(whole(table, 0, "page traffic a node") == static_cast<std::uint64_t>(bytes / 4 / seconds));
  CHECK(real(table, 1, "virtual time") < real(table, 0, "virtual time"));
  CHECK(real(table, 1, "efficiency") < 100);
}

TEST_CASE("on a machine that takes no time there is no efficiency") {
  StudySubject subject("balls-1");
  const Table table = subject.measure(CacheStudy{.node_count = 2, .cache_pages = {2}, .machine = nodes::Machine()});
  CHECK(real(table, 0, "virtual time") == 0);
  CHECK(is_missing(table, 0, "efficiency"));
  CHECK(is_missing(table, 0, "page traffic a node"));
}

TEST_CASE("without a machine nothing is timed") {
  CHECK(CacheStudy().columns().size() + 3 == CacheStudy{.machine = ipsc2()}.columns().size());
}

TEST_CASE("what the nodes need is told in words that suit the numbers") {
  const auto last_note = [](const char* scene, std::uint32_t node_count) {
    StudySubject subject(scene);
    return subject.measure(CacheStudy{.node_count = node_count, .cache_pages = {2}}).notes().back();
  };
  const std::string many = last_note("rings-2-t1", 4);
  CHECK(many.find("The node that references most has to do with ") == 0);
  CHECK(many.find(" different pages of others; from ") != std::string::npos);
  const std::string few = last_note("balls-1", 2);
  CHECK(few.find(" 1 different page of others; from 1 frame on lru faults ") != std::string::npos);
}

TEST_CASE("a study that an error ends has the rows that were finished before") {
  StudySubject subject("balls-1");
  const CacheStudy study{.node_count = 2, .cache_pages = {1, 0, 1}, .machine = ipsc2()};
  Table table("", study.columns());
  CHECK_THROWS_WITH_AS(study.measure(subject.runs, table), doctest::Contains("--cache-pages=0"), core::UsageError);
  CHECK(table.rows().size() == 1);
}

TEST_CASE("runs are counted, and a film unlike the first is a broken invariant") {
  StudySubject subject("balls-1");
  CHECK_FALSE(subject.runs.film_hash);
  subject.measure(CacheStudy{.node_count = 2, .cache_pages = {1, 5}, .machine = ipsc2()});
  CHECK(subject.runs.count == 4);
  CHECK(subject.runs.film_hash);
  CHECK_THROWS_AS(subject.runs.take(core::Film(32, 32)), core::InternalError);
}

TEST_CASE("two studies of the same scene find the same") {
  const CacheStudy study{.node_count = 3, .machine = ipsc2()};
  const Table one = StudySubject("balls-2").measure(study), other = StudySubject("balls-2").measure(study);
  CHECK(one.rows() == other.rows());
}

TEST_CASE("what the article found stands below its own scenes only") {
  const CacheStudy study;
  CHECK(study.notes("rings-4-t1").size() == study.notes("rings-3-t1").size() + 1);
  CHECK(study.notes("tetra-9").back().find("Tetra9") != std::string::npos);
}

TEST_CASE("caches are concluded with the size from which lru is good, and without rows not at all") {
  const CacheStudy study;
  Table table("Study", study.columns());
  CHECK(study.conclusion(table).empty());
  for (const auto& [pages, lru, optimum] : {std::array{1U, 1000U, 1000U}, {4U, 500U, 300U}, {16U, 105U, 100U}}) {
    std::vector<apps::Cell> row(table.columns().size());
    const auto set = [&](const char* name, apps::Cell cell) {
      const auto found =
          std::find_if(table.columns().begin(), table.columns().end(), [&](const auto& column) { return column.name == name; });
      row.at(static_cast<std::size_t>(found - table.columns().begin())) = std::move(cell);
    };
    set("cache pages", std::uint64_t{pages});
    set("share of database", double{1.0 * pages});
    set("faults lru", std::uint64_t{lru});
    set("faults optimum", std::uint64_t{optimum});
    table.add_row(row);
  }
  CHECK(study.conclusion(table) ==
        "From caches of 16 pages on (16.0 % of the database) lru is within 10 % of the best that any policy could do; it faults "
        "10.5 % as often as with 1 page.");
}

}  // namespace dmpc::tests::study_cache_test
