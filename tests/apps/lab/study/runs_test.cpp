#include "apps/lab/study/runs.h"

#include <doctest/doctest.h>

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/run/run_strategy.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_runs_test {

namespace {

bool says(const StudySubject& subject, const std::string& words) {
  return subject.progress.str().find(words) != std::string::npos;
}

apps::StrategyOptions modelled(apps::Strategy strategy, std::uint32_t node_count) {
  apps::StrategyOptions options{.strategy = strategy, .computer = {.node_count = node_count}};
  choose_machine(options, apps::find_machine_preset("ipsc2")->machine);
  return options;
}

/// Hash, times, packets and rays of each run.
std::vector<std::string> prints(StudySubject& subject, std::span<const apps::StrategyOptions> runs) {
  std::vector<std::string> prints;
  subject.runs.run_side_by_side(runs, [&](std::size_t, const apps::StudyOutcome& outcome) {
    const apps::Account account = apps::account_of(outcome.report.value());
    std::string& print = prints.emplace_back(std::to_string(account.virtual_time->run_hash(account.film.hash())));
    for (std::size_t node = 0; node < account.nodes.size(); ++node) {
      print += " " + std::to_string(account.virtual_time->nodes[node].computing_ns) + " " +
               std::to_string(total(account.nodes[node].counters.sent).bytes) + " " +
               std::to_string(account.nodes[node].operations.rays[0]);
    }
  });
  return prints;
}

}  // namespace

TEST_CASE("before the first run there is no film") {
  const StudySubject subject("balls-1");
  CHECK(subject.runs.count() == 0);
  CHECK_FALSE(subject.runs.film_hash());
}

TEST_CASE("runs of either strategy are counted, shown by number and name, and have one film") {
  StudySubject subject("balls-1");
  subject.runs.expect_runs(9);
  const dataflow::Report rays = subject.runs.run("three nodes", dataflow::RunOptions{.computer = {.node_count = 3}});
  const svm::Report pages = subject.runs.run("two nodes", svm::RunOptions{.computer = {.node_count = 2}});
  CHECK(rays.nodes.size() == 3);
  CHECK(pages.nodes.size() == 2);
  CHECK(subject.runs.count() == 2);
  CHECK(subject.runs.film_hash() == rays.film.hash());
  CHECK(subject.runs.film_hash() == pages.film.hash());
  CHECK(says(subject, "run 1 of 9, three nodes: "));
  CHECK(says(subject, "run 2 of 9, two nodes: "));
}

TEST_CASE("runs of every strategy side by side are taken in their order and counted") {
  StudySubject subject("balls-1");
  std::vector<apps::StrategyOptions> runs;
  for (const apps::Strategy strategy : {apps::Strategy::svm, apps::Strategy::dataflow, apps::Strategy::replicated}) {
    for (const std::uint32_t node_count : {5U, 1U}) {
      runs.push_back(modelled(strategy, node_count));
    }
  }
  std::vector<std::size_t> nodes_of_runs;
  subject.runs.run_side_by_side(runs, [&](std::size_t index, const apps::StudyOutcome& outcome) {
    CHECK(index == nodes_of_runs.size());
    CHECK(outcome.misfit.empty());
    nodes_of_runs.push_back(apps::account_of(outcome.report.value()).nodes.size());
  });
  CHECK(nodes_of_runs == std::vector<std::size_t>{5, 1, 5, 1, 5, 1});
  CHECK(subject.runs.count() == 6);
  CHECK(says(subject, "runs 1 to 6, side by side: "));
}

TEST_CASE("a run side by side with others has the hash and the counters that it has alone") {
  StudySubject subject("rings-2-t1", 24);
  std::vector<apps::StrategyOptions> runs;
  for (const apps::Strategy strategy : {apps::Strategy::svm, apps::Strategy::dataflow, apps::Strategy::replicated}) {
    runs.push_back(modelled(strategy, 7));
  }
  std::vector<std::string> alone;
  for (const apps::StrategyOptions& run : runs) {
    alone.push_back(prints(subject, std::span(&run, 1)).front());
  }
  CHECK(prints(subject, runs) == alone);
  CHECK(prints(subject, runs) == alone);
}

TEST_CASE("a scene that does not fit is no report but a reason, and the others are rendered") {
  StudySubject subject("balls-1");
  std::vector<apps::StrategyOptions> runs = {modelled(apps::Strategy::svm, 2), modelled(apps::Strategy::dataflow, 3),
                                             modelled(apps::Strategy::svm, 4)};
  runs[0].computer.node_memory_bytes = 1000;
  runs[1].computer.node_memory_bytes = 1000;
  std::vector<std::string> misfits;
  subject.runs.run_side_by_side(runs, [&](std::size_t, const apps::StudyOutcome& outcome) {
    CHECK(outcome.report.has_value() == outcome.misfit.empty());
    misfits.push_back(outcome.misfit);
  });
  REQUIRE(misfits.size() == 3);
  CHECK(misfits[0].find("--nodes=2: the smallest that works is ") != std::string::npos);
  CHECK(misfits[1].find("is too small for --nodes=3: node ") != std::string::npos);
  CHECK(misfits[2].empty());
  CHECK(subject.runs.count() == 1);
}

TEST_CASE("a scene that fits no computer is an error, once all have been told of, and the first one's reason") {
  StudySubject subject("balls-1");
  std::vector<apps::StrategyOptions> runs = {modelled(apps::Strategy::dataflow, 3), modelled(apps::Strategy::svm, 2)};
  std::size_t misfits = 0;
  for (apps::StrategyOptions& run : runs) {
    run.computer.node_memory_bytes = 1000;
  }
  CHECK_THROWS_WITH_AS(subject.runs.run_side_by_side(runs, [&](std::size_t, const apps::StudyOutcome&) { ++misfits; }),
                       doctest::Contains("is too small for --nodes=3: node "), apps::NothingFits);
  CHECK(misfits == 2);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which need more memory and time than these have

TEST_CASE("1,024 nodes run in virtual time") {
  StudySubject subject("balls-1", 8);
  const std::vector<apps::StrategyOptions> runs = {modelled(apps::Strategy::svm, 1024), modelled(apps::Strategy::dataflow, 1024)};
  std::vector<std::size_t> node_counts;
  subject.runs.run_side_by_side(runs, [&](std::size_t, const apps::StudyOutcome& outcome) {
    node_counts.push_back(apps::account_of(outcome.report.value()).nodes.size());
  });
  CHECK(node_counts == std::vector<std::size_t>{1024, 1024});
}
#endif

TEST_CASE("what had to be reduced for a run to fit is noted") {
  StudySubject subject("balls-1");
  std::vector<apps::StrategyOptions> runs = {modelled(apps::Strategy::svm, 2)};
  runs[0].computer.node_memory_bytes = 400 << 10U;
  runs[0].pages.in_flight = 4000;
  std::vector<std::string> notes;
  subject.runs.run_side_by_side(runs, [&](std::size_t, const apps::StudyOutcome& outcome) { notes = outcome.notes; });
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("in-flight reduced from 4000 to ") != std::string::npos);
}

TEST_CASE("a machine with prices for another structure than the scene's is noted once") {
  StudySubject subject("balls-1", 8);
  const auto take = [](std::size_t, const apps::StudyOutcome&) {};
  const auto notes = [&] {
    apps::Table table("", {});
    subject.runs.add_price_notes(table);
    return table.notes();
  };
  std::vector<apps::StrategyOptions> runs = {modelled(apps::Strategy::svm, 2), modelled(apps::Strategy::svm, 3)};
  subject.runs.run_side_by_side(runs, take);
  CHECK(notes().empty());
  for (apps::StrategyOptions& run : runs) {
    choose_machine(run, apps::find_machine_preset("ipsc2-1994")->machine);
  }
  subject.runs.run_side_by_side(runs, take);
  REQUIRE(notes().size() == 1);
  CHECK(notes()[0].starts_with("ipsc2-1994 has prices for other structures (voxels) than grid"));
}

TEST_CASE("runs with threads are not run side by side, and no runs are none") {
  StudySubject subject("balls-1");
  const std::vector<apps::StrategyOptions> on_threads(1);
  const auto take = [](std::size_t, const apps::StudyOutcome&) { throw core::InputError("taken"); };
  CHECK_THROWS_AS(subject.runs.run_side_by_side(on_threads, take), core::InternalError);
  subject.runs.run_side_by_side(std::span<const apps::StrategyOptions>(), take);
  CHECK(subject.runs.count() == 0);
}

TEST_CASE("a film unlike the first is a broken invariant") {
  StudySubject subject("balls-1");
  subject.runs.run("one node", svm::RunOptions{.computer = {.node_count = 1}});
  CHECK_THROWS_AS(subject.runs.compare(core::Film(32, 32)), core::InternalError);
}

TEST_CASE("a run that cannot be planned is not counted") {
  StudySubject subject("balls-1");
  CHECK_THROWS_AS(subject.runs.run("too small", svm::RunOptions{.computer = {.node_memory_bytes = 1}}), core::InputError);
  CHECK(subject.runs.count() == 0);
  CHECK_FALSE(subject.runs.film_hash());
}

}  // namespace dmpc::tests::study_runs_test
