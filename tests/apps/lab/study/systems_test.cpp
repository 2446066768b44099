#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/lab/study/studies.h"
#include "apps/lab/study/systems/setup.h"
#include "core/base/expect.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::systems_test {

namespace {

using apps::MemoryRule;
using apps::SystemsStudy;
using apps::SystemTable;
using apps::Table;

/// A study of these systems, by name, in one table, without draws.
SystemsStudy study_of(const std::string& scene, SystemTable table, const std::vector<const char*>& systems) {
  SystemsStudy study{.chosen = {}, .tables = {table}, .node_counts = {4}, .memories = {{}}, .draws = 0};
  for (const char* const name : systems) {
    study.chosen.push_back(apps::find_system(name));
  }
  study.scene = scene;
  study.build = [scene](const core::BuildOptions& asked) {
    return apps::build_subject_quietly(built_in(scene), {.scene = scene, .resolution = apps::Resolution{32, 32}},
                                       {.build = asked});
  };
  return study;
}

std::size_t note_count(const Table& table, const std::string& words) {
  return static_cast<std::size_t>(
      std::count_if(table.notes().begin(), table.notes().end(), [&](const std::string& note) { return contains(note, words); }));
}

std::vector<std::string> names_of(const std::vector<apps::SearchedOption>& options) {
  std::vector<std::string> names;
  for (const apps::SearchedOption& option : options) {
    names.push_back(option.name + "=" + option.values.front());
  }
  return names;
}

std::vector<std::string> searched(const char* system) {
  const apps::System found = apps::find_system(system);
  return names_of(searched_options(apps::setups_on_all_structures({found}).front()));
}

}  // namespace

TEST_CASE("each system is described on its own structure, with one pixel in flight and without backpressure") {
  StudySubject subject("tetra-4");
  SystemsStudy study = study_of("tetra-4", SystemTable::described, {});
  study.chosen = SystemsStudy::all_systems();
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == study.chosen.size());
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const apps::System system = study.chosen[row];
    CAPTURE(name_of(system));
    CHECK(text(table, row, "system") == name_of(system));
    CHECK(text(table, row, "structure") == apps::name_of(original_database_of(system).build.structure));
    CHECK(text(table, row, "memory") == "as needed");
    const bool has_rays = strategy_of(system).strategy == apps::Strategy::dataflow;
    CHECK(is_missing(table, row, "in flight") == (has_rays || is_missing(table, row, "page size")));
    if (has_rays) {
      CHECK(text(table, row, "backpressure") == "off");
    } else if (!is_missing(table, row, "in flight")) {
      CHECK(text(table, row, "in flight") == "1");
    }
    CHECK(real(table, row, "virtual time") > 0);
  }
  CHECK(subject.runs.count() == study.chosen.size());
}

TEST_CASE("the table of what was described has the verdicts that authors drew, and no others") {
  StudySubject subject("tetra-4");
  const Table all = subject.measure(study_of("tetra-4", SystemTable::described, {"svm", "equal-size", "subsampled", "moving"}));
  CHECK(note_count(all, "Badouel, Bouatouch and Priol (1994): ") == 2);
  CHECK(note_count(all, "Isolated, balance (subsampled, equal-size) alone") == 1);
  CHECK(note_count(all, "Isolated, strategy (svm, dataflow) alone") == 1);
  CHECK(note_count(all, "Best against best") == 0);
  CHECK(SystemsStudy{}.conclusion(all).empty());
}

TEST_CASE("what the article says of structures is judged where both have the prices of one machine") {
  StudySubject subject("tetra-4");
  SystemsStudy study = study_of("tetra-4", SystemTable::described, {"replicated", "replicated-extents"});
  CHECK(note_count(subject.measure(study), "not judged, since the structures have prices of their own") == 1);
  study.machine = *apps::find_machine_preset("hdr");
  CHECK(note_count(subject.measure(study), "Isolated, structure (voxels, extents) alone") == 1);
}

TEST_CASE("with equal memory each system has a row on every structure that it can walk, and the film stays") {
  StudySubject subject("tetra-5");
  const Table table = subject.measure(study_of("tetra-5", SystemTable::equal, {"svm", "svm-extents", "forest", "subsampled"}));
  REQUIRE(table.rows().size() == 3 + 1 + 3);
  CHECK(text(table, 0, "system") == "svm");
  CHECK(text(table, 3, "system") == "forest");
  CHECK(text(table, 3, "structure") == "extents");
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    CHECK(whole(table, row, "node memory") == whole(table, 0, "node memory"));
  }
}

TEST_CASE("the search of a system tries what it has and what does not define it, from its defaults on") {
  CHECK(searched("svm") == std::vector<std::string>{"page-size=1KiB", "in-flight=16", "work-donor=ring", "resident=0"});
  CHECK(searched("svm-resident") == std::vector<std::string>{"page-size=1KiB", "in-flight=16"});
  CHECK(searched("green-paddon") == std::vector<std::string>{"page-size=1KiB", "in-flight=16"});
  CHECK(searched("pixel-machine") == std::vector<std::string>{"page-size=1KiB", "in-flight=16", "resident=0"});
  CHECK(searched("forest") == std::vector<std::string>{"page-size=4KiB", "in-flight=16", "work-donor=ring"});
  CHECK(searched("forest-static") == std::vector<std::string>{"page-size=4KiB", "in-flight=16"});
  CHECK(searched("replicated") == std::vector<std::string>{"work-donor=ring"});
  CHECK(searched("moving") == std::vector<std::string>{"backpressure=on", "ray-batch=default"});
}

TEST_CASE("a cell has one verdict for each other strategy, of the best found by the search, or says that it is too small") {
  StudySubject subject("tetra-5");
  SystemsStudy study = study_of("tetra-5", SystemTable::equal, {"svm", "forest", "subsampled"});
  study.has_search = true;
  study.draws = 3;
  const Table table = subject.measure(study);
  CHECK(note_count(table, "Search, 4 nodes, memory rays") == table.rows().size());
  const std::size_t verdicts = note_count(table, "Best against best");
  CHECK(verdicts == (note_count(table, "Too small, 4 nodes") == 1 ? 0 : 2));
  CHECK(SystemsStudy{}.conclusion(table).empty() == (verdicts == 0));
}

TEST_CASE("what fits no setting has a row without figures, and a cell in which nothing fits says so") {
  StudySubject subject("tetra-5");
  SystemsStudy study = study_of("tetra-5", SystemTable::equal, {"replicated"});
  study.memories = {{.bytes = 4096}};
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 3);
  CHECK(is_missing(table, 0, "virtual time"));
  CHECK(whole(table, 0, "node memory") == 4096);
  CHECK(note_count(table, "nothing fits") == 1);
}

TEST_CASE("voxels on the iPSC/2 have the prices that were fitted to voxels, and other machines keep theirs") {
  const auto name_for = [](core::Structure structure, const char* machine) {
    return priced_for(structure, *apps::find_machine_preset(machine)).machine.name;
  };
  CHECK(name_for(core::Structure::voxels, "ipsc2") == "ipsc2-1994");
  CHECK(name_for(core::Structure::grid, "ipsc2") == "ipsc2");
  CHECK(name_for(core::Structure::extents, "ipsc2-1994") == "ipsc2");
  CHECK(name_for(core::Structure::voxels, "hdr") == "hdr");
}

TEST_CASE("a system that does not exist is bad usage that lists those there are") {
  CHECK_THROWS_WITH_AS(apps::find_system("nonsense"),
                       doctest::Contains("there is no system \"nonsense\": one of replicated, replicated-extents, svm,"),
                       core::UsageError);
}

}  // namespace dmpc::tests::systems_test
