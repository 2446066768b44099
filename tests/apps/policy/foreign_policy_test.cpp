#include "apps/policy/foreign_policy.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "core/base/expect.h"
#include "svm/pages/observers/optimum.h"
#include "svm/pages/replacement.h"
#include "tests/apps/policy/policy_file.h"
#include "tests/support/child_process.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::foreign_policy_test {

namespace {

namespace fs = std::filesystem;
using apps::ForeignPolicy;
using apps::PricedFaults;
using svm::PageId;

void no_check() {}

/// Pages that come back near and far, in no simple order, none twice in a row.
std::vector<PageId> references() {
  std::vector<PageId> pages;
  std::uint32_t state = 7;
  for (int i = 0; i < 4000; ++i) {
    state = state * 1'103'515'245 + 12'345;
    const auto page = PageId{(state >> 16U) % ((state >> 28U) < 10 ? 12 : 60)};
    if (pages.empty() || pages.back() != page) {
      pages.push_back(page);
    }
  }
  return pages;
}

std::vector<PageId> all_different(std::uint32_t count) {
  std::vector<PageId> pages;
  for (std::uint32_t i = 0; i < count; ++i) {
    pages.push_back(PageId{i});
  }
  return pages;
}

/// What a policy's misses end with.
std::string complaint_of(const ForeignPolicy& policy, std::uint32_t cache_pages, const std::vector<PageId>& pages) {
  const std::vector<std::uint32_t> caches = {cache_pages};
  return tests::complaint_of([&] { policy.misses(pages, caches, 3, no_check, no_check); });
}

std::string refusal_of(const std::string& place) {
  return tests::complaint_of([&] { const ForeignPolicy policy("--policy", place, no_check); });
}

ForeignPolicy loaded(const PolicyFile& policy) { return ForeignPolicy("--policy", policy.place(), no_check); }

std::string clock_in_python() {
  return "python:" + fs::canonical(DMPC_SOURCE_DIR "/apps/python/examples/clock.py").string() + ":Clock";
}

}  // namespace

TEST_CASE("a clock of one's own, in Python and in a library, misses what dmpc's own does, with caches of every size") {
  const std::vector<PageId> pages = references();
  const std::vector<std::uint32_t> caches = {0, 1, 2, 3, 7, 16, 40, 59, 60, 61};
  for (const std::string& place : {clock_in_python(), std::string(DMPC_CLOCK_POLICY)}) {
    CAPTURE(place);
    std::size_t fed = 0;
    const std::vector<PricedFaults> misses =
        ForeignPolicy("--policy", place, no_check).misses(pages, caches, 0, no_check, [&fed] { ++fed; });
    REQUIRE(misses.size() == caches.size());
    CHECK(fed == caches.size());
    for (std::size_t i = 0; i < caches.size(); ++i) {
      CHECK(misses[i].cost == misses[i].count);
      CHECK(misses[i].count == svm::policy_misses(svm::Replacement::clock, pages, caches[i], 0));
    }
  }
  CHECK(ForeignPolicy("--policy", DMPC_CLOCK_POLICY, no_check).name() == "my-clock");
  CHECK(ForeignPolicy("--policy", clock_in_python(), no_check).name() == "Clock");
}

TEST_CASE("S4-FIFO with its knobs at rest misses what dmpc's s3-fifo does") {
  const std::string file = fs::canonical(DMPC_SOURCE_DIR "/apps/python/examples/s4_fifo.py").string();
  const std::vector<PageId> pages = references();
  const std::vector<std::uint32_t> caches = {1, 2, 3, 9, 16, 31, 40, 59};
  const auto faults =
      ForeignPolicy("--policy", "python:" + file + ":S4Fifo", no_check).misses(pages, caches, 0, no_check, no_check);
  for (std::size_t i = 0; i < caches.size(); ++i) {
    CHECK(faults[i].count == svm::policy_misses(svm::Replacement::small_and_main, pages, caches[i], 0));
  }
}

TEST_CASE("a page that a policy does not take in is fetched and evicts nothing, and prices tell which is worth a frame") {
  const PolicyFile python(policy_source("priced"));
  // A frame: page 7 costs 1, then 1 costs 10 and stays. Page 2, twice in a row, is one reference.
  const std::vector<PageId> few = {PageId{7}, PageId{1}, PageId{2}, PageId{2}, PageId{1}, PageId{2}, PageId{1}};
  const std::vector<std::uint32_t> prices = {1, 10, 3, 3, 10, 3, 10}, one = {1}, caches = {0, 1, 2, 7, 59, 60};
  const std::vector<PageId> many = references();
  std::vector<std::uint32_t> price_of_many;
  for (const PageId page : many) {
    price_of_many.push_back(1 + svm::index_of(page) * 7 % 23);
  }
  const ForeignPolicy dear("--policy", DMPC_DEAR_POLICY, no_check), mine = loaded(python);
  for (const ForeignPolicy* const policy : {&dear, &mine}) {
    CAPTURE(policy->name());
    const PricedFaults faults = policy->misses(few, one, 0, no_check, no_check, prices).front();
    CHECK(faults.count == 4);
    CHECK(faults.cost == 1 + 10 + 3 + 3);
  }
  const auto by_library = dear.misses(many, caches, 0, no_check, no_check, price_of_many);
  const auto by_python = mine.misses(many, caches, 0, no_check, no_check, price_of_many);
  for (std::size_t i = 0; i < caches.size(); ++i) {
    CHECK(by_library[i].count == by_python[i].count);
    CHECK(by_library[i].cost == by_python[i].cost);
  }
  CHECK(by_library.front().count == many.size());
  CHECK(by_library.back().count == 60);
}

TEST_CASE("a library of the interface's first version runs as it did, and its price() is not looked for") {
  const std::vector<std::uint32_t> caches = {2};
  const ForeignPolicy old("--policy", DMPC_OLD_POLICY, no_check);
  CHECK(old.name() == "old");
  CHECK(old.misses(all_different(5), caches, 0, no_check, no_check).front().count == 5);
}

TEST_CASE("a policy hears of what dmpc's own hear: each page that comes, and hits of a page in a row once") {
  const PolicyFile python(policy_source("heard"));
  const std::vector<PageId> pages = {PageId{5}, PageId{5}, PageId{8}, PageId{8}, PageId{5}, PageId{5}, PageId{8}, PageId{9}};
  CHECK(contains(complaint_of(loaded(python), 2, pages), "Exception: 2 3: insert 5 0 insert 8 1 hit 5 0 hit 8 1"));
}

TEST_CASE("what a policy in Python does wrong is told with its call, fault, cache, file and line") {
  const PolicyFile python(policy_source("wrong"));
  const ForeignPolicy policy = loaded(python);
  const std::vector<PageId> pages = all_different(50);
  const auto said = [&](std::uint32_t cache_pages) { return complaint_of(policy, cache_pages, pages); };
  const std::string begin = "--policy=" + python.place() + ": ";
  CHECK(said(2) == begin + "making it for 2 frames of node 3: ValueError: two are too few (" + python.file + ", line 3)");
  CHECK(said(3) == begin + "victim(page 3) of fault 4, with 3 frames of node 3: KeyError: 'none' (" + python.file + ", line 6)");
  CHECK(said(4) ==
        begin + "victim(page 4) of fault 5, with 4 frames of node 3: it says 4, expected a frame from 0 to 3, or 'bypass'");
  CHECK(contains(said(5), "it says None, expected a frame from 0 to 4, or 'bypass'"));
  CHECK(contains(said(6), "SystemExit: 0 (" + python.file + ", line 9)"));
  CHECK(contains(said(7), "it says True, expected a frame from 0 to 6"));
  CHECK(contains(said(8), "it says -1, expected a frame from 0 to 7"));
  CHECK(contains(said(9), "RecursionError"));
  CHECK(contains(said(10), "signal 6 ended it"));
}

TEST_CASE("what a library's policy does wrong is told with its call, fault and cache, and harms nobody, though it crashes") {
  const ForeignPolicy policy("--policy", DMPC_HOSTILE_POLICY, no_check);
  const auto said = [&](std::uint32_t cache_pages) { return complaint_of(policy, cache_pages, all_different(50)); };
  const std::string begin = "--policy=" + std::string(DMPC_HOSTILE_POLICY) + ": ";
  CHECK(said(1) == "");
  CHECK(said(2) == begin + "make(), with 2 frames of node 3: two are too few");
  CHECK(said(3) == begin + "victim(page 3) of fault 4, with 3 frames of node 3: no idea");
  CHECK(said(4) ==
        begin + "victim(page 4) of fault 5, with 4 frames of node 3: it says frame 4, expected one from 0 to 3, or bypass");
  CHECK(said(5) == begin + "victim(page 5) of fault 6, with 5 frames of node 3: it crashed (SIGSEGV)");
  CHECK(said(6) == begin + "victim(page 6) of fault 7, with 6 frames of node 3: it ended the process");
  CHECK(said(7) == begin + "victim(page 7) of fault 8, with 7 frames of node 3: it crashed (SIGABRT)");
  CHECK(contains(said(9), "it prints more than a megabyte"));
  CHECK(contains(said(10), "it threw what is no std::exception"));
  const std::vector<std::uint32_t> deep = {11};
  CHECK_THROWS_WITH_AS(policy.misses(references(), deep, 0, no_check, no_check), doctest::Contains("hit(page"), core::InputError);
}

TEST_CASE("a policy that does not come to an end is ended with whoever waits for it") {
  const ForeignPolicy policy("--policy", DMPC_HOSTILE_POLICY, no_check);
  const std::vector<std::uint32_t> caches = {8};
  int checks = 0;
  CHECK_THROWS_AS(policy.misses(
                      all_different(50), caches, 0,
                      [&checks] {
                        if (++checks == 5) {
                          throw apps::Interrupted();
                        }
                      },
                      no_check),
                  apps::Interrupted);
}

TEST_CASE("a policy that does not come back from a call is an error after some processor time") {
  const PolicyFile python(
      "class Mine:\n  def __init__(self, frame_count, node): pass\n  def victim(self, incoming):\n    while True: pass\n");
  const apps::PolicyPatience second{.call_seconds = 1};
  const ForeignPolicy in_python("--policy", python.place(), no_check, second),
      by_library("--policy", DMPC_HOSTILE_POLICY, no_check, second);
  CHECK(complaint_of(in_python, 2, all_different(50)) == "--policy=" + python.place() +
                                                             ": victim(page 2) of fault 3, with 2 frames of node 3: it does not "
                                                             "come back (" +
                                                             python.file + ", line 4)");
  CHECK(contains(complaint_of(by_library, 8, all_different(50)),
                 "victim(page 8) of fault 9, with 8 frames of node 3: it does not come back"));
  const PolicyFile begins("while True: pass\n");
  const std::string said = tests::complaint_of([&] { const ForeignPolicy policy("--policy", begins.place(), no_check, second); });
  CHECK(said == "--policy=" + begins.place() + ": it does not come back (" + begins.file + ", line 1)");
}

TEST_CASE("Ctrl-C ends a study whose policy hangs, and its process") {
  const TemporaryFolder folder;
  const PolicyFile python("class Mine:\n  def __init__(self, frame_count, node): open(" + std::string("'") +
                          (folder / "begun").string() + "', 'w').close()\n  def victim(self, incoming):\n    while True: pass\n");
  write_text(folder / "trace.csv", "page\n1\n2\n3\n");
  ChildProcess study(
      {DMPC_PROGRAM, "study", "references", folder / "trace.csv", "--cache-pages=2", "--policy=" + python.place()});
  for (int i = 0; i < 6000 && !fs::exists(folder / "begun"); ++i) {
    ::usleep(10'000);
  }
  ::kill(study.id(), SIGINT);
  CHECK(study.status() == 130);
}

TEST_CASE("a file that is no policy is refused with what was expected") {
  const PolicyFile python("class Other: pass\nclass Mine:\n  pass\n");
  CHECK(refusal_of(python.place("None_such")) ==
        "--policy=" + python.place("None_such") + ": it has no class None_such; it has Other, Mine");
  CHECK(refusal_of(python.place()) == "");  // missing functions are reported on construction
  CHECK(contains(complaint_of(loaded(python), 2, all_different(3)),
                 "making it for 2 frames of node 3: TypeError: Mine() takes no arguments"));
  const PolicyFile broken("class Mine:\n  def victim(self, incoming) return 0\n");
  CHECK(contains(refusal_of(broken.place()), "SyntaxError: expected ':' (" + broken.file + ", line 2)"));
  const PolicyFile failing("\nimport none_such\n");
  CHECK(contains(refusal_of(failing.place()), "ModuleNotFoundError: No module named 'none_such' (" + failing.file + ", line 2)"));
  CHECK(contains(refusal_of(python.file), "it cannot be opened as a shared library: "));
  CHECK(contains(refusal_of(DMPC_OTHER_POLICY), "its policy has version 3 of the interface, expected 1 to 2"));
  CHECK(contains(refusal_of(std::string(DMPC_BUILD_DIR) + "/apps/dmpc_embree.so"),
                 "it has no policy: expected the symbol dmpc_policy, as the line DMPC_POLICY(Class, \"name\")"));
}

TEST_CASE("a place that says nothing is refused with what one may say") {
  for (const std::string place : {"", "lru", "python:", "python:/x.py", "python:x.py:Mine", "x.so", "./x.so", "python:/x.py:M()",
                                  "python::", ":", "python:/x.py:"}) {
    CAPTURE(place);
    CHECK(refusal_of(place) == "--policy=" + place + ": expected /FULL/PATH/FILE.so or python:/FULL/PATH/FILE.py:CLASS");
  }
  CHECK(refusal_of("/none/such.so") == "--policy=/none/such.so: /none/such.so cannot be opened: No such file or directory");
  CHECK(contains(refusal_of("/dev/null"), "it is no ordinary file"));
  CHECK(contains(refusal_of("/etc"), "it is no ordinary file"));
}

TEST_CASE("a policy that others may write, or put another in its place, is not even read") {
  const PolicyFile python("raise Exception('it ran')\n");
  const auto refused = [](const std::string& place) { return contains(refusal_of(place), "others can change it, since "); };
  fs::permissions(python.file, fs::perms(0646));
  CHECK(refused(python.place()));
  fs::permissions(python.file, fs::perms(0644));
  fs::permissions(fs::path(python.file).parent_path(), fs::perms(0777));
  CHECK(refused(python.place()));
  fs::permissions(fs::path(python.file).parent_path(), fs::perms(01777));
  CHECK(refused(python.place()));
  fs::permissions(fs::path(python.file).parent_path(), fs::perms(0755));
  CHECK(contains(refusal_of(python.place()), "Exception: it ran"));

  const fs::path link = fs::path(python.file).parent_path() / "link.py";
  fs::create_symlink(python.file, link);
  CHECK(contains(refusal_of("python:" + link.string() + ":Mine"), "it is reached by links or dots; name " + python.file));
}

TEST_CASE("a policy's name is one that a table may have, and no other's") {
  const PolicyFile python("class lru: pass\nclass Mine: pass\n");
  CHECK(contains(refusal_of(python.place("lru")), "the policy's name, lru, is that of a column that there is anyway"));
  const std::vector<ForeignPolicy> twice = {loaded(python), loaded(python)};
  CHECK_THROWS_WITH_AS(check_names_differ(twice), doctest::Contains("two policies are called Mine"), core::InputError);
}

TEST_CASE("what a policy imports is what is installed, not what lies where dmpc is called or the environment says") {
  const TemporaryFolder folder;
  write_text(folder / "array.py", "raise Exception('a stranger')\n");
  write_text(folder / "stranger.py", "");
  const PolicyFile python("import stranger\n");
  write_text(folder / "trace.csv", "page\n1\n");
  ChildProcess study({"/usr/bin/env", "-C", folder.path(), "PYTHONPATH=" + folder.path().string(), DMPC_PROGRAM, "study",
                      "references", folder / "trace.csv", "--policy=" + python.place()});
  CHECK(study.status() == 1);
  CHECK(contains(study.errors(), "No module named 'stranger'"));
}

}  // namespace dmpc::tests::foreign_policy_test
