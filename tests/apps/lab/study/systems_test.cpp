#include "apps/lab/study/systems.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::systems_test {

namespace {

using apps::Cell;
using apps::MemoryRule;
using apps::System;
using apps::SystemsStudy;
using apps::Table;

/// A study of these systems, by name.
SystemsStudy study_of(const std::string& scene, const std::vector<const char*>& systems, std::uint32_t node_count,
                      std::vector<MemoryRule> memories) {
  SystemsStudy study{.chosen = {}, .node_counts = {node_count}, .memories = std::move(memories)};
  for (const char* const name : systems) {
    study.chosen.push_back(apps::find_system(name));
  }
  study.build = [scene](core::Structure structure, std::size_t page_size_bytes) {
    return apps::build_subject_quietly(built_in(scene), {.scene = scene, .resolution = apps::Resolution{32, 32}},
                                       {.build = {.page_size_bytes = page_size_bytes, .structure = structure}});
  };
  return study;
}

/// A table with these systems' times on four nodes.
Table times(const std::vector<std::tuple<const char*, const char*, double>>& rows) {
  Table table("", SystemsStudy().columns());
  for (const auto& [system, memory, seconds] : rows) {
    std::vector<Cell> row = {system, memory, std::uint64_t{4}, "yes", 1.0, seconds};
    row.resize(table.columns().size());
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace

TEST_CASE("every system has a row for each rule of memory, and one run for all rules that do not change it") {
  StudySubject subject("tetra-4");
  SystemsStudy study = study_of("tetra-4", {}, 4, {{}, {.share = 0.25}, {.share = 0.01}});
  study.chosen = SystemsStudy::all_systems();
  const std::size_t count = study.chosen.size();
  const auto with_cache = static_cast<std::uint32_t>(std::count_if(study.chosen.begin(), study.chosen.end(), [](System system) {
    return strategy_of(system).strategy == apps::Strategy::svm;
  }));
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 3 * count);
  CHECK(study.planned().size() == 1 + count + 2 * with_cache);
  CHECK(subject.runs.count() == study.planned().size());
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    CAPTURE(row);
    CHECK(text(table, row, "system") == name_of(study.chosen[row % count]));
    const double parts = std::accumulate(table.rows()[row].begin() + 9, table.rows()[row].begin() + 9 + apps::time_part_count,
                                         0.0, [](double sum, const Cell& part) {
                                           const auto* const percent = std::get_if<double>(&part);
                                           return sum + (percent == nullptr ? 0 : *percent);
                                         });
    CHECK(parts == doctest::Approx(text(table, row, "fits") == "yes" ? 100 : 0));
    if (row < count) {
      CHECK(text(table, row, "fits") == "yes");
    }
  }
}

TEST_CASE("one node with the whole scene is what efficiency and work are against") {
  StudySubject subject("tetra-3");
  const Table table = subject.measure(study_of("tetra-3", {"replicated"}, 1, {{}}));
  REQUIRE(table.rows().size() == 1);
  CHECK(real(table, 0, "efficiency") == 100);
  CHECK(real(table, 0, "work") == 1);
  CHECK(real(table, 0, "average load") == 100);
}

TEST_CASE("whole copies fit no share of the database, and say how much they hold") {
  StudySubject subject("tetra-4");
  const Table table = subject.measure(study_of("tetra-4", {"replicated", "svm"}, 4, {{.share = 0.25}}));
  REQUIRE(table.rows().size() == 2);
  CHECK(text(table, 0, "fits") == "no");
  CHECK(real(table, 0, "database held") >= 100);
  CHECK(is_missing(table, 0, "virtual time"));
  CHECK(text(table, 1, "fits") == "yes");
  CHECK(real(table, 1, "database held") <= 52);
}

TEST_CASE("a size bounds the whole memory, and what does not fit is said") {
  StudySubject subject("tetra-6");
  const Table table = subject.measure(study_of("tetra-6", {"replicated", "svm"}, 8, {{.bytes = 500 << 10U}}));
  CHECK(text(table, 0, "fits") == "no");
  CHECK(is_missing(table, 0, "database held"));
  CHECK(has_note(table, "replicated on 8 nodes, memory 500KiB: the scene does not fit. --node-memory=500KiB is too small"));
  CHECK(text(table, 1, "fits") == "yes");
  CHECK(whole(table, 1, "node memory") <= 500 << 10U);
}

TEST_CASE("a system's figures are those of a run by itself") {
  StudySubject subject("tetra-4");
  const Table table = subject.measure(study_of("tetra-4", {"svm"}, 5, {{.share = 0.1}}));
  const svm::Report report = subject.runs.run(
      "again", svm::RunOptions{.computer = {.node_count = 5, .machine = SystemsStudy().machine.computer.machine},
                               .pages = {.cache_pages = static_cast<std::uint32_t>(subject.subject.database.page_count() / 10),
                                         .in_flight = 1}});
  CHECK(real(table, 0, "virtual time") == doctest::Approx(1e-9 * static_cast<double>(report.virtual_time->total_ns)));
  CHECK(whole(table, 0, "node memory") == report.plan.node_memory_max_bytes());
  CHECK(real(table, 0, "messages a ray") == doctest::Approx(static_cast<double>(nodes::total(report.sent()).packets) /
                                                            static_cast<double>(report.operations().ray_count())));
}

TEST_CASE("expectations are held against the figures") {
  const std::vector<std::string> held =
      verdicts_of(times({{"replicated", "auto", 1}, {"svm", "auto", 2}, {"equal-size", "auto", 4}, {"subsampled", "auto", 3}}));
  REQUIRE(held.size() == 3);
  CHECK(
      held[0] ==
      "Expected: whole copies are the fastest, where memory allows them. Held on 4 nodes, memory auto: replicated 1 s, svm 2 s.");
  CHECK(held[1].ends_with("Held on 4 nodes, memory auto: svm 2 s, subsampled 3 s."));
  CHECK(held[2].ends_with("Held on 4 nodes, memory auto: subsampled 3 s, equal-size 4 s."));
  const std::vector<std::string> not_held = verdicts_of(times({{"svm", "5%", 2}, {"forest", "5%", 3}}));
  REQUIRE(not_held.size() == 1);
  CHECK(not_held[0].ends_with("Not held on 4 nodes, memory 5%: forest 3 s, svm 2 s."));
  const std::vector<std::string> moving = verdicts_of(times({{"moving", "auto", 2}, {"subsampled", "auto", 3}}));
  REQUIRE(moving.size() == 1);
  CHECK(moving[0] ==
        "Expected: where hits crowd, regions that move while rays travel are faster than those that stay. Held on 4 nodes, "
        "memory auto: moving 2 s, subsampled 3 s.");
  const std::vector<std::string> homes =
      verdicts_of(times({{"svm", "auto", 9}, {"svm-resident", "auto", 1}, {"green-paddon", "auto", 2}}));
  REQUIRE(homes.size() == 1);
  CHECK(homes[0] ==
        "Expected: whatever the memory, with all else equal the host is a slower home than all nodes together. Held on 4 nodes, "
        "memory auto: svm-resident 1 s, green-paddon 2 s.");
  CHECK(verdicts_of(times({})).empty());
}

TEST_CASE("a system that does not exist is bad usage that lists those there are") {
  CHECK_THROWS_WITH_AS(apps::find_system("nonsense"),
                       doctest::Contains("there is no system \"nonsense\": one of replicated, replicated-extents, svm,"),
                       core::UsageError);
}

}  // namespace dmpc::tests::systems_test
