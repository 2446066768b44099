// Who stands on whom: core <- nodes <- {svm, dataflow} <- apps <- tests, and which file alone names a foreign library.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

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

/// What begins so may be included by files that begin so, and by no others.
struct Foreign {
  std::string_view header;
  Names files;
};
const std::vector<Foreign> foreign = {
    {"embree", {"apps/oracle/embree.h"}},
    {"OpenImageIO/",
     {"apps/picture/image_file.cpp", "apps/foreign/picture_decoder.cpp", "tests/apps/picture/texture_file_test.cpp",
      "tests/fuzz/picture.cpp", "tests/apps/oracle/texture_lookup_test.cpp"}},
    {"assimp/", {"apps/mesh/", "apps/gltf/", "tests/apps/foreign/import_test.cpp"}},
    {"meshoptimizer.h", {"apps/foreign/gltf/meshopt.cpp", "tests/mesh/"}},
    {"draco/", {"apps/foreign/gltf/draco.cpp", "tests/mesh/"}},
    {"seccomp.h", {"apps/foreign/sandbox.cpp", "tests/apps/reader/foreign_files_test.cpp"}},
    {"CLI/", {"apps/line/command_line.cpp", "apps/line/command_description.cpp"}},
    {"nlohmann/",
     {"apps/show/stats/stats", "apps/machine/machine_file.", "apps/table/table.cpp", "apps/picture/compare_command.cpp",
      "apps/oracle/accurate/reference_file.cpp", "apps/gltf/", "apps/info/json.cpp", "apps/formats/landscape/gltf.cpp",
      "apps/study/scale/figures.cpp", "apps/show/trace/chrome.cpp", "tests/apps/"}},
    {"oneapi/",
     {"apps/check/inspection.cpp", "apps/system/side_by_side.cpp", "apps/oracle/accurate/picture.cpp", "tests/accurate/"}},
    {"tbb/",
     {"core/base/parallel.cpp", "apps/check/inspection.cpp", "apps/system/side_by_side.cpp", "apps/oracle/accurate/picture.cpp",
      "tests/accurate/", "tests/bench/rivals.h"}},
    {"benchmark/", {"tests/bench/"}},
    {"boost/", {"tests/bench/rivals.h"}},
    {"concurrentqueue/", {"tests/bench/rivals.h"}},
    {"hwy/", {"core/trace/kernel.cpp"}},
    {"doctest/", {"tests/"}},
    // Threads are the computer's; the edge has one that waits for signals, one that sends to a viewer, those on which rays are
    // timed, and runs side by side that share their progress.
    {"thread", {"nodes/", "tests/", "apps/system/interrupt.", "apps/render/preview.", "apps/bench/speed/crew."}},
    {"atomic", {"nodes/", "tests/", "apps/system/interrupt.", "apps/system/last_words.", "apps/render/preview."}},
    {"mutex", {"nodes/", "tests/", "apps/render/preview.", "apps/study/runs.cpp", "core/base/parallel.cpp"}},
    {"shared_mutex", {"nodes/", "tests/"}},
    {"condition_variable", {"nodes/", "tests/", "apps/render/preview."}},
    {"future", {"nodes/", "tests/"}},
    {"semaphore", {"nodes/", "tests/"}},
    {"latch", {"nodes/", "tests/"}},
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

bool may_include(std::string_view file, std::string_view header) {
  const std::string folder = first_folder(header);
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

bool is_source(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

/// All sources, relative to the root.
Names source_files(const fs::path& root) {
  Names files;
  for (const auto& [folder, unused] : stands_on) {
    if (!fs::is_directory(root / folder)) {
      continue;
    }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file() && is_source(entry.path())) {
        files.push_back(fs::relative(entry.path(), root).generic_string());
      }
    }
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

TEST_CASE("the two families never meet") {
  CHECK(violations_in("svm/run.cpp", "#include \"dataflow/region.h\"").size() == 1);
  CHECK(violations_in("dataflow/host.h", "#include \"svm/page.h\"").size() == 1);
}

TEST_CASE("a foreign header outside its file is found") {
  CHECK(violations_in("apps/check/command.cpp", "#include <embree3/rtcore.h>").size() == 1);
  CHECK(violations_in("apps/render/command.cpp", "#include <OpenImageIO/imageio.h>").size() == 1);
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
