// Who stands on whom: core <- nodes <- {svm, dataflow} <- apps <- tests, and within core and apps room upon room; which file
// alone names a foreign library; and that no layer but the edge knows the command line.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/style/sources.h"

namespace dmpc::tests {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// The folders whose headers each folder may include.
const std::map<std::string, Names> stands_on = {
    {"core", {"core"}},
    {"nodes", {"nodes", "core"}},
    {"svm", {"svm", "nodes", "core"}},
    {"dataflow", {"dataflow", "nodes", "core"}},
    {"apps", {"apps", "svm", "dataflow", "nodes", "core"}},
    {"tests", {"tests", "apps", "svm", "dataflow", "nodes", "core"}},
};

/// Rooms from the ground up: each uses those that stand before it. What lies on the floor of the layer itself uses all.
const std::map<std::string, Names> rooms = {
    {"core", {"base", "record", "scene", "build", "trace", "picture", "families"}},
    {"apps", {"line",    "system", "ranks",   "figures", "reader", "picture", "formats",  "scene",    "table",
              "machine", "oracle", "run",     "effort",  "help",   "show",    "computer", "examples", "render",
              "info",    "check",  "compare", "study",   "bench",  "modules", "foreign",  "manual"}},
};

/// Rooms of other layers, and the files of their floor, by how they begin, that look down into them.
const std::map<std::string, Names> looked_into_by = {
    {"nodes/threads", {"nodes/runner.cpp"}},
    {"nodes/ranks", {"nodes/runner."}},
    {"nodes/virtual", {"nodes/runner."}},
    {"nodes/watch", {}},
    {"svm/watch", {"svm/run.", "svm/run_tasks.", "svm/ranks.", "svm/plan.", "svm/make_programs."}},
    {"dataflow/regions", {"dataflow/"}},
};

/// What begins so may be included by files that begin so, and by no others.
struct Foreign {
  std::string_view header;
  Names files;
};
const std::vector<Foreign> foreign = {
    {"embree", {"apps/oracle/embree.h"}},
    {"OpenImageIO/",
     {"apps/modules/pictures.cpp", "apps/foreign/picture_decoder.cpp", "tests/apps/modules/", "tests/fuzz/picture.cpp"}},
    {"OpenEXR/", {"apps/picture/exr_file.cpp"}},
    {"mpi.h", {"apps/modules/mpi.cpp"}},
    {"gmpxx.h", {"apps/oracle/exact.cpp"}},
    {"png.h", {"apps/picture/png_file.cpp"}},
    {"dlfcn.h", {"apps/system/module.cpp", "tests/failing_allocation/", "tests/foreign_arithmetic/"}},
    {"assimp/", {"apps/foreign/", "tests/apps/foreign/"}},
    {"meshoptimizer.h", {"apps/foreign/gltf/meshopt.cpp", "tests/apps/foreign/"}},
    {"draco/", {"apps/foreign/gltf/draco.cpp", "tests/apps/foreign/"}},
    {"seccomp.h", {"apps/foreign/sandbox.cpp", "tests/apps/reader/foreign_files_test.cpp"}},
    {"CLI/", {"apps/line/command_line.cpp", "apps/line/command_description.cpp"}},
    {"nlohmann/",
     {"apps/show/stats/", "apps/machine/machine_file.", "apps/table/table.cpp", "apps/compare/report.cpp", "apps/figures/",
      "apps/oracle/accurate/reference_file.cpp", "apps/foreign/gltf/", "apps/info/json.cpp", "apps/computer/stats.cpp",
      "apps/formats/landscape/gltf.cpp", "apps/study/scale/figures.cpp", "apps/show/trace/chrome.cpp", "tests/apps/",
      "tests/mpi/launched/"}},
    {"oneapi/",
     {"apps/check/inspection.cpp", "apps/system/side_by_side.cpp", "apps/oracle/accurate/picture.cpp",
      "tests/apps/oracle/accurate/"}},
    {"tbb/",
     {"core/base/parallel.cpp", "apps/check/inspection.cpp", "apps/system/side_by_side.cpp", "apps/oracle/accurate/picture.cpp",
      "tests/apps/oracle/accurate/", "tests/bench/rivals.h"}},
    {"benchmark/", {"tests/bench/"}},
    {"boost/", {"tests/bench/rivals.h"}},
    {"concurrentqueue/", {"tests/bench/rivals.h"}},
    {"hwy/", {"core/trace/bundle_steps.cpp", "core/trace/bundle_intersectors.cpp", "core/trace/kernel.cpp"}},
    {"doctest/", {"tests/"}},
    // Threads are the computer's; the edge has one that waits for signals, one that sends to a viewer, those on which rays are
    // timed, some to see whether a library can have as many, and runs side by side that share their progress.
    {"thread",
     {"nodes/", "tests/", "apps/system/interrupt.", "apps/render/preview.", "apps/bench/speed/crew.", "apps/system/module.cpp"}},
    {"atomic",
     {"nodes/", "tests/", "apps/system/interrupt.", "apps/system/last_words.", "apps/render/preview.",
      "apps/bench/speed/plain_renderer."}},
    {"mutex",
     {"nodes/", "tests/", "apps/render/preview.", "apps/study/runs.cpp", "apps/study/references/command.cpp",
      "core/base/parallel.cpp"}},
    {"shared_mutex", {"nodes/", "tests/"}},
    {"condition_variable", {"nodes/", "tests/", "apps/render/preview."}},
    {"future", {"nodes/", "tests/"}},
    {"semaphore", {"nodes/", "tests/"}},
    {"latch", {"nodes/", "tests/", "apps/system/module.cpp"}},
    {"barrier", {"nodes/", "tests/"}},
    {"pthread.h", {"nodes/", "tests/", "apps/system/interrupt."}},
};

bool begins_with(std::string_view text, std::string_view beginning) { return text.substr(0, beginning.size()) == beginning; }

std::string first_folder(std::string_view path) { return std::string(path.substr(0, path.find('/'))); }

/// A word of `foreign` ending in a slash, or embree's numbered folder, is a beginning; any other is a whole header.
bool is_header_of(std::string_view header, const Foreign& rule) {
  return rule.header.back() == '/' || rule.header == "embree" ? begins_with(header, rule.header) : header == rule.header;
}

bool may_include_foreign(std::string_view file, std::string_view header) {
  return std::all_of(foreign.begin(), foreign.end(), [&](const Foreign& rule) {
    return !is_header_of(header, rule) || std::any_of(rule.files.begin(), rule.files.end(),
                                                      [&](const std::string& allowed) { return begins_with(file, allowed); });
  });
}

/// "build" of "core/build/cutter.h", empty of "apps/main.cpp".
std::string room_of(std::string_view path) {
  const std::size_t first = path.find('/'), second = path.find('/', first + 1);
  return second == std::string_view::npos ? std::string() : std::string(path.substr(first + 1, second - first - 1));
}

std::size_t height(const std::string& layer, const std::string& room) {
  const Names& names = rooms.at(layer);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), room) - names.begin());
}

/// Of two files of one layer.
bool may_look_into(std::string_view file, std::string_view header) {
  const std::string layer = first_folder(header), room = room_of(header), own = room_of(file);
  if (room == own) {
    return true;
  }
  if (rooms.contains(layer)) {
    const bool is_program = file.ends_with("main.cpp");
    return own.empty() || is_program || (!room.empty() && height(layer, room) < height(layer, own));
  }
  const auto onlookers = looked_into_by.find(layer + "/" + room);
  return !own.empty() || onlookers == looked_into_by.end() ||
         std::any_of(onlookers->second.begin(), onlookers->second.end(),
                     [&](const std::string& beginning) { return begins_with(file, beginning); });
}

/// The computer takes of ray tracing what has nothing to do with it.
bool is_too_much_for_nodes(std::string_view file, std::string_view header) {
  return first_folder(file) == "nodes" && first_folder(header) == "core" && room_of(header) != "base";
}

bool may_include(std::string_view file, std::string_view header) {
  const std::string folder = first_folder(header);
  if (is_too_much_for_nodes(file, header)) {
    return false;
  }
  if (folder == first_folder(file) && folder != "tests") {
    return may_look_into(file, header);
  }
  if (header.find('/') == std::string_view::npos || !stands_on.contains(folder)) {
    return may_include_foreign(file, header);
  }
  const Names& allowed = stands_on.at(first_folder(file));
  return std::find(allowed.begin(), allowed.end(), folder) != allowed.end();
}

/// What `line` includes in quotes or angle brackets; empty if it is no include.
std::string_view included_header(std::string_view line) {
  for (const std::string_view word : {"#", "include"}) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!begins_with(line, word)) {
      return {};
    }
    line.remove_prefix(word.size());
  }
  const std::size_t first = line.find_first_of("\"<");
  const std::size_t last = line.find_last_of("\">");
  return first < last && last != std::string_view::npos ? line.substr(first + 1, last - first - 1) : std::string_view();
}

/// "file:line: header" for each include that is not allowed. `file` is relative to the project's root.
Names violations(const std::string& file, std::istream& text) {
  Names found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    const std::string_view header = included_header(line);
    if (!header.empty() && !may_include(file, header)) {
      found.push_back(file + ":" + std::to_string(number) + ": " + std::string(header));
    }
  }
  return found;
}

Names violations_in(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  return violations(file, stream);
}

/// Whether what `text` includes first is the header of the same name: so that compiles alone.
bool begins_with_own_header(const std::string& file, std::istream& text) {
  std::string line;
  while (std::getline(text, line)) {
    const std::string_view header = included_header(line);
    if (!header.empty()) {
      return header == fs::path(file).replace_extension(".h").generic_string();
    }
  }
  return false;
}

/// All sources, relative to the root.
Names source_files(const fs::path& root) {
  Names files;
  for (const auto& [folder, unused] : stands_on) {
    const Names below = sources_below(root, folder);
    files.insert(files.end(), below.begin(), below.end());
  }
  return files;
}

}  // namespace

TEST_CASE("every include goes downwards and every foreign library has its one file") {
  const fs::path root = DMPC_SOURCE_DIR;
  const Names files = source_files(root);
  CHECK(files.size() > 50);
  for (const std::string& file : files) {
    std::ifstream text(root / file);
    for (const std::string& violation : violations(file, text)) {
      FAIL_CHECK(violation);
    }
  }
}

TEST_CASE("a header compiles alone, since its own source includes it before any other") {
  const fs::path root = DMPC_SOURCE_DIR;
  for (const std::string& file : source_files(root)) {
    if (fs::path(file).extension() == ".cpp" && fs::exists((root / file).replace_extension(".h"))) {
      CAPTURE(file);
      std::ifstream text(root / file);
      CHECK(begins_with_own_header(file, text));
    }
  }
  std::istringstream late("// A film.\n#include <vector>\n#include \"core/picture/film.h\"\n"), never("int x;\n");
  CHECK_FALSE(begins_with_own_header("core/picture/film.cpp", late));
  CHECK_FALSE(begins_with_own_header("core/picture/film.cpp", never));
}

TEST_CASE("an upward include is found, with file and line") {
  CHECK(violations_in("core/record/ray.h", "\n#include \"nodes/node.h\"\n") == Names{"core/record/ray.h:2: nodes/node.h"});
  CHECK(violations_in("core/record/ray.h", "#include <svm/page.h>") == Names{"core/record/ray.h:1: svm/page.h"});
  CHECK(violations_in("nodes/node.h", "  #  include \"apps/commands.h\"").size() == 1);
  CHECK(violations_in("svm/run.cpp", "#include \"tests/support/small_machine.h\"").size() == 1);
}

TEST_CASE("nodes uses of core nothing but its base") {
  CHECK(violations_in("nodes/charge.h", "\n#include \"core/trace/operations.h\"\n") ==
        Names{"nodes/charge.h:2: core/trace/operations.h"});
  CHECK(violations_in("nodes/watch/heat_map.cpp", "#include \"core/picture/heat_kind.h\"").size() == 1);
  CHECK(violations_in("nodes/node.h", "#include \"core/base/expect.h\"").empty());
  CHECK(violations_in("svm/pager.h", "#include \"core/picture/memory_use.h\"").empty());
}

TEST_CASE("a room uses only those below it") {
  CHECK(violations_in("core/base/vec.h", "#include \"core/scene/scene.h\"").size() == 1);
  CHECK(violations_in("apps/line/words.cpp", "#include \"apps/study/runs.h\"").size() == 1);
  CHECK(violations_in("apps/line/words.cpp", "#include \"apps/commands.h\"").size() == 1);
  CHECK(violations_in("nodes/node.h", "#include \"nodes/watch/trace.h\"").size() == 1);
  CHECK(violations_in("svm/pager.h", "#include \"svm/watch/miss_curve.h\"").size() == 1);
  CHECK(
      violations_in("apps/bench/speed/part.h", "#include \"apps/line/words.h\"\n#include \"apps/bench/speed/table.h\"").empty());
  CHECK(violations_in("apps/main.cpp", "#include \"apps/study/runs.h\"").empty());
  CHECK(violations_in("nodes/runner.cpp", "#include \"nodes/threads/clock.h\"").empty());
}

TEST_CASE("every room has its place in the house") {
  std::map<std::string, std::set<std::string>> found;
  for (const std::string& file : source_files(fs::path(DMPC_SOURCE_DIR))) {
    if (rooms.contains(first_folder(file)) && !room_of(file).empty()) {
      found[first_folder(file)].insert(room_of(file));
    }
  }
  for (const auto& [layer, names] : rooms) {
    CHECK(found[layer] == std::set<std::string>(names.begin(), names.end()));
  }
}

TEST_CASE("no layer below the edge speaks of the command line's options") {
  const std::regex option("\"[^\"]*--[a-z]");
  CHECK(std::regex_search(std::string("throw core::UsageError(\"--nodes=0\");"), option));
  const fs::path root = DMPC_SOURCE_DIR;
  for (const std::string& file : source_files(root)) {
    const std::string layer = first_folder(file);
    std::ifstream text(root / file);
    for (std::string line; layer != "apps" && layer != "tests" && std::getline(text, line);) {
      INFO(file << ": " << line);
      CHECK_FALSE(std::regex_search(line, option));
    }
  }
}

TEST_CASE("the two families never meet") {
  CHECK(violations_in("svm/run.cpp", "#include \"dataflow/region.h\"").size() == 1);
  CHECK(violations_in("dataflow/host.h", "#include \"svm/page.h\"").size() == 1);
}

TEST_CASE("a foreign header outside its file is found") {
  CHECK(violations_in("apps/check/command.cpp", "#include <embree3/rtcore.h>").size() == 1);
  CHECK(violations_in("apps/render/command.cpp", "#include <OpenImageIO/imageio.h>").size() == 1);
  CHECK(violations_in("apps/picture/image_file.cpp", "#include <OpenImageIO/imageio.h>").size() == 1);
  CHECK(violations_in("apps/commands.h", "#include <CLI/CLI.hpp>").size() == 1);
  CHECK(violations_in("apps/scene/load_scene.cpp", "#include <assimp/scene.h>").size() == 1);
  CHECK(violations_in("apps/main.cpp", "#include \"nlohmann/json.hpp\"").size() == 1);
  CHECK(violations_in("core/build/database.cpp", "#include <tbb/parallel_for.h>").size() == 1);
  CHECK(violations_in("core/trace/walk.h", "#include <hwy/highway.h>").size() == 1);
  CHECK(violations_in("core/picture/film.h", "#include <doctest/doctest.h>").size() == 1);
}

TEST_CASE("threads and atomics outside the computer are found") {
  CHECK(violations_in("core/picture/film.cpp", "#include <atomic>").size() == 1);
  CHECK(violations_in("svm/pager.h", "#include <thread>").size() == 1);
  CHECK(violations_in("apps/render/command.cpp", "#include <mutex>").size() == 1);
}

TEST_CASE("what is allowed is not found") {
  CHECK(violations_in("svm/run.cpp", "#include \"core/picture/film.h\"\n#include <nodes/node.h>\n#include <vector>\n").empty());
  CHECK(violations_in("apps/oracle/embree.h", "#include <embree3/rtcore.h>\n#include <embree4/rtcore.h>").empty());
  CHECK(violations_in("nodes/mailbox.h", "#include <atomic>").empty());
  CHECK(violations_in("tests/nodes/x_test.cpp", "#include <thread>\n#include \"nodes/node.h\"").empty());
  CHECK(violations_in("core/picture/film.cpp", "// #include of nothing\n#include <sys/stat.h>").empty());
}

}  // namespace dmpc::tests
