// Who stands on whom: library upon library, and within core and those of apps room upon room; which files may name a foreign
// library; and that no layer but the edge knows the command line.

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

#include "apps/frontend/line/text_table.h"
#include "core/base/expect.h"
#include "tests/style/sources.h"
#include "tests/support/tables.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::layers_test {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// Rows of a kind in layers.txt, which says what they mean.
std::map<std::string, Names> rules(std::string_view kind) {
  static const std::string text = file_text(fs::path(DMPC_SOURCE_DIR) / "tests/style/layers.txt");
  std::map<std::string, Names> found;
  for (const auto& row : apps::table_rows(text, 3)) {
    if (row[0] == kind) {
      const auto names = row[2].empty() ? std::vector<std::string_view>() : apps::parts_between(row[2], ",");
      found[std::string(row[1])] = Names(names.begin(), names.end());
    }
  }
  core::expect(!found.empty(), "layers.txt has rows of each kind");
  return found;
}

const std::map<std::string, Names> stands_on = rules("stands on"), words_of_core = rules("words of core"), rooms = rules("rooms"),
                                   looked_into_by = rules("looked into by"), foreign = rules("foreign");

bool begins_with(std::string_view text, std::string_view beginning) { return text.substr(0, beginning.size()) == beginning; }

std::string first_folder(std::string_view path) { return std::string(path.substr(0, path.find('/'))); }

/// A word of `foreign` ending in a slash, or embree's numbered folder, is a beginning; any other is a whole header.
bool is_header_of(std::string_view header, const std::string& word) {
  return word.back() == '/' || word == "embree" ? begins_with(header, word) : header == word;
}

bool may_include_foreign(std::string_view file, std::string_view header) {
  return std::all_of(foreign.begin(), foreign.end(), [&](const auto& rule) {
    return !is_header_of(header, rule.first) ||
           std::any_of(rule.second.begin(), rule.second.end(),
                       [&](const std::string& allowed) { return begins_with(file, allowed); });
  });
}

/// "apps/frontend" of "apps/frontend/line/words.h"; empty of what is not ours.
std::string library_of(std::string_view path) {
  std::string found;
  for (const auto& [library, unused] : stands_on) {
    if (begins_with(path, library + "/") && library.size() > found.size()) {
      found = library;
    }
  }
  return found;
}

/// "database" of "core/database/tree/cutter.h", empty of "apps/main/main.cpp".
std::string room_of(std::string_view path) {
  path.remove_prefix(library_of(path).size() + 1);
  const std::size_t slash = path.find('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash));
}

std::size_t height(const std::string& library, const std::string& room) {
  const Names& names = rooms.at(library);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), room) - names.begin());
}

/// Whether a file may look into another of its library.
bool may_look_into(std::string_view file, std::string_view header) {
  const std::string library = library_of(header), room = room_of(header), own = room_of(file);
  if (room == own) {
    return true;
  }
  if (rooms.contains(library)) {
    return own.empty() || (!room.empty() && height(library, room) < height(library, own));
  }
  const auto observers = looked_into_by.find(library + "/" + room);
  return !own.empty() || observers == looked_into_by.end() ||
         std::any_of(observers->second.begin(), observers->second.end(),
                     [&](const std::string& beginning) { return begins_with(file, beginning); });
}

bool is_in(const Names& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

bool may_include(std::string_view file, std::string_view header) {
  const std::string library = library_of(header), own = library_of(file);
  if (library.empty()) {
    return may_include_foreign(file, header);
  }
  if (library == own) {
    return own == "tests" || may_look_into(file, header);
  }
  const auto words = words_of_core.find(own);
  return is_in(stands_on.at(own), library) || (words != words_of_core.end() && is_in(words->second, header));
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
  for (const char* const folder : {"core", "nodes", "svm", "dataflow", "apps", "tests"}) {
    const Names below = sources_below(root, folder);
    files.insert(files.end(), below.begin(), below.end());
  }
  return files;
}

/// The libraries that `library` includes headers of, and those that these include headers of.
bool stands_below(const std::string& library, const std::string& other) {
  const Names& names = stands_on.at(library);
  return is_in(names, other) ||
         std::any_of(names.begin(), names.end(), [&](const std::string& name) { return stands_below(name, other); });
}

}  // namespace

TEST_CASE("every include goes downwards, and foreign libraries are named where they may be") {
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
  std::istringstream late("// A film.\n#include <vector>\n#include \"core/picture/film/film.h\"\n"), never("int x;\n");
  CHECK_FALSE(begins_with_own_header("core/picture/film/film.cpp", late));
  CHECK_FALSE(begins_with_own_header("core/picture/film/film.cpp", never));
}

TEST_CASE("an include that is not allowed is found, with file and line, and what is allowed is not") {
  for (const auto& row : rows_in("style/includes.txt", 3)) {
    CAPTURE(row[0]);
    CAPTURE(row[1]);
    CHECK(violations_in(row[0], row[1]) == (row[2].empty() ? Names{} : Names{row[0] + ":" + row[2]}));
  }
}

TEST_CASE("no library uses itself by way of others") {
  for (const auto& [library, unused] : stands_on) {
    CAPTURE(library);
    CHECK_FALSE(stands_below(library, library));
  }
}

TEST_CASE("a folder with sources is a library of its own or a room, and each library is there") {
  const fs::path root = DMPC_SOURCE_DIR;
  const std::regex built(R"(^layer\()");
  for (const auto& [library, unused] : stands_on) {
    std::ifstream text(root / library / "CMakeLists.txt");
    int layers = 0;
    for (std::string line; std::getline(text, line);) {
      layers += std::regex_search(line, built) ? 1 : 0;
    }
    CAPTURE(library);
    CHECK(layers ==
          (library == "tests" || library == "apps/modules" || library == "apps/manual" || library == "apps/computer/examples"
               ? 0
               : 1));
  }
}

TEST_CASE("every room has its place in the house") {
  std::map<std::string, std::set<std::string>> found;
  for (const std::string& file : source_files(fs::path(DMPC_SOURCE_DIR))) {
    if (!room_of(file).empty()) {
      found[library_of(file)].insert(room_of(file));
    }
  }
  for (const auto& [library, names] : rooms) {
    CHECK(found[library] == std::set<std::string>(names.begin(), names.end()));
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

}  // namespace dmpc::tests::layers_test
