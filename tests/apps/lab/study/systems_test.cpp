#include "apps/lab/study/studies.h"

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
  study.build = [scene](const core::BuildOptions& asked) {
    return apps::build_subject_quietly(built_in(scene), {.scene = scene, .resolution = apps::Resolution{32, 32}},
                                       {.build = asked});
  };
  return study;
}

/// A table on structures of today alone.
SystemsStudy today(SystemsStudy study) {
  study.structures = {apps::SystemStructures::of_today};
  return study;
}

/// Whether a system had another structure when it was described than it has here.
bool changes(System system) { return original_database_of(system).build.structure != database_of(system).build.structure; }

/// A table with these systems' times on four nodes.
Table times(const std::vector<std::tuple<const char*, const char*, double>>& rows) {
  Table table("", SystemsStudy().columns());
  for (const auto& [system, memory, seconds] : rows) {
    std::vector<Cell> row = {"of today", system, memory, std::uint64_t{4}, "grid", "yes", 1.0, seconds};
    row.resize(table.columns().size());
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace

TEST_CASE("every system has a row for each rule of memory, and one run for all rules and structures that do not change it") {
  StudySubject subject("tetra-4");
  SystemsStudy study = study_of("tetra-4", {}, 4, {{}, {.share = 0.25}, {.share = 0.01}});
  study.chosen = SystemsStudy::all_systems();
  const std::size_t count = study.chosen.size();
  const auto with_cache = static_cast<std::uint32_t>(std::count_if(study.chosen.begin(), study.chosen.end(), [](System system) {
    return strategy_of(system).strategy == apps::Strategy::svm;
  }));
  const auto changed = std::count_if(study.chosen.begin(), study.chosen.end(), [](System system) { return changes(system); });
  const auto changed_with_cache = std::count_if(study.chosen.begin(), study.chosen.end(), [](System system) {
    return changes(system) && strategy_of(system).strategy == apps::Strategy::svm;
  });
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 2 * 3 * count);
  constexpr std::size_t alone = 3;  // one node with voxels, a tree, a grid
  CHECK(subject.runs.count() == alone + count + 2 * with_cache + static_cast<std::size_t>(changed + 2 * changed_with_cache));
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    CAPTURE(row);
    CHECK(text(table, row, "system") == name_of(study.chosen[row % count]));
    const auto first_part = table.rows()[row].begin() + 11;
    const double parts = std::accumulate(first_part, first_part + apps::time_part_count, 0.0, [](double sum, const Cell& part) {
      const auto* const percent = std::get_if<double>(&part);
      return sum + (percent == nullptr ? 0 : *percent);
    });
    CHECK(parts == doctest::Approx(text(table, row, "fits") == "yes" ? 100 : 0));
    if (row % (3 * count) < count) {
      CHECK(text(table, row, "fits") == "yes");
    }
  }
}

TEST_CASE("one node with the whole scene in the same structure is what efficiency and work are against") {
  StudySubject subject("tetra-3");
  const Table table = subject.measure(study_of("tetra-3", {"replicated", "replicated-extents"}, 1, {{}}));
  REQUIRE(table.rows().size() == 4);
  for (std::size_t row = 0; row < 4; ++row) {
    CAPTURE(row);
    CHECK(real(table, row, "efficiency") == 100);
    CHECK(real(table, row, "work") == 1);
    CHECK(real(table, row, "average load") == 100);
  }
  CHECK(real(table, 0, "virtual time") > real(table, 2, "virtual time"));  // lists of voxels against trees of a grid
  CHECK(real(table, 1, "virtual time") == real(table, 3, "virtual time"));
}

TEST_CASE("each system is rendered on the structure that it had, then on that of today") {
  StudySubject subject("tetra-4");
  const Table table = subject.measure(study_of("tetra-4", {"svm", "svm-extents", "green-paddon", "subsampled"}, 4, {{}}));
  const std::vector<const char*> structures = {"voxels", "extents", "extents", "voxels", "grid", "extents", "grid", "grid"};
  REQUIRE(table.rows().size() == structures.size());
  for (std::size_t row = 0; row < structures.size(); ++row) {
    CAPTURE(row);
    CHECK(text(table, row, "structures") == (row < 4 ? "of the papers" : "of today"));
    CHECK(text(table, row, "structure") == structures[row]);
  }
  CHECK(subject.runs.count() == 3 + 4 + 3);
}

TEST_CASE("structures that are not asked for have neither runs nor rows") {
  StudySubject subject("tetra-3");
  SystemsStudy study = study_of("tetra-3", {"svm", "forest"}, 2, {{}});
  study.structures = {apps::SystemStructures::of_papers};
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 2);
  CHECK(text(table, 0, "structure") == "voxels");
  CHECK(subject.runs.count() == 4);  // one node with voxels, one with a tree, and both systems
}

TEST_CASE("whole copies fit no share of the database, and say how much they hold") {
  StudySubject subject("tetra-4");
  const Table table = subject.measure(today(study_of("tetra-4", {"replicated", "svm"}, 4, {{.share = 0.25}})));
  REQUIRE(table.rows().size() == 2);
  CHECK(text(table, 0, "fits") == "no");
  CHECK(real(table, 0, "database held") >= 100);
  CHECK(is_missing(table, 0, "virtual time"));
  CHECK(text(table, 1, "fits") == "yes");
  CHECK(real(table, 1, "database held") <= 52);
}

TEST_CASE("a size bounds the whole memory, and what does not fit is said") {
  StudySubject subject("tetra-6");
  const Table table = subject.measure(today(study_of("tetra-6", {"replicated", "svm"}, 8, {{.bytes = 500 << 10U}})));
  CHECK(text(table, 0, "fits") == "no");
  CHECK(is_missing(table, 0, "database held"));
  CHECK(
      has_note(table, "replicated, grid, on 8 nodes, memory 500KiB: the scene does not fit. --node-memory=500KiB is too small"));
  CHECK(text(table, 1, "fits") == "yes");
  CHECK(whole(table, 1, "node memory") <= 500 << 10U);
}

TEST_CASE("a system's figures are those of a run by itself") {
  StudySubject subject("tetra-4");
  const Table table = subject.measure(today(study_of("tetra-4", {"svm"}, 5, {{.share = 0.1}})));
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
  CHECK(held[0] ==
        "Expected: whole copies are the fastest, where memory allows them. Held on 4 nodes, memory auto, structures of today: "
        "replicated 1 s, svm 2 s.");
  CHECK(held[1].ends_with("Held on 4 nodes, memory auto, structures of today: svm 2 s, subsampled 3 s."));
  CHECK(held[2].ends_with("Held on 4 nodes, memory auto, structures of today: subsampled 3 s, equal-size 4 s."));
  const std::vector<std::string> not_held = verdicts_of(times({{"svm", "5%", 2}, {"forest", "5%", 3}}));
  REQUIRE(not_held.size() == 1);
  CHECK(not_held[0].ends_with("Not held on 4 nodes, memory 5%, structures of today: forest 3 s, svm 2 s."));
  const std::vector<std::string> moving = verdicts_of(times({{"moving", "auto", 2}, {"subsampled", "auto", 3}}));
  REQUIRE(moving.size() == 1);
  CHECK(moving[0] ==
        "Expected: where hits crowd, regions that move while rays travel are faster than those that stay. Held on 4 nodes, "
        "memory auto, structures of today: moving 2 s, subsampled 3 s.");
  const std::vector<std::string> homes =
      verdicts_of(times({{"svm", "auto", 9}, {"svm-resident", "auto", 1}, {"green-paddon", "auto", 2}}));
  REQUIRE(homes.size() == 1);
  CHECK(homes[0] ==
        "Expected: whatever the memory, with all else equal the host is a slower home than all nodes together. Held on 4 nodes, "
        "memory auto, structures of today: svm-resident 1 s, green-paddon 2 s.");
  const std::vector<std::string> tie = verdicts_of(times({{"replicated", "auto", 1.0}, {"replicated-extents", "auto", 1.004}}));
  REQUIRE(tie.size() == 1);
  CHECK(tie[0].ends_with("A tie on 4 nodes, memory auto, structures of today: replicated 1 s, replicated-extents 1.004 s."));
  CHECK(verdicts_of(times({})).empty());
}

TEST_CASE("a system that does not exist is bad usage that lists those there are") {
  CHECK_THROWS_WITH_AS(apps::find_system("nonsense"),
                       doctest::Contains("there is no system \"nonsense\": one of replicated, replicated-extents, svm,"),
                       core::UsageError);
}

}  // namespace dmpc::tests::systems_test
