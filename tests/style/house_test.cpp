// The plan of the house and what documents and comments call by name are there.

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/style/sources.h"
#include "tests/support/documents.h"

namespace dmpc::tests::house_test {

namespace {

namespace fs = std::filesystem;

/// Whether `name` is a file or folder, also without its extension.
bool is_there(const fs::path& root, const std::string& name) {
  return fs::exists(root / name) || fs::exists(root / (name + ".h")) || fs::exists(root / (name + ".cpp"));
}

/// Files and folders that stand in `code`, the first word of it, or are run in a line of its own.
Faults faults_of_names(const Place& place) {
  static const std::regex names(R"((?:^    |`)((?:core|nodes|svm|dataflow|apps|tests)/[A-Za-z0-9_./]+)(?=[` ]|$))");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size(); ++i) {
    for (const std::string& name : found_in(place.document.lines[i], names)) {
      if (!is_there(place.root, name)) {
        faults.push_back(place.text(i, "a file that does not exist: " + name));
      }
    }
  }
  return faults;
}

/// What a line of a source says in a comment: all behind the first // that is no address's.
std::string comment_of(const std::string& line) {
  static const std::regex comment(R"((?:^|[^:])//(.*))");
  std::smatch match;
  return std::regex_search(line, match, comment) ? match[1].str() : std::string();
}

/// Whether the name in a comment of `source` is there: from the root, or a header or source beside it or on its layer's floor.
bool is_there_for(const fs::path& root, const fs::path& source, const std::string& name) {
  return is_there(root, name) || is_there(root, source.parent_path() / name) || is_there(root, *source.begin() / name);
}

/// Files and folders that a comment names by a layer, and headers and sources that it names at all.
Faults faults_of_comments(const Place& place) {
  static const std::regex names(
      R"((?:^|[^A-Za-z0-9_/.<])((?:core|nodes|svm|dataflow|apps|tests)/[a-z0-9_./]*[a-z0-9_]|[a-z][a-z0-9_/]*\.(?:h|cpp))(?![A-Za-z0-9_>/]))");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size(); ++i) {
    for (const std::string& name : found_in(comment_of(place.document.lines[i]), names)) {
      if (!is_there_for(place.root, place.document.path, name)) {
        faults.push_back(place.text(i, "a file that does not exist: " + name));
      }
    }
  }
  return faults;
}

bool is_of_a_name(char letter) { return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_'; }

/// All words of the sources.
std::set<std::string> words_of_sources(const fs::path& root) {
  std::set<std::string> words;
  for (const std::string layer : {"core", "nodes", "svm", "dataflow", "apps"}) {
    for (const std::string& file : sources_below(root, layer)) {
      for (const std::string& line : lines_of(root / file)) {
        for (auto begin = line.begin(); begin != line.end();) {
          const auto end = std::find_if_not(begin, line.end(), is_of_a_name);
          words.emplace(begin, end);
          begin = std::find_if(end, line.end(), is_of_a_name);
        }
      }
    }
  }
  return words;
}

/// Types in `code` of a document that no source has.
Faults faults_of_types(const Place& place) {
  static const std::set<std::string> words = words_of_sources(DMPC_SOURCE_DIR);
  static const std::regex codes("`([^`]+)`"), types(R"((?:^|[^A-Za-z_])([A-Z][a-z]+[A-Z][A-Za-z]*))");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size(); ++i) {
    for (const std::string& code : found_in(place.document.lines[i], codes)) {
      for (const std::string& type : found_in(code, types)) {
        if (!words.contains(type)) {
          faults.push_back(place.text(i, "a type that does not exist: " + type));
        }
      }
    }
  }
  return faults;
}

/// Options behind a script of ours that the script does not know.
Faults faults_of_scripts(const Place& place) {
  static const std::regex calls(R"((?:^    |`)(tests/[a-z_/]+)( [^`]*))"), options(R"((--[a-z_]+))");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size(); ++i) {
    const std::string& line = place.document.lines[i];
    for (auto call = std::sregex_iterator(line.begin(), line.end(), calls); call != std::sregex_iterator(); ++call) {
      const Lines script = lines_of(place.root / (*call)[1].str());
      for (const std::string& option : found_in((*call)[2], options)) {
        if (std::none_of(script.begin(), script.end(),
                         [&](const std::string& said) { return said.find(option) != std::string::npos; })) {
          faults.push_back(place.text(i, (*call)[1].str() + " does not know " + option));
        }
      }
    }
  }
  return faults;
}

/// What git moves away leaves empty folders in old checkouts.
bool has_sources(const fs::path& folder) { return !sources_below(folder.parent_path(), folder.filename()).empty(); }

/// Rooms of a layer: its folders with sources.
Lines rooms_of(const fs::path& layer) {
  Lines rooms;
  for (const fs::directory_entry& entry : fs::directory_iterator(layer)) {
    if (entry.is_directory() && has_sources(entry.path())) {
      rooms.push_back(entry.path().filename());
    }
  }
  return rooms;
}

/// Whether a text calls a room by its name: `room`, `layer/room`, or [room](its README).
bool calls(const Lines& lines, const std::string& layer, const std::string& room) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find("`" + room + "`") != std::string::npos || line.find("`" + layer + "/" + room) != std::string::npos ||
           line.find("[" + room + "](") != std::string::npos;
  });
}

/// Words of programs in a line, alone or in a name: in `ray_setup`, not in `array`.
Faults programs_words(const std::string& line) {
  static const std::regex words("(?:^|[^A-Za-z])((?:page|ray|pixel|triangle|film|picture|scene|shading|voxel|bvh)s?)(?![A-Za-z])",
                                std::regex::icase);
  return found_in(line, words);
}

/// Sources of nodes that contain one of these words, except those of nodes/pictures, a separate library that knows core.
Faults programs_words_in_nodes(const fs::path& root) {
  Faults faults;
  for (const std::string& file : sources_below(root, "nodes")) {
    if (file.starts_with("nodes/pictures/")) {
      continue;
    }
    const Lines lines = lines_of(root / file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::string& word : programs_words(lines[i])) {
        faults.push_back(file + ":" + std::to_string(i + 1) + ": " + word);
      }
    }
  }
  return faults;
}

void check_all_names(Faults (*faults_of)(const Place&)) {
  for (const Document& document : all_documents(DMPC_SOURCE_DIR)) {
    for (const std::string& fault : faults_of({DMPC_SOURCE_DIR, document})) {
      FAIL_CHECK(fault);
    }
  }
}

Place readme_that_says(const Lines& lines) { return {DMPC_SOURCE_DIR, {"core/README.md", lines}}; }

}  // namespace

TEST_CASE("every file that a document names is there") {
  check_all_names(faults_of_names);
  CHECK(faults_of_names(
            readme_that_says({"`core/picture/film/film` and `tests/chaos --seeds=3`, in `core/picture`.", "    tests/run"}))
            .empty());
  CHECK(faults_of_names(readme_that_says({"`core/film.h`"})) ==
        Faults{"core/README.md:1: a file that does not exist: core/film.h"});
  CHECK(faults_of_names(readme_that_says({"    tests/gallop"})).size() == 1);
}

TEST_CASE("every type that a document names is there") {
  check_all_names(faults_of_types);
  CHECK(faults_of_types(readme_that_says({"`ImmutablePieces` and `nodes::ByteSource`", "no code: TurtleDove"})).empty());
  CHECK(faults_of_types(readme_that_says({"`nodes::TurtleDove`"})) ==
        Faults{"core/README.md:1: a type that does not exist: TurtleDove"});
}

TEST_CASE("every file that a comment names is there") {
  const fs::path root = DMPC_SOURCE_DIR;
  for (const std::string layer : {"core", "nodes", "svm", "dataflow", "apps", "tests"}) {
    for (const std::string& file : sources_below(root, layer)) {
      for (const std::string& fault : faults_of_comments({root, {file, lines_of(root / file)}})) {
        FAIL_CHECK(fault);
      }
    }
  }
  const auto faults_of = [&](const std::string& comment) { return faults_of_comments({root, {"svm/page.h", {"/" + comment}}}); };
  CHECK(faults_of("/ as svm/pages/pager has it (packets.h, core/picture/film/film.h, <sys/absent.h>), apps/modules/NAME.cpp")
            .empty());
  CHECK(faults_of("/ See usage/gone.h.") == Faults{"svm/page.h:1: a file that does not exist: usage/gone.h"});
  CHECK(faults_of("/ see svm/gone, gone.h").size() == 2);
  CHECK(faults_of("* no comment of ours: gone.h, https://svm/gone.h").empty());
}

TEST_CASE("every option of a script that a document names is one that it takes") {
  check_all_names(faults_of_scripts);
  CHECK(faults_of_scripts(readme_that_says({"    tests/chaos --seeds=10 --build=asan"})).empty());
  CHECK(faults_of_scripts(readme_that_says({"Try `tests/chaos --meekly`."})) ==
        Faults{"core/README.md:1: tests/chaos does not know --meekly"});
}

TEST_CASE("every room is on the plan of the house, or in its layer's README") {
  const fs::path root = DMPC_SOURCE_DIR;
  for (const std::string layer : {"core", "nodes", "svm", "dataflow", "apps"}) {
    Lines lines = lines_of(root / "ARCHITECTURE.md");
    const Lines own = lines_of(root / layer / "README.md");
    lines.insert(lines.end(), own.begin(), own.end());
    CHECK(calls(lines, layer, layer));
    for (const std::string& room : rooms_of(root / layer)) {
      CHECK_MESSAGE(calls(lines, layer, room), layer, "/", room);
    }
  }
  CHECK_FALSE(calls({"a cellar, and an `attic`"}, "core", "cellar"));
  CHECK(calls({"`core/cellar/rats.h`"}, "core", "cellar"));
}

TEST_CASE("nodes speaks of no pages, rays or pictures") {
  for (const std::string& fault : programs_words_in_nodes(DMPC_SOURCE_DIR)) {
    FAIL_CHECK(fault);
  }
  CHECK(programs_words("ray_setup, ///< a Pixel's rays") == Faults{"ray", "Pixel", "rays"});
  CHECK(programs_words("std::array<Packet> package; // a filmy bricklayer").empty());
}

}  // namespace dmpc::tests::house_test
