#include "apps/lab/study/systems/verdict.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::tests::verdict_test {

namespace {

using apps::AheadInDraws;
using apps::BestVerdict;
using apps::ComparedRow;
using apps::IsolatedVerdict;
using apps::Outcome;

ComparedRow row(double seconds) {
  return {"svm on grid",
          {.scene = "tetra-4", .machine = "hdr", .film_hash = 7, .node_count = 64, .memory_bytes = std::size_t{1} << 20U},
          {{"homes", "spread"}, {"in-flight", "16"}, {"strategy", "svm"}},
          "one search",
          seconds};
}

/// The same with another value of an option.
ComparedRow with(ComparedRow row, const std::string& option, const std::string& value) {
  row.name = "svm otherwise";
  row.options[option] = value;
  return row;
}

}  // namespace

TEST_CASE("rows that differ in one option have an isolated verdict, which names it") {
  const IsolatedVerdict verdict(row(1), with(row(2), "homes", "host"));
  CHECK(verdict.outcome() == Outcome::faster);
  CHECK(verdict.sentence() ==
        "Isolated, homes (spread, host) alone, 64 nodes of hdr, 1.00 MiB each: svm on grid 1.00 s, svm otherwise 2.00 s, 2.00 "
        "times "
        "as long.");
}

TEST_CASE("rows that differ in nothing, in more than one option, or in an option that only one has have no isolated verdict") {
  const ComparedRow homes = with(row(2), "homes", "host");
  CHECK_THROWS_AS(IsolatedVerdict(row(1), row(2)), core::InternalError);
  CHECK_THROWS_AS(IsolatedVerdict(row(1), with(homes, "in-flight", "1")), core::InternalError);
  CHECK_THROWS_AS(IsolatedVerdict(row(1), with(homes, "resident", "50")), core::InternalError);
  CHECK_NOTHROW(IsolatedVerdict(row(1), with(row(2), "resident", "50")));
}

TEST_CASE("no verdict is drawn across scenes, films, machines, memories or numbers of nodes") {
  const auto is_refused = [](const auto& change) {
    ComparedRow other = with(row(2), "homes", "host");
    change(other.circumstances);
    CHECK_THROWS_AS(IsolatedVerdict(row(1), other), core::InternalError);
    CHECK_THROWS_AS(BestVerdict(row(1), other, {}), core::InternalError);
  };
  is_refused([](apps::Circumstances& one) { one.scene = "tetra-5"; });
  is_refused([](apps::Circumstances& one) { one.film_hash = 8; });
  is_refused([](apps::Circumstances& one) { one.machine = "ipsc2"; });
  is_refused([](apps::Circumstances& one) { *one.memory_bytes += 1; });
  is_refused([](apps::Circumstances& one) { one.node_count = 32; });
}

TEST_CASE("the best are compared only if one search has found them, and all their differences are named") {
  ComparedRow rays = row(3);
  rays.name = "subsampled on grid";
  rays.options = {{"balance", "subsampled"}, {"strategy", "dataflow"}};
  const BestVerdict verdict(row(2), rays, AheadInDraws{97, 100});
  CHECK(verdict.sentence() ==
        "Best against best, 64 nodes of hdr, 1.00 MiB each: svm on grid 2.00 s, subsampled on grid 3.00 s, 1.50 times as long; "
        "ahead in 97 of 100 draws of the prices. They differ in strategy (svm, dataflow); svm on grid alone has homes spread, "
        "in-flight 16; subsampled on grid alone has balance subsampled.");
  rays.search = "another search";
  CHECK_THROWS_AS(BestVerdict(row(2), rays, {}), core::InternalError);
  ComparedRow given = row(2);
  given.search = rays.search = "";
  CHECK_THROWS_AS(BestVerdict(given, rays, {}), core::InternalError);
}

TEST_CASE("times within 1 % are a tie, and a row ahead in fewer than 80 of 100 draws is undecided") {
  CHECK(apps::outcome_of(1, 1.01) == Outcome::tie);
  CHECK(apps::outcome_of(1, 1.02) == Outcome::faster);
  CHECK(apps::outcome_of(1.02, 1) == Outcome::slower);
  CHECK(IsolatedVerdict(row(1), with(row(1.005), "homes", "host")).sentence().ends_with("svm otherwise 1.00 s, a tie."));
  CHECK(AheadInDraws{79, 100}.is_undecided());
  CHECK_FALSE(AheadInDraws{80, 100}.is_undecided());
  const BestVerdict verdict(row(1), with(row(2), "homes", "host"), AheadInDraws{79, 100});
  CHECK(verdict.sentence().starts_with("Best against best, undecided, 64 nodes"));
}

}  // namespace dmpc::tests::verdict_test
