// The program as its user meets it: exit statuses, messages, files.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/picture/image_file.h"
#include "tests/support/child_process.h"
#include "tests/support/hostile_files.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::program_program_test {

namespace {

std::vector<std::string> dmpc(const std::vector<std::string>& arguments) { return together({{DMPC_PROGRAM}, arguments}); }

/// Waits until `done` says so, twenty seconds at most; whether it did.
template <class Done>
bool until(const Done& done) {
  for (int tries = 0; tries < 4000; ++tries) {
    if (done()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// The value of the first figure with this name.
std::string value_of(const std::string& json, const std::string& name) {
  const std::size_t begin = json.find("\"" + name + "\":");
  REQUIRE(begin != std::string::npos);
  const std::size_t number = json.find_first_of("0123456789", begin + name.size() + 3);
  return json.substr(number, json.find_first_not_of("0123456789", number) - number);
}

/// The cell of a table's only row.
std::string cell_of(const std::string& csv, const std::string& column) {
  std::istringstream lines(csv);
  std::string names, cells;
  std::getline(lines, names);
  std::getline(lines, cells);
  std::istringstream name_stream(names), cell_stream(cells);
  for (std::string name, cell; std::getline(name_stream, name, ',') && std::getline(cell_stream, cell, ',');) {
    if (name == column) {
      return cell;
    }
  }
  return "no column " + column;
}

std::string film_hash(const std::string& stats_file) {
  const std::string json = file_text(stats_file);
  return json.substr(json.find("\"film_hash\""), 32);
}

/// Up to the next comma, space or line end.
std::string word_after(const std::string& text, const std::string& words) {
  const std::size_t begin = text.find(words);
  REQUIRE(begin != std::string::npos);
  const std::string rest = text.substr(begin + words.size());
  return rest.substr(0, rest.find_first_of(", \n"));
}

constexpr const char* view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\n";

}  // namespace

TEST_CASE("render writes a picture and counters, and says what it did") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr", stats = folder / "a.json";
  const Said result = run_dmpc({"render", "tetra-3", "--resolution=16x16", "--nodes=3", "-o", image, "--stats", stats});
  CHECK(result.status == 0);
  CHECK(result.errors.empty());
  CHECK(contains(result.output, "3 nodes"));
  CHECK(apps::read_image(image).width == 16);
  CHECK(contains(file_text(stats), "\"film_hash\""));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("heat maps stand beside the picture, or nothing does") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr", heat = folder / "rays.png",
                    faults = "--heatmap=faults:" + (folder / "f.exr").string();
  const auto render = [&](const std::vector<std::string>& more) {
    return run_dmpc(together({{"render", "tetra-3", "--resolution=16x16", "--nodes=3", "-o", image}, more}));
  };
  CHECK(render({"--heatmap=rays:" + image}).status == 2);
  CHECK(render({faults, faults}).status == 2);
  CHECK(render({faults, "--strategy=dataflow"}).status == 2);
  CHECK(render({"--heatmap=rays:" + (folder / "none" / "a.png").string()}).status == 1);
  CHECK(folder.entry_count() == 0);
  CHECK(render({"--heatmap=rays:" + heat, faults}).status == 0);
  CHECK(folder.entry_count() == 3);
  CHECK(apps::read_image(folder / "f.exr").width == 16);
}

TEST_CASE("layers stand beside the picture or in its file, frame by frame, and the picture and its run stay as they are") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr", stats = folder / "a.json";
  const auto render = [&](const std::vector<std::string>& more) {
    return run_dmpc(together(
        {{"render", "teapot-2", "--resolution=16x12", "--nodes=3", "--samples=2", "--stats=" + stats, "-o", image}, more}));
  };
  for (const std::string strategy : {"svm", "dataflow"}) {
    const std::vector<std::string> modelled = {"--strategy=" + strategy, "--runner=virtual"};
    REQUIRE(render(modelled).status == 0);
    const std::string hash = film_hash(stats), run = word_after(file_text(stats), "\"run_hash\": ");
    const std::vector<float> light = apps::read_image(image).rgb;
    REQUIRE(render(together({modelled, {"--aov=albedo,normal,id", "--aov=depth:" + (folder / "d.png").string()}})).status == 0);
    CHECK(film_hash(stats) == hash);
    CHECK(word_after(file_text(stats), "\"run_hash\": ") == run);
    CHECK(apps::read_image(image).rgb == light);
    CHECK(contains(file_text(image), "normal.X"));
  }
  CHECK(apps::read_image(folder / "d.png").width == 16);
  CHECK(render({"--aov=albedo:" + image}).status == 2);
  REQUIRE(run_dmpc({"render", "teapot-2", "--resolution=16x12", "--nodes=3", "--frames=2", "--turntable=90", "-o",
                    folder / "#.exr", "--aov=id:" + (folder / "id#.exr").string()})
              .status == 0);
  CHECK(file_text(folder / "id1.exr") != file_text(folder / "id2.exr"));
}

TEST_CASE("a trace stands beside the picture, or nothing does, and says that it lost nothing") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.png", trace = folder / "a.pftrace";
  const auto render = [&](const std::string& file) {
    return run_dmpc({"render", "tetra-1", "--resolution=4x4", "--nodes=2", "--trace=" + file, "-o", image});
  };
  CHECK(render(image).status == 2);
  const auto other = render(folder / "a.json.gz");
  CHECK(other.status == 2);
  CHECK(contains(other.errors,
                 "ending .pftrace, such as a.pftrace, which ui.perfetto.dev shows; Perfetto's own converter makes "
                 "JSON of it: traceconv json a.pftrace a.json; gzip packs it"));
  CHECK(render(folder / "none" / "a.pftrace").status == 1);
  CHECK(folder.entry_count() == 0);
  CHECK(render(trace).errors.empty());
  CHECK(contains(file_text(trace), "nothing"));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("what references that a render writes tell of a cache is what the run faulted, for each policy") {
  const TemporaryFolder folder;
  const std::string references = folder / "references.csv", stats = folder / "stats.json", table = folder / "table.csv";
  const std::vector<std::string> policies = {"lru", "fifo", "arc"};
  for (const std::string& policy : policies) {
    const Said rendered = run_dmpc({"render", "balls-2", "--resolution=32x32", "--nodes=3", "--page-size=512", "--cache-pages=4",
                                    "--work-item=0", "--in-flight=1", "--replacement=" + policy, "--references=" + references,
                                    "--stats=" + stats, "-o", folder / "a.png"});
    REQUIRE_MESSAGE(rendered.status == 0, rendered.errors);
    REQUIRE(run_dmpc({"study", "references", references, "--cache-pages=4", "--format=csv", "-o", table}).status == 0);
    const std::string faults = value_of(file_text(stats), "faults");
    CHECK(std::stoul(faults) > 100);
    CHECK(cell_of(file_text(table), "faults " + policy) == faults);
  }
}

TEST_CASE("a quiet render says nothing") {
  const TemporaryFolder folder;
  const Said result = run_dmpc({"render", "tetra-1", "--resolution=4x4", "--quiet", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(result.output.empty());
  CHECK(result.errors.empty());
}

TEST_CASE("Embree and our grid write the same picture") {
  const TemporaryFolder folder;
  for (const std::string tracer : {"grid", "embree"}) {
    REQUIRE(run_dmpc({"render", "balls-2", "--resolution=24x24", "--strategy=replicated", "--tracer=" + tracer, "--quiet", "-o",
                      folder / (tracer + ".exr")})
                .status == 0);
  }
  const Said result = run_dmpc({"compare", folder / "grid.exr", folder / "embree.exr"});
  CHECK(result.status == 0);
  CHECK(contains(result.output, "differing pixels        0 of 576"));
}

TEST_CASE("no strategy and no option of dataflow changes the film") {
  const TemporaryFolder folder;
  std::set<std::string> hashes;
  for (const std::vector<std::string>& more : {std::vector<std::string>{"svm"},
                                               {"replicated"},
                                               {"dataflow"},
                                               {"dataflow", "--nodes=1"},
                                               {"dataflow", "--nodes=13", "--balance=equal-size"},
                                               {"dataflow", "--ray-batch=1"},
                                               {"dataflow", "--ray-credits=0", "--chaos=3"},
                                               {"dataflow", "--cuts=alternating", "--no-skip=empty-regions"},
                                               {"dataflow", "--nodes=3", "--node-memory=304KiB", "--page-size=512B"}}) {
    const std::vector<std::string> outputs = {"--stats", folder / "a.json", "-o", folder / "a.exr"};
    CHECK(run_dmpc(together({{"render", "balls-1", "--resolution=16x16"}, outputs, {"--strategy"}, more})).status == 0);
    hashes.insert(film_hash(folder / "a.json"));
  }
  CHECK(hashes.size() == 1);
}

TEST_CASE("a modelled machine renders the threads' film, twice by the same events") {
  const TemporaryFolder folder;
  const std::string stats = folder / "a.json";
  const auto counters = [&](const std::vector<std::string>& more) {
    const std::vector<std::string> outputs = {"--stats", stats, "-o", folder / "a.exr"};
    REQUIRE(run_dmpc(together({{"render", "balls-2", "--resolution=24x24", "--nodes=5"}, outputs, more})).status == 0);
    return file_text(stats);
  };
  const auto after = [](const std::string& text, const std::string& key) { return word_after(text, "\"" + key + "\": "); };
  const std::string film = after(counters({}), "film_hash");
  const std::vector<std::string> modelled = {"--strategy=svm", "--runner=virtual", "--machine=cm5"};
  const std::string first = counters(modelled), second = counters(modelled);
  CHECK(after(first, "film_hash") == film);
  CHECK(after(first, "run_hash") != "null");
  CHECK(after(first, "run_hash") == after(second, "run_hash"));
  CHECK(after(first, "events") == after(second, "events"));
}

TEST_CASE("a machine that was printed is read again: the same run as by its name") {
  const TemporaryFolder folder;
  const Said printed = run_dmpc({"machine", "paragon"});
  CHECK(printed.status == 0);
  write_text(folder / "mine.json", printed.output);
  CHECK(run_dmpc({"machine", folder / "mine.json"}).output == printed.output);
  std::set<std::string> hashes;
  for (const std::string& machine : {std::string("paragon"), (folder / "mine.json").string()}) {
    const Said result = run_dmpc(
        {"render", "tetra-2", "--resolution=8x8", "--nodes=3", "--runner=virtual", "--machine", machine, "-o", folder / "a.exr"});
    CHECK(result.status == 0);
    CHECK(contains(result.output, " s on paragon, "));
    hashes.insert(word_after(result.output, " events; run_hash "));
  }
  CHECK(hashes.size() == 1);
}

TEST_CASE("a bad machine file ends with status 1, its name, the key and what was expected, before rendering") {
  const TemporaryFolder folder;
  write_text(folder / "bad.json", "{\"name\": 3}");
  const Said result =
      run_dmpc({"render", "tetra-1", "--runner=virtual", "--machine", folder / "bad.json", "-o", folder / "a.png"});
  CHECK(result.status == 1);
  CHECK(contains(result.errors, (folder / "bad.json").string() + ": topology: this key is missing"));
  CHECK(run_dmpc({"machine", "abacus"}).status == 1);
  CHECK(run_dmpc({"render", "tetra-1", "--runner=virtual", "--machine=abacus", "-o", folder / "a.png"}).status == 1);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a page is written beside the picture, or neither is") {
  const TemporaryFolder folder;
  const std::string page = folder / "a.html";
  const Said result = run_dmpc({"render", "tetra-1", "--resolution=8x8", "--report", page, "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(contains(file_text(page), "Render of tetra-1"));
  CHECK(run_dmpc({"render", "tetra-1", "--report", folder / "no/a.html", "-o", folder / "b.png"}).status == 1);
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("no output may fall on the machine file") {
  const TemporaryFolder folder;
  const std::string machine = folder / "mine.json";
  write_text(machine, run_dmpc({"machine", "hdr"}).output);
  const std::string before = file_text(machine);
  const Said result =
      run_dmpc({"render", "tetra-1", "--runner=virtual", "--machine", machine, "--stats", machine, "-o", folder / "a.png"});
  CHECK(result.status == 2);
  CHECK(contains(result.errors, "this is the same file as --machine "));
  CHECK(file_text(machine) == before);
}

TEST_CASE("bad input ends with status 1, a reason, and nothing written") {
  const TemporaryFolder folder;
  write_text(folder / "bad.nff", std::string(view) + "q 1 2 3\n");
  write_text(folder / "cut.nff", std::string(view) + "s 0 0\n");
  write_text(folder / "empty.nff", "");
  const std::size_t before = folder.entry_count();
  for (const std::string scene : {"bad.nff", "cut.nff", "empty.nff", "missing.nff", ""}) {
    CAPTURE(scene);
    const Said result = run_dmpc({"render", folder / scene, "-o", folder / "a.png"});
    CHECK(result.status == 1);
    CHECK(contains(result.errors, (folder / scene).string()));
    CHECK(result.output.empty());
  }
  CHECK(contains(run_dmpc({"render", folder / "bad.nff", "-o", folder / "a.png"}).errors, "bad.nff:8: "));
  CHECK(run_dmpc({"render", "nonsense-3", "-o", folder / "a.png"}).status == 1);
  CHECK(run_dmpc({"render", "tetra-1", "-o", folder / "a.nonsense"}).status == 1);
  CHECK(run_dmpc({"render", "tetra-1", "--stats", folder / "no/a.json", "-o", folder / "a.png"}).status == 1);
  CHECK(run_dmpc({"compare", folder / "bad.nff", folder / "bad.nff"}).status == 1);
  CHECK(folder.entry_count() == before);
}

TEST_CASE("too little memory ends with status 4 before rendering and names what works") {
  const TemporaryFolder folder;
  const Said result = run_dmpc({"render", "tetra-5", "--node-memory=1KiB", "-o", folder / "a.png"});
  CHECK(result.status == 4);
  CHECK(contains(result.errors, "the smallest that works is --node-memory="));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a scene that does not fit the nodes of dataflow ends with status 4 and says what would do, which is true") {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& nodes, const std::string& memory) {
    return run_dmpc({"render", "tetra-6", "--strategy=dataflow", "--resolution=32x32", "--nodes=" + nodes,
                     "--node-memory=" + memory, "-o", folder / "a.png"});
  };
  const Said result = render("2", "400KiB");
  CHECK(result.status == 4);
  CHECK(contains(result.errors, "--node-memory=400KiB is too small for --nodes=2: node "));
  CHECK(contains(result.errors, " needs at least "));
  CHECK(folder.entry_count() == 0);
  const std::string memory = word_after(result.errors, "the smallest that works is --node-memory=");
  CHECK(render("2", memory).status == 0);
  CHECK(render("2", std::to_string(std::stoul(memory) - 1)).status == 4);
  CHECK(render(word_after(result.errors, "or with this memory --nodes="), "400KiB").status == 0);
}

TEST_CASE("what dataflow reduces to fit the memory is said before") {
  const TemporaryFolder folder;
  const Said result = run_dmpc({"render", "balls-1", "--strategy=dataflow", "--nodes=8", "--resolution=8x8",
                                "--node-memory=330KiB", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(contains(result.errors, " reduced from "));
  CHECK(contains(result.errors, " to fit 330KiB"));
}

TEST_CASE("a machine whose prices are for another structure than the picture's is said, once") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& machine, const std::string& structure) {
    const Said result = run_dmpc({"render", "balls-1", "--runner=virtual", "--nodes=2", "--resolution=8x8",
                                  "--machine=" + machine, "--structure=" + structure, "-o", folder / "a.png"});
    CHECK(result.status == 0);
    return count(result.errors, " has prices for other structures (");
  };
  CHECK(said("ipsc2", "grid") == 0);
  CHECK(said("ipsc2", "voxels") == 1);
  CHECK(said("ipsc2-1994", "voxels") == 0);
  CHECK(said("ipsc2-1994", "extents") == 1);
}

TEST_CASE("wrong usage ends with status 2 and a hint") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"paint"}, {"render"}, {"machine"}, {"render", "tetra-1", "-o", "a.png", "--ray-batch=2"}}) {
    const Said result = run_dmpc(arguments);
    CHECK(result.status == 2);
    CHECK(contains(result.errors, "--help"));
  }
}

TEST_CASE("help goes to the standard output with status 0") {
  const Said result = run_dmpc({"render", "--help=all"});
  CHECK(result.status == 0);
  CHECK(contains(result.output, "Examples:"));
  CHECK(result.errors.empty());
}

TEST_CASE("without a word dmpc says how to begin, in five lines") {
  const Said result = run_dmpc({});
  CHECK(result.status == 0);
  CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 5);
  CHECK(contains(result.output, "dmpc demo"));
}

TEST_CASE("the demonstration names its line, renders, and leaves nothing behind") {
  const Said result = run_dmpc({"demo"});
  CHECK(result.status == 0);
  CHECK(contains(result.errors, "this is dmpc render teapot-12 --nodes=8"));
  CHECK(contains(result.errors, "to be seen at http://127.0.0.1:"));
  CHECK(contains(result.output, "virtual  "));
  const std::size_t place = result.output.rfind("picture  ") + 9;
  CHECK_FALSE(std::filesystem::exists(result.output.substr(place, result.output.find(',', place) - place)));
}

TEST_CASE("degenerate primitives are left out and counted aloud") {
  const TemporaryFolder folder;
  write_text(folder / "flat.nff", std::string(view) + "s 0 0 0 1\ns 1 1 1 0\n");
  const Said result = run_dmpc({"render", folder / "flat.nff", "--quiet", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(contains(result.errors, "1 degenerate primitive was left out"));
  const Said check = run_dmpc({"check", folder / "flat.nff"});
  CHECK(check.status == 0);
  CHECK(contains(check.errors, "1 degenerate primitive was left out"));
}

TEST_CASE("an output that is another one or an input ends with status 2 and nothing changed") {
  const TemporaryFolder folder;
  const std::string keep = folder / "keep.nff", image = folder / "a.png";
  write_text(keep, std::string(view) + "s 0 0 0 1\n");
  write_text(image, "older");
  CHECK(run_dmpc({"render", keep, "-o", folder / "x.png", "--stats", keep}).status == 2);
  CHECK(run_dmpc({"render", "tetra-1", "-o", image, "--stats", image}).status == 2);
  CHECK(run_dmpc({"compare", image, folder / "b.png", "--difference", image}).status == 2);
  CHECK(file_text(image) == "older");
  CHECK(file_text(keep) == std::string(view) + "s 0 0 0 1\n");
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("counters may go to the standard output, before the closing lines") {
  const TemporaryFolder folder;
  const Said result = run_dmpc({"render", "tetra-1", "--resolution=4x4", "--stats=/dev/stdout", "-o", folder / "a.png"});
  CHECK(result.status == 0);
  CHECK(result.output.find("{") == 0);
  CHECK(result.output.find("film_hash") < result.output.find("picture  "));
  CHECK(contains(result.output, "picture  "));
}

TEST_CASE("counters that cannot be written end with status 1 before the render") {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "older");
  const Said result = run_dmpc({"render", "tetra-1", "--resolution=4x4", "--stats=/dev/full", "-o", folder / "a.png"});
  CHECK(result.status == 1);
  CHECK(contains(result.errors, "--stats /dev/full: this device takes nothing"));
  CHECK(result.output.empty());
  CHECK(file_text(folder / "a.png") == "older");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("lines that the standard output does not take end with status 1") {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr";
  REQUIRE(run_dmpc({"render", "tetra-1", "--resolution=4x4", "--quiet", "-o", image}).status == 0);
  const std::vector<std::vector<std::string>> commands = {{"render", "tetra-1", "--resolution=4x4", "-o", folder / "b.exr"},
                                                          {"check", "tetra-1", "--resolution=4x4"},
                                                          {"compare", image, image},
                                                          {"scene", "tetra-1"},
                                                          {"machine", "hdr"},
                                                          {"--help"}};
  for (const std::vector<std::string>& command : commands) {
    CAPTURE(command.front());
    ChildProcess process(dmpc(command), "/dev/full");
    CHECK(process.status() == 1);
    CHECK(contains(process.errors(), "could not be written to the standard output"));
  }
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("scene writes the same to a file as to the standard output") {
  const TemporaryFolder folder;
  const Said result = run_dmpc({"scene", "tetra-2"});
  CHECK(result.status == 0);
  CHECK(result.errors.empty());
  CHECK(contains(result.output, "\np 3\n"));
  CHECK(run_dmpc({"scene", "tetra-2", "-o", folder / "t.nff"}).status == 0);
  CHECK(file_text(folder / "t.nff") == result.output);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a written scene renders to the same picture as the built-in one") {
  const TemporaryFolder folder;
  REQUIRE(run_dmpc({"scene", "balls-1", "-o", folder / "b.nff"}).status == 0);
  for (const std::string& scene : {std::string("balls-1"), (folder / "b.nff").string()}) {
    REQUIRE(run_dmpc({"render", scene, "--resolution=16x16", "--quiet", "-o", folder / "a.exr", "--stats",
                      folder / (scene == "balls-1" ? "built_in.json" : "file.json")})
                .status == 0);
  }
  CHECK(film_hash(folder / "built_in.json") == film_hash(folder / "file.json"));
}

TEST_CASE("Ctrl-C and SIGTERM end a render with status 130, whatever it does and whoever does it, and leave an older picture") {
  const TemporaryFolder folder;
  const std::string heat = "--heatmap=time:" + (folder / "t.png").string(), trace = "--trace=" + (folder / "t.pftrace").string();
  write_text(folder / "a.png", "older");
  using Words = std::vector<std::string>;
  for (const auto& [words, signal] : {std::pair(Words{"--resolution=1024x1024", heat, trace}, SIGINT),
                                      {{"--resolution=1024x1024", heat, trace}, SIGTERM},
                                      {{"--strategy=dataflow", "--resolution=4096x4096"}, SIGINT},  // it balances
                                      {{"--strategy=dataflow", "--resolution=4096x4096"}, SIGTERM},
                                      {{"--strategy=dataflow", "--resolution=64x64"}, SIGINT},
                                      {{"--strategy=dataflow", "--resolution=64x64"}, SIGTERM},
                                      {{"--strategy=svm", "--runner=virtual", "--resolution=1024x1024"}, SIGINT},
                                      {{"--strategy=replicated", "--runner=virtual", "--resolution=1024x1024"}, SIGTERM},
                                      {{"--strategy=dataflow", "--runner=virtual", "--resolution=1024x1024"}, SIGINT}}) {
    ChildProcess process(dmpc(together({{"render", "balls-3", "--samples=32768", "-o", folder / "a.png"}, words})));
    REQUIRE(process.blocks(signal));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // so that it mostly renders already
    process.send(signal);
    CHECK(process.status() == 130);
    CHECK(contains(process.errors(), "interrupted, nothing was written"));
    CHECK(process.output().empty());
  }
  CHECK(file_text(folder / "a.png") == "older");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a signal while a scene is written to a file ends with status 130 and leaves nothing") {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM}) {
    ChildProcess process(dmpc({"scene", "tetra-12", "-o", folder / "t.nff"}));
    CHECK(until([&] { return folder.entry_count() > 0; }));
    process.send(signal);
    CHECK(process.status() == 130);
    CHECK(contains(process.errors(), "interrupted, nothing was written"));
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("a signal while a scene is written to the standard output ends with status 130 and says that it is incomplete") {
  ChildProcess process(dmpc({"scene", "tetra-12"}));
  CHECK(until([&] { return !process.output().empty(); }));
  process.send(SIGTERM);
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "interrupted, the output is incomplete"));
}

TEST_CASE("an abort that is sent ends dmpc by that signal") {
  ChildProcess process(dmpc({"scene", "tetra-12"}));
  CHECK(until([&] { return !process.output().empty(); }));
  process.send(SIGABRT);
  CHECK(process.status() == 1000 + SIGABRT);
}

/// The processes that are children of `parent`, as they were started.
std::vector<int> children_of(int parent) {
  const std::string id = std::to_string(parent);
  std::istringstream list(file_text("/proc/" + id + "/task/" + id + "/children"));
  return {std::istream_iterator<int>(list), {}};
}

/// 0 if there is none.
int child_of(int parent) {
  const std::vector<int> children = children_of(parent);
  return children.empty() ? 0 : children.front();
}

TEST_CASE("a signal while compare reads ends with status 130") {
  const TemporaryFolder folder;
  const std::string picture = folder / "a.png";
  apps::write_image(picture, apps::Image(8, 8));
  ChildProcess process(dmpc({"compare", picture, picture, "--difference", folder / "d.png"}));
  int reader = 0;
  REQUIRE(until([&] { return (reader = child_of(process.id())) != 0; }));
  ::kill(reader, SIGSTOP);  // it takes a fifth of a second to get ready, and now for ever
  process.send(SIGINT);
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "interrupted, nothing was written"));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a signal while textures are read ends with status 130 and leaves nothing, no process either") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "t.png"), checkpoint = folder / "c";
  apps::write_image(folder / "t.png", apps::Image(2048, 2048));  // so large that its reader is seen on a loaded machine, too
  ChildProcess process(dmpc({"render", scene, "--checkpoint=" + checkpoint, "-o", folder / "a.png"}));
  std::vector<int> readers;
  REQUIRE(until([&] { return (readers = children_of(process.id())).size() == 2; }));
  process.send(SIGINT);  // before the second one is ready
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "interrupted, nothing was written"));
  CHECK(folder.entry_count() == 3);
  const auto has_ended = [](int reader) { return file_text("/proc/" + std::to_string(reader) + "/cmdline").empty(); };
  CHECK(until([&] { return has_ended(readers.front()) && has_ended(readers.back()); }));
}

TEST_CASE("a signal while a render writes its counters ends with status 130, and the picture is there") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "stats";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);  // nobody reads, so that writing to it waits
  ChildProcess process(dmpc({"render", "tetra-1", "--resolution=4x4", "--stats", pipe, "-o", folder / "a.exr"}));
  CHECK(until([&] { return std::filesystem::exists(folder / "a.exr"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  process.send(SIGINT);
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "the picture was written, the other outputs are incomplete"));
  CHECK(apps::read_image(folder / "a.exr").width == 4);
  CHECK(folder.entry_count() == 2);
}

}  // namespace dmpc::tests::program_program_test
