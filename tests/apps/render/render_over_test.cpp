// The command over ranks, of which the first reads, writes and prints: several in one process, by the loopback fabric.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/line/words.h"
#include "apps/main/commands.h"
#include "apps/render/command.h"
#include "apps/render/ranks.h"
#include "core/base/expect.h"
#include "tests/support/immutable_files.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/trace_events.h"

namespace render_over_test {

namespace {

using namespace dmpc;
namespace fs = std::filesystem;
using apps::RenderOptions;

RenderOptions options_of(std::vector<std::string> line) {
  line.insert(line.begin(), "render");
  return apps::parse_command_line(line).options<RenderOptions>();
}

/// What has become of a rank's command: its status, or what it threw, and what it printed.
struct Ended {
  int status = 0;
  std::string printed;
};

std::vector<tests::RankResult<Ended>> render_over(std::uint32_t rank_count, const RenderOptions& options,
                                                  const nodes::LoopbackTrouble& trouble = {},
                                                  apps::Files& files = apps::real_files()) {
  apps::Interrupt interrupt;
  const auto render = [&](nodes::Fabric& fabric) {
    std::ostringstream output;
    const int status = apps::render_over(fabric, options, interrupt, output, files);
    return Ended{status, output.str()};
  };
  return tests::on_ranks(rank_count, trouble, render, nodes::frame_bytes_for(apps::payload_bytes_max(options)));
}

/// The picture's file, of a render that goes well on all ranks.
std::string picture_over(std::uint32_t rank_count, std::vector<std::string> line, const nodes::LoopbackTrouble& trouble = {},
                         apps::Files& files = apps::real_files()) {
  const tests::TemporaryFolder folder;
  const fs::path image = folder.path() / "picture.exr";
  line.insert(line.end(), {"--runner=mpi", "-o", image.string()});
  const auto results = render_over(rank_count, options_of(line), trouble, files);
  for (std::size_t rank = 0; rank < results.size(); ++rank) {
    CAPTURE(rank);
    CHECK(results[rank].failure_text() == "");
    REQUIRE(results[rank].value);
    CHECK(results[rank].value->status == 0);
    CHECK(results[rank].value->printed.empty() == (rank > 0));
  }
  return tests::file_text(image);
}

std::string picture_of(std::vector<std::string> line) {
  const tests::TemporaryFolder folder;
  const fs::path image = folder.path() / "picture.exr";
  line.insert(line.end(), {"-o", image.string()});
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::render_command(options_of(line), interrupt, output) == 0);
  return tests::file_text(image);
}

const std::vector<std::string> small = {"balls-1", "--resolution=20x14", "--nodes=5"};

std::vector<std::string> small_with(std::initializer_list<const char*> more) {
  std::vector<std::string> line = small;
  line.insert(line.end(), more.begin(), more.end());
  return line;
}

TEST_CASE("every strategy and its systems render over ranks what they do in one process, and the first rank alone prints") {
  const std::string picture = picture_of(small);
  for (const char* const how :
       {"--strategy=svm", "--strategy=replicated", "--strategy=dataflow", "--strategy=forest", "--system=pixel-machine",
        "--system=green-paddon", "--system=scattered", "--system=moving", "--system=moving --page-size=64KiB", "--count-pages"}) {
    for (const std::uint32_t ranks : {1U, 2U, 5U}) {
      CAPTURE(how);
      CAPTURE(ranks);
      std::vector<std::string> line = small;
      for (const std::string& word : apps::words_between(how, ' ')) {
        line.push_back(word);
      }
      const tests::TemporaryFolder folder;
      line.push_back("--stats=" + (folder.path() / "stats.json").string());
      CHECK((picture_over(ranks, line) == picture));
    }
  }
}

/// Results of three frames over `rank_count` ranks, or in one process: pictures, heat maps and counted rays.
std::vector<std::string> frames_over(std::uint32_t rank_count, std::vector<std::string> line) {
  const tests::TemporaryFolder folder;
  line.insert(line.end(),
              {"--frames=3", "--turntable=10", "-o", (folder / "frame.#.exr").string(),
               "--heatmap=rays:" + (folder / "heat.#.png").string(), "--stats=" + (folder / "stats.#.json").string()});
  if (rank_count > 0) {
    line.push_back("--runner=mpi");
    for (const auto& result : render_over(rank_count, options_of(line))) {
      CHECK(result.failure_text() == "");
      CHECK(result.value.value().status == 0);
    }
  } else {
    apps::Interrupt interrupt;
    std::ostringstream output;
    CHECK(apps::render_command(options_of(line), interrupt, output) == 0);
  }
  std::vector<std::string> found;
  for (const std::string number : {"1", "2", "3"}) {
    found.push_back(tests::file_text(folder / ("frame." + number + ".exr")));
    const auto stats = nlohmann::json::parse(tests::file_text(folder / ("stats." + number + ".json")));
    found.push_back(stats["rays"].dump());
    CHECK(stats["ranks"].size() == rank_count);
    found.push_back(tests::file_text(folder / ("heat." + number + ".png")));
  }
  return found;
}

TEST_CASE("frames over ranks are those of one process, each with its own heat map and counters") {
  for (const char* const strategy : {"--strategy=svm", "--strategy=dataflow", "--strategy=forest"}) {
    CAPTURE(strategy);
    const std::vector<std::string> alone = frames_over(0, small_with({strategy}));
    CHECK(alone[0] != alone[3]);
    CHECK((frames_over(2, small_with({strategy})) == alone));
    CHECK((frames_over(5, small_with({strategy})) == alone));
  }
}

TEST_CASE("ranks agree on a frame that equals the one before, and go on with the next") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "path", "1 4,1,3/0,0,0/0,0,1/30\n2 4,1,3/0,0,0/0,0,1/30\n3 1,4,3/0,0,0/0,0,1/30\n");
  for (const char* const strategy : {"--strategy=svm", "--strategy=dataflow"}) {
    CAPTURE(strategy);
    const std::string name = (folder / strategy).string();
    auto line = small_with({"--runner=mpi", strategy, "--frames=3"});
    line.insert(line.end(), {"--camera-path=" + (folder / "path").string(), "-o", name + "#.exr", "--stats=" + name + "#.json"});
    const auto results = render_over(3, options_of(line));
    for (const auto& result : results) {
      CHECK(result.failure_text() == "");
    }
    CHECK(tests::contains(results[0].value.value().printed, ", a copy of frame 1\nframe 3  "));
    CHECK(tests::file_text(name + "1.exr") == tests::file_text(name + "2.exr"));
    CHECK(tests::file_text(name + "1.exr") != tests::file_text(name + "3.exr"));
    const auto copied = nlohmann::json::parse(tests::file_text(name + "2.json"));
    CHECK(copied["ranks"].size() == 3);
    CHECK(copied["ranks"][1]["packets"]["sent"] == 0);
    CHECK(nlohmann::json::parse(tests::file_text(name + "3.json"))["rays"]["primary"] == 280);
  }
}

TEST_CASE("closing lines and counters tell of the ranks") {
  const tests::TemporaryFolder folder;
  auto line = small_with({"--runner=mpi", "--strategy=svm"});
  line.insert(line.end(), {"--stats=" + (folder / "stats.json").string(), "-o", (folder / "picture.png").string()});
  const auto results = render_over(3, options_of(line));
  REQUIRE(results[0].value);
  CHECK(tests::contains(results[0].value->printed, "\nranks    3, up to "));
  CHECK(tests::contains(results[0].value->printed, " of network memory: outbox "));
  const auto stats = nlohmann::json::parse(tests::file_text(folder / "stats.json"));
  REQUIRE(stats["ranks"].size() == 3);
  std::uint64_t sent = 0, received = 0, nodes = 0;
  for (const auto& rank : stats["ranks"]) {
    sent += rank["packets"]["sent"].get<std::uint64_t>();
    received += rank["packets"]["received"].get<std::uint64_t>();
    nodes += rank["nodes"].get<std::uint64_t>();
    CHECK(rank["network_memory"]["total"] > rank["network_memory"]["outbox"]);
  }
  CHECK(nodes == 5);
  CHECK(sent > 0);
  CHECK(sent == received);
  CHECK(stats["ranks"][2]["name"] == "rank 2");
}

TEST_CASE("heat maps, a trace and a page are written by the first rank, and the picture is the same") {
  const std::string picture = picture_of(small);
  for (const char* const strategy : {"--strategy=svm", "--strategy=dataflow", "--strategy=forest", "--strategy=replicated"}) {
    CAPTURE(strategy);
    const tests::TemporaryFolder folder;
    auto line = small_with({strategy});
    line.insert(
        line.end(),
        {"--heatmap=rays:" + (folder.path() / "heat.exr").string(), "--trace=" + (folder.path() / "trace.pftrace").string(),
         "--report=" + (folder.path() / "page.html").string(), "--stats=" + (folder.path() / "stats.json").string()});
    CHECK((picture_over(3, line, {.seed = 1, .late_polls_max = 5}) == picture));
    CHECK(folder.entry_count() == 4);
    const auto stats = nlohmann::json::parse(tests::file_text(folder / "stats.json"));
    CHECK(stats["heat_maps"][0]["sum"] == stats["rays"]["total"]);
    CHECK(stats["ranks"][0]["clock_error"] == 0);
    CHECK(stats["ranks"][2]["clock_error"] > 0);
    CHECK(tests::trace_events(tests::file_text(folder / "trace.pftrace")).size() > 100);
    CHECK(tests::contains(tests::file_text(folder / "page.html"), "</html>"));
  }
}

TEST_CASE("frames that are late change no picture") {
  const std::string picture = picture_of(small);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    CHECK((picture_over(3, small_with({"--strategy=svm"}), {.seed = seed, .late_polls_max = 30}) == picture));
    CHECK((picture_over(3, small_with({"--strategy=dataflow"}), {.seed = seed, .late_polls_max = 30}) == picture));
  }
}

TEST_CASE("a picture with as many samples as it needs is the same over ranks") {
  const auto line = small_with({"--samples=auto"});
  const std::string picture = picture_of(line);
  CHECK((picture_over(3, line) == picture));
  auto rays = line;
  rays.emplace_back("--strategy=dataflow");
  CHECK((picture_over(3, rays) == picture));
}

TEST_CASE("what was kept on some ranks is gone on with on others, by another strategy, to the same picture") {
  const tests::TemporaryFolder folder;
  const std::string kept = "--checkpoint=" + (folder.path() / "kept").string();
  const std::string picture = picture_of(small);
  tests::ImmutableFiles files;
  auto first = small_with({"--checkpoint-every=0.000001", "--strategy=svm"});
  first.push_back(kept);
  CHECK((picture_over(2, first, {}, files) == picture));
  REQUIRE(fs::exists(folder.path() / "kept"));
  for (const char* const strategy : {"--strategy=dataflow", "--strategy=replicated", "--strategy=svm"}) {
    CAPTURE(strategy);
    auto next = small_with({"--resume", strategy});
    next.push_back(kept);
    CHECK((picture_over(3, next, {}, files) == picture));
  }
}

TEST_CASE("what is wrong before a run is said by the first rank, and the others end with its status") {
  const tests::TemporaryFolder folder;
  const std::string image = (folder.path() / "picture.png").string();
  const auto check = [&](const std::vector<std::string>& line, const char* words, int status) {
    const auto results = render_over(3, options_of(line));
    CHECK(results[0].failure_text().find(words) != std::string::npos);
    for (const std::size_t rank : {1U, 2U}) {
      REQUIRE(results[rank].value);
      CHECK(results[rank].value->status == status);
      CHECK(results[rank].value->printed.empty());
    }
  };
  check({"/there/is/no.nff", "--runner=mpi", "-o", image}, "no.nff", apps::input_status);
  check({"balls-1", "--runner=mpi", "-o", "/there/is/none/picture.png"}, "/there/is/none", apps::input_status);
  check({"balls-2", "--runner=mpi", "--node-memory=1KiB", "-o", image}, "--node-memory=1KiB is too small",
        apps::no_capacity_status);
  CHECK(!fs::exists(image));
}

TEST_CASE("fewer nodes than ranks are refused on all of them, before anything is read") {
  const auto results = render_over(3, options_of({"/there/is/no.nff", "--runner=mpi", "--nodes=2", "-o", "picture.png"}));
  for (const auto& result : results) {
    CHECK(result.failure_text() == "--nodes=2: expected at least one node for each of the 3 ranks");
  }
}

TEST_CASE("what ranks cannot do is refused with the line") {
  CHECK_THROWS_AS(options_of({"balls-1", "--runner=mpi", "--machine=hdr", "-o", "picture.png"}), core::UsageError);
  CHECK_THROWS_AS(options_of({"balls-1", "--runner=mpi", "--strategy=replicated", "--tracer=embree", "-o", "picture.png"}),
                  core::UsageError);
}

}  // namespace

}  // namespace render_over_test
