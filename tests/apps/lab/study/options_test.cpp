#include "apps/lab/study/command.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/lab/study/python/python_study.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"

namespace dmpc::apps::study_options_test {

namespace {

using Counts = std::vector<std::uint32_t>;

/// `study NAME teapot-12` and more.
StudyOptions study(const std::string& name, std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments = {"study", name, "teapot-12"};
  arguments.insert(arguments.end(), more);
  return parse_command_line(arguments).options<StudyOptions>();
}

BalanceStudy balance(std::initializer_list<std::string> more = {}) {
  return std::get<BalanceStudy>(study("balance", more).study);
}

SpeedupStudy speedup(std::initializer_list<std::string> more = {}) {
  return std::get<SpeedupStudy>(study("speedup", more).study);
}

}  // namespace

TEST_CASE("a study and a scene are all that study needs") {
  const StudyOptions options = study("balance");
  CHECK(options.picture.scene == "teapot-12");
  CHECK(options.table.format == TableFormat::markdown);
  CHECK_FALSE(options.table.file);
  CHECK(balance().node_counts == Counts{4, 8, 16, 32, 64});
  CHECK(balance().subsample == 8);
  CHECK(balance().topology == nodes::TopologyKind::hypercube);
  CHECK_FALSE(balance().per_node);
  CHECK(std::get<TrafficStudy>(study("traffic").study).node_counts == Counts{1, 2, 4, 8, 16, 32, 64});
}

TEST_CASE("options of a study are taken") {
  const StudyOptions options = study("traffic", {"--nodes=3", "--depth=2", "--format=json", "-o", "a.json"});
  CHECK(std::get<TrafficStudy>(options.study).node_counts == Counts{3});
  CHECK(options.picture.depth == 2);
  CHECK(options.table.format == TableFormat::json);
  CHECK(options.table.file == "a.json");
  const BalanceStudy taken = balance({"--subsample=4", "--topology=fat-tree", "--per-node"});
  CHECK(taken.subsample == 4);
  CHECK(taken.topology == nodes::TopologyKind::fat_tree);
  CHECK(taken.per_node);
}

TEST_CASE("every study goes along paths, too, with the options that render has") {
  for (const std::string name : {"balance", "traffic", "cache", "speedup"}) {
    CAPTURE(name);
    const PictureOptions picture = study(name, {"--transport=paths", "--bounces=3", "--sky=1/0,0,1", "--samples=4"}).picture;
    CHECK(text_of(picture.transport) == "paths, 3 bounces, sky 1,1,1/0,0,1");
    CHECK(picture.depth == 4);
    CHECK(picture.scene_setup.background == core::Vec3d{1, 1, 1});
  }
  CHECK_FALSE(study("traffic").picture.transport.is_by_paths());
  const std::vector<std::string> mesh = {"study", "traffic", "a.glb"};
  const PictureOptions shown = parse_command_line(mesh).options<StudyOptions>().picture;
  CHECK_FALSE(shown.transport.is_by_paths());
  CHECK(shown.samples == 1);
}

TEST_CASE("node counts are taken in the order given, equal ones too") {
  CHECK(balance({"--nodes=64,1,64,1024"}).node_counts == Counts{64, 1, 64, 1024});
}

TEST_CASE("the options of the study of caches are taken") {
  const auto cache = [](std::initializer_list<std::string> more) { return std::get<CacheStudy>(study("cache", more).study); };
  CHECK(cache({}).node_count == 32);
  CHECK(cache({}).cache_pages.empty());
  CHECK_FALSE(cache({}).machine);
  const CacheStudy taken = cache({"--nodes=5", "--cache-pages=204,1", "--machine=ipsc2"});
  CHECK(taken.node_count == 5);
  CHECK(taken.cache_pages == Counts{204, 1});
  CHECK(taken.machine->name == "ipsc2");
  CHECK_THROWS_AS(cache({"--machine=abacus"}), core::InputError);
}

TEST_CASE("frames are studied on one machine, or several that have names, by more than a node") {
  const auto frames = [](std::initializer_list<std::string> more) {
    return std::get<apps::FramesStudy>(study("frames", more).study);
  };
  CHECK(frames({}).machines.size() == 1);
  CHECK(frames({}).machines.front().name == "ipsc2");
  CHECK(frames({"--machine=hdr"}).machines.front().name == "hdr");
  const apps::FramesStudy several = frames({"--machines=hdr,paragon", "--nodes=16,64"});
  REQUIRE(several.machines.size() == 2);
  CHECK(several.machines.back().name == "paragon");
  CHECK(several.node_counts == Counts{16, 64});
}

TEST_CASE("the study of speedup runs svm on the ipsc2 with the default pixels in flight, unless told otherwise") {
  const SpeedupStudy standard = speedup();
  CHECK(standard.node_counts == Counts{1, 2, 4, 8, 16, 32, 64});
  CHECK(standard.run.strategy == Strategy::svm);
  CHECK(standard.run.computer.machine.value().name == "ipsc2");
  CHECK_FALSE(standard.run.computer.node_memory_bytes);
  CHECK_FALSE(standard.run.pages.in_flight);
}

TEST_CASE("the options of the study of speedup are those of a run") {
  const SpeedupStudy pages = speedup({"--nodes=1,4096", "--strategy=svm", "--node-memory=4MiB", "--cache-pages=9",
                                      "--replacement=fifo", "--in-flight=3", "--work-item=0", "--machine=paragon"});
  CHECK(pages.node_counts == Counts{1, 4096});
  CHECK(pages.run.computer.node_memory_bytes == std::size_t{4} << 20U);
  CHECK(pages.run.pages.cache_pages == 9);
  CHECK(pages.run.pages.replacement == svm::Replacement::fifo);
  CHECK(pages.run.pages.in_flight == 3);
  CHECK(pages.run.pages.work_item_side == 0);
  CHECK(pages.run.computer.machine.value().name == "paragon");
  const SpeedupStudy rays = speedup({"--strategy=dataflow", "--nodes=1024", "--balance=equal-size", "--ray-batch=3",
                                     "--ray-credits=2", "--ray-queue=7", "--machine=hdr"});
  CHECK(rays.run.strategy == Strategy::dataflow);
  CHECK(rays.run.rays.balance.balance == dataflow::Balance::equal_size);
  CHECK(rays.run.rays.ray_batch == 3);
  CHECK(rays.run.rays.ray_credits == 2);
  CHECK(rays.run.rays.queue_packets == 7);
  CHECK(rays.run.rays.topology == nodes::TopologyKind::fat_tree);
  CHECK(speedup({"--strategy=replicated", "--in-flight=2"}).run.strategy == Strategy::replicated);
}

TEST_CASE("the help of the study of speedup tells its own defaults") {
  const std::string text = parse_command_line(std::vector<std::string>{"study", "speedup", "--help"}).options<HelpText>().text;
  CHECK(text.find("--in-flight 1..4096 [1]") != std::string::npos);
  CHECK(text.find("[a quarter of the database") != std::string::npos);
  CHECK(text.find("replicated 1") == std::string::npos);
}

TEST_CASE("a study in Python gets the options of the line as words, and its scene") {
  const auto words_of = [](std::initializer_list<std::string> words) {
    return parse_command_line(std::vector<std::string>(words)).options<PythonStudy>().words;
  };
  CHECK(words_of({"study", "systems", "balls-1"}) == std::vector<std::string>{"--resolution=128x128", "balls-1"});
  CHECK(words_of({"study", "systems", "--search", "--node-memory", "rays,25%", "--resolution=8x8", "balls-1", "-o", "a.md"}) ==
        std::vector<std::string>{"--node-memory=rays,25%", "--search", "--resolution=8x8", "--output=a.md", "balls-1"});
  CHECK(words_of({"study", "decades", "--quick", "-o", "out"}) == std::vector<std::string>{"--output=out", "--quick"});
  CHECK_THROWS_AS(words_of({"study", "systems", "balls-1", "--machine=abacus"}), core::InputError);
}

}  // namespace dmpc::apps::study_options_test
