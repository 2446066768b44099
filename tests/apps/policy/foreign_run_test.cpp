// A user's policy in a run on a modelled machine.
#include "apps/policy/foreign_run.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/policy/foreign_policy.h"
#include "svm/frames.h"
#include "svm/run.h"
#include "tests/apps/policy/policy_file.h"
#include "tests/support/built_scene.h"
#include "tests/support/child_process.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::foreign_run_test {

namespace {

namespace fs = std::filesystem;
using apps::ForeignPolicy;

ForeignPolicy loaded(const std::string& place, const apps::PolicyPatience& patience = {}) {
  return {"--replacement", place, [] {}, patience};
}

/// Pages of other nodes in eight frames each, on a machine on which messages and look-ups take time.
svm::RunOptions small_caches(const svm::OwnPolicy* policy = nullptr) {
  nodes::Machine machine;
  machine.short_message = {.send_ns = 300, .latency_ns = 2000, .receive_ns = 200};
  machine.long_message = {.send_ns = 500, .latency_ns = 3000, .receive_ns = 400};
  machine.service_ns = 700;
  machine.cost_ps.fill(5000);
  return {.computer = {.node_count = 4, .machine = machine}, .pages = {.cache_pages = 8, .own_policy = policy}};
}

struct Runs {
  BuiltScene small{"teapot-4", 512, 24};

  svm::Report run(const svm::RunOptions& options) const { return svm::run_svm(small.database, small.settings, options, {}); }
  std::string complaint(const ForeignPolicy& policy, std::uint32_t cache_pages) const {
    svm::RunOptions options = small_caches(&policy);
    options.pages.cache_pages = cache_pages;
    return complaint_of([&] { run(options); });
  }
};

std::vector<svm::RunOptions> several(const svm::OwnPolicy* policy) {
  std::vector<svm::RunOptions> all(7, small_caches(policy));
  all[1].pages.homes = svm::PageHomes::tree;
  all[2].pages.bundles_on_machines = true;
  all[2].pages.in_flight = 64;
  all[3].computer.node_memory_bytes = 308 << 10U;
  all[3].pages.cache_pages = std::nullopt;
  all[4].pages.cache_pages = 1;
  all[5].pages.resident_percent = 50;
  all[6].pages.count_pages = true;
  return all;
}

}  // namespace

TEST_CASE("a least-recently-used of one's own misses and takes what dmpc's does, to the nanosecond, and again") {
  const Runs runs;
  const PolicyFile script(policy_source("lru"));
  const ForeignPolicy in_python = loaded(script.place("Lru")), by_library = loaded(DMPC_LRU_POLICY);
  const std::vector<svm::RunOptions> own = several(nullptr);
  for (const ForeignPolicy* const policy : {&in_python, &by_library, &by_library}) {
    const std::vector<svm::RunOptions> theirs = several(policy);
    for (std::size_t i = 0; i < own.size(); ++i) {
      CAPTURE(policy->name());
      CAPTURE(i);
      const svm::Report expected = runs.run(own[i]), found = runs.run(theirs[i]);
      CHECK(found.film.hash() == expected.film.hash());
      CHECK(found.pages().evictions == expected.pages().evictions);
      CHECK(found.pages().evictions > 100);
      CHECK(found.pages().faults == expected.pages().faults);
      CHECK(found.pages().cache_hits == expected.pages().cache_hits);
      CHECK(found.virtual_time->total_ns == expected.virtual_time->total_ns);
      CHECK(found.virtual_time->hash == expected.virtual_time->hash);
      for (std::size_t node = 0; node < found.nodes.size(); ++node) {
        CHECK(found.nodes[node].memory_used.bytes == found.nodes[node].memory_planned.bytes);
        CHECK(found.nodes[node].memory_used.bytes == expected.nodes[node].memory_used.bytes);
      }
    }
  }
}

TEST_CASE("policies of one's own that are dmpc's others miss what those do") {
  const Runs runs;
  const std::string examples = fs::canonical(DMPC_SOURCE_DIR "/apps/python/examples").string();
  const auto expect_equal = [&](const std::string& place, svm::Replacement replacement) {
    CAPTURE(place);
    const ForeignPolicy policy = loaded(place);
    svm::RunOptions options = small_caches();
    options.pages.replacement = replacement;
    CHECK(runs.run(small_caches(&policy)).virtual_time->hash == runs.run(options).virtual_time->hash);
  };
  expect_equal("python:" + examples + "/clock.py:Clock", svm::Replacement::clock);
  expect_equal(DMPC_CLOCK_POLICY, svm::Replacement::clock);
  expect_equal("python:" + examples + "/s4_fifo.py:S4Fifo", svm::Replacement::small_and_main);
}

TEST_CASE("what a run's cache misses is what the policy misses of the run's references") {
  const Runs runs;
  const ForeignPolicy policy = loaded(DMPC_LRU_POLICY);
  svm::RunOptions options = small_caches(&policy);
  options.pages.in_flight = 1;
  options.pages.work_item_side = 0;
  options.pages.record_references = true;
  const svm::Report report = runs.run(options);
  const std::vector<std::uint32_t> caches = {8};
  for (std::uint32_t node = 0; node < report.nodes.size(); ++node) {
    const auto misses = policy.misses(
        report.nodes[node].references.pages(), caches, node, [] {}, [] {});
    CHECK(misses.front().count == report.nodes[node].program.pages.faults);
  }
}

TEST_CASE("a page that a policy does not take in serves those who waited for it, and then is gone") {
  const Runs runs;
  const PolicyFile script(policy_source("every_third"));
  const ForeignPolicy policy = loaded(script.place());
  const svm::Report usual = runs.run(small_caches()), report = runs.run(small_caches(&policy));
  const svm::PageCounters pages = report.pages();
  CHECK(report.film.hash() == usual.film.hash());
  CHECK(pages.faults > usual.pages().faults);
  CHECK(pages.evictions > 100);
  CHECK(pages.evictions < pages.faults / 2);
  CHECK(runs.run(small_caches(&policy)).virtual_time->hash == report.virtual_time->hash);
}

TEST_CASE("frames are rendered by one process with warm caches, and by another if they begin again") {
  const Runs runs;
  const PolicyFile script(policy_source("lru"));
  const ForeignPolicy policy = loaded(script.place("Lru"));
  const auto faults_of_frames = [&](const svm::RunOptions& options) {
    svm::Frames frames(*svm::svm_strategy(), runs.small.database, runs.small.settings, options, {});
    std::vector<std::uint64_t> faults;
    for (int frame = 0; frame < 3; ++frame) {
      faults.push_back(frames.render(runs.small.settings, {}).pages().faults);
    }
    return faults;
  };
  CHECK(faults_of_frames(small_caches(&policy)) == faults_of_frames(small_caches()));
}

TEST_CASE("a policy of one's own is refused where there is no modelled machine, and by nodes that fetch no pages") {
  const Runs runs;
  const ForeignPolicy policy = loaded(DMPC_LRU_POLICY);
  svm::RunOptions options = small_caches(&policy);
  options.pages.cache_pages = std::nullopt;
  const auto replicate = [&] { svm::run_replicated(runs.small.database, runs.small.settings, options, {}); };
  CHECK(contains(complaint_of<core::UsageError>(replicate), "own_policy goes with strategy=svm"));
  options.computer.machine.reset();
  CHECK(contains(complaint_of<core::UsageError>([&] { runs.run(options); }), "own_policy is for a modelled machine"));
}

TEST_CASE("what a policy does wrong ends the run with its call, fault and cache") {
  const Runs runs;
  const ForeignPolicy policy = loaded(DMPC_HOSTILE_POLICY, {.call_seconds = 1});
  const auto said = [&](std::uint32_t cache_pages) { return runs.complaint(policy, cache_pages); };
  const std::string begin = "--replacement=" + std::string(DMPC_HOSTILE_POLICY) + ": ";
  CHECK(said(1) == "");
  CHECK(said(2) == begin + "make(), with 2 frames of node 0: two are too few");
  CHECK(contains(said(3), begin + "victim(page "));
  CHECK(contains(said(3), ") of fault 4, with 3 frames of node "));
  CHECK(contains(said(3), ": no idea"));
  CHECK(contains(said(4), ": it says frame 4, expected one from 0 to 3, or bypass"));
  CHECK(contains(said(5), "it crashed (SIGSEGV)"));
  CHECK(contains(said(6), "it ended the process"));
  CHECK(contains(said(7), "it crashed (SIGABRT)"));
  CHECK(contains(said(8), ") of fault 9, with 8 frames of node "));
  CHECK(contains(said(8), ": it does not come back"));
  CHECK(contains(said(9), "it prints more than a megabyte"));
  CHECK(contains(said(10), "it threw what is no std::exception"));
  CHECK(contains(said(11), "hit(page"));
}

TEST_CASE("what a policy in Python does wrong ends the run with its call, fault, cache, file and line") {
  const Runs runs;
  const PolicyFile script(policy_source("wrong_in_runs"));
  const ForeignPolicy patient = loaded(script.place(), {.call_seconds = 1}),
                      policy = loaded(script.place(), {.answer_seconds = 5});
  const auto said = [&](std::uint32_t cache_pages) { return runs.complaint(cache_pages == 7 ? patient : policy, cache_pages); };
  const std::string begin = "--replacement=" + script.place() + ": ", at = " (" + script.file + ", line ";
  CHECK(said(2) == begin + "making it for 2 frames of node 0: ValueError: two are too few" + at + "5)");
  CHECK(contains(said(3), ") of fault 4, with 3 frames of node "));
  CHECK(contains(said(3), ": KeyError: 'none'" + at + "9)"));
  CHECK(contains(said(4), ": it says '0', expected a frame from 0 to 3, or 'bypass'"));
  CHECK(contains(said(5), ": SystemExit: 0" + at + "11)"));
  CHECK(contains(said(6), "it ended, as if all were well, before it had answered"));
  CHECK(contains(said(7), ") of fault 8, with 7 frames of node "));
  CHECK(contains(said(7), ": it does not come back" + at + "14)"));
  CHECK(said(8) == begin + "its process has not answered for 5 s");
  CHECK(said(9) == begin + "its process does not answer any more");
  CHECK(contains(said(10), "signal 6 ended it"));
  CHECK(contains(said(11), "it answers in place of its process"));
  CHECK(contains(said(12), "it answers in place of its process"));
  CHECK(contains(said(1000), ": ValueError: late" + at + "7)"));  // no page has ever left, so nothing was asked
}

TEST_CASE("Ctrl-C ends a render whose policy hangs, and its process, and nothing is written") {
  const TemporaryFolder folder;
  const PolicyFile script("class Mine:\n  def __init__(self, frame_count, node): open('" + (folder / "begun").string() +
                          "', 'w').close()\n  def victim(self, incoming):\n    while True: pass\n");
  ChildProcess render({DMPC_PROGRAM, "render", "teapot-4", "--resolution=32x32", "--nodes=4", "--cache-pages=2",
                       "--runner=virtual", "--replacement=" + script.place(), "-o", folder / "a.png"});
  for (int i = 0; i < 6000 && !fs::exists(folder / "begun"); ++i) {
    ::usleep(10'000);
  }
  ::kill(render.id(), SIGINT);
  CHECK(render.status() == 130);
  CHECK(!fs::exists(folder / "a.png"));
}

}  // namespace dmpc::tests::foreign_run_test
