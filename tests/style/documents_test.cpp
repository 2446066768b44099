// Documents stay short, speak of what is there, and say where a figure comes from.

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/documents.h"

namespace dmpc::tests::style_documents_test {

namespace {

namespace fs = std::filesystem;

/// Letters of UTF-8.
std::size_t width_of(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

Faults faults_of_size(const Place& place) {
  const Document& document = place.document;
  const std::size_t most = document.is_front() ? 120 : 199;
  Faults faults;
  if (!document.is_results() && document.lines.size() > most) {
    faults.push_back(
        place.text(most, "a document of more than " + std::to_string(most) + " lines: what goes into a room's README?"));
  }
  for (std::size_t i = 0; i < document.lines.size(); ++i) {
    if (!document.is_results() && document.lines[i].rfind('|', 0) != 0 && width_of(document.lines[i]) > 140) {
      faults.push_back(place.text(i, "more than 140 columns"));
    }
  }
  return faults;
}

/// Results are conclusions and the tables that they need; the whole of a run lies in build/results.
constexpr std::size_t most_lines_of_results = 1000;

std::size_t lines_of_results(const std::vector<Document>& documents) {
  std::size_t lines = 0;
  for (const Document& document : documents) {
    lines += document.is_results() ? document.lines.size() : 0;
  }
  return lines;
}

/// A heading's anchor, as GitHub makes it: "What is skipped?" is #what-is-skipped.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char letter : heading.substr(std::min(heading.find_first_not_of("# "), heading.size()))) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_') {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    } else if (letter == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

bool has_anchor(const fs::path& file, const std::string& anchor) {
  const Lines lines = lines_of(file);
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.rfind('#', 0) == 0 && anchor_of(line) == anchor; });
}

bool leads_somewhere(const Place& place, const std::string& link) {
  const std::size_t sign = link.find('#');
  const std::string name = link.substr(0, sign);
  const fs::path file = place.root / (name.empty() ? place.document.path : place.document.path.parent_path() / name);
  return fs::exists(file) && (sign == std::string::npos || has_anchor(file, link.substr(sign + 1)));
}

Faults faults_of_links(const Place& place) {
  static const std::regex links(R"re((?:\]\(|src=")([^)" ]+))re");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size(); ++i) {
    for (const std::string& link : found_in(place.document.lines[i], links)) {
      if (link.find("://") == std::string::npos && !leads_somewhere(place, link)) {
        faults.push_back(place.text(i, "a link that leads nowhere: " + link));
      }
    }
  }
  return faults;
}

/// History is git's to tell; the present tense is ours.
Faults faults_of_tense(const Place& place) {
  static const std::regex words(R"(\b(formerly|used to|no longer|at first|previously|originally|in the past)\b)");
  static const std::regex commits(R"(\b(?=[0-9a-f]*[a-f])(?=[0-9a-f]*[0-9])([0-9a-f]{7,40})\b)");
  Faults faults;
  for (std::size_t i = 0; i < place.document.lines.size() && !place.document.is_results(); ++i) {
    for (const std::string& word : found_in(place.document.lines[i], words)) {
      faults.push_back(place.text(i, "history, which git tells: " + word));
    }
    for (const std::string& commit : found_in(place.document.lines[i], commits)) {
      faults.push_back(place.text(i, "a commit or hash, which belongs into a RESULTS.md: " + commit));
    }
  }
  return faults;
}

/// Each section, from its "## " on, has a date, a commit and a command: of its own, or above all sections.
Faults faults_of_results(const Place& place) {
  static const std::vector<std::pair<std::string, std::regex>> wanted = {
      {"a date", std::regex(R"(\b20\d\d-\d\d-\d\d\b)")},
      {"a commit", std::regex(R"(\bcommit [0-9a-f]{7,40}\b)")},
      {"a command in a line of its own behind four blanks, or that no command prints it",
       std::regex(R"(^    \S|no command prints)")}};
  Faults faults;
  const Lines& lines = place.document.lines;
  const auto is_heading = [](const std::string& line) { return line.rfind("## ", 0) == 0; };
  const auto head_end = std::find_if(lines.begin(), lines.end(), is_heading);
  for (auto begin = head_end; place.document.is_results() && begin != lines.end();) {
    const auto end = std::find_if(begin + 1, lines.end(), is_heading);
    for (const auto& [what, expression] : wanted) {
      const auto has = [&](const std::string& line) { return std::regex_search(line, expression); };
      if (std::none_of(lines.begin(), head_end, has) && std::none_of(begin, end, has)) {
        faults.push_back(place.text(static_cast<std::size_t>(begin - lines.begin()), "results without " + what));
      }
    }
    begin = end;
  }
  return faults;
}

/// As they are typed, without remarks.
Lines commands_in(const Document& document) {
  static const std::regex command("    (apps/)?((mpirun [^#]*)?dmpc [^#]*[^# ]) *(#.*)?");
  static const std::regex of_readers("model\\.glb|bunny\\.ply|a\\.exr|a\\.html|kept\\.");
  Lines commands;
  for (const std::string& line : document.lines) {
    std::smatch found;
    if (std::regex_match(line, found, command) && !std::regex_search(line, of_readers)) {
      commands.push_back(found[2]);
    }
  }
  return commands;
}

void check_all(Faults (*faults_of)(const Place&)) {
  for (const Document& document : all_documents(DMPC_SOURCE_DIR)) {
    for (const std::string& fault : faults_of({DMPC_SOURCE_DIR, document})) {
      FAIL_CHECK(fault);
    }
  }
}

Place module_that_says(const Lines& lines, const fs::path& path = "core/README.md") { return {DMPC_SOURCE_DIR, {path, lines}}; }

}  // namespace

TEST_CASE("a front page has two screens, a room's README 199 lines, and none lines of more than 140 columns") {
  check_all(faults_of_size);
  CHECK(faults_of_size(module_that_says(Lines(199))).empty());
  CHECK(faults_of_size(module_that_says(Lines(200))).size() == 1);
  CHECK(faults_of_size(module_that_says(Lines(121), "README.md")).size() == 1);
  CHECK(faults_of_size(module_that_says(Lines(500), "core/RESULTS.md")).empty());
  CHECK(faults_of_size(module_that_says({std::string(141, 'x')})).size() == 1);
  CHECK(faults_of_size(module_that_says({"|" + std::string(300, 'x')})).empty());
}

TEST_CASE("all results together are at most 1,000 lines") {
  CHECK(lines_of_results(all_documents(DMPC_SOURCE_DIR)) <= most_lines_of_results);
  CHECK(lines_of_results({{"core/RESULTS.md", Lines(600)}, {"core/README.md", Lines(9)}, {"svm/RESULTS.md", Lines(401)}}) ==
        1001);
}

TEST_CASE("apps/RESULTS.md has each command of the front page and of apps, but those about files that the reader has") {
  std::string results;
  std::vector<Document> documents = all_documents(DMPC_SOURCE_DIR);
  for (const Document& document : documents) {
    for (const std::string& line : document.path == "apps/RESULTS.md" ? document.lines : Lines{}) {
      results += line + '\n';
    }
  }
  for (const Document& document : documents) {
    for (const std::string& command :
         document.path == "README.md" || document.path == "apps/README.md" ? commands_in(document) : Lines{}) {
      CHECK_MESSAGE(results.find("| `" + command + "` |") != std::string::npos, document.path.string(), ": ", command);
    }
  }
  CHECK(commands_in(
            {"README.md", {"    apps/dmpc list x   # what there is", "    dmpc info model.glb", "    ninja", "dmpc list"}}) ==
        Lines{"dmpc list x"});
}

TEST_CASE("every link of a document leads to a file, and to a heading of it") {
  check_all(faults_of_links);
  CHECK(faults_of_links(module_that_says({"See [nodes](../nodes/README.md)."})).empty());
  CHECK(faults_of_links(module_that_says({"See [tev](https://github.com/Tom94/tev)."})).empty());
  CHECK(faults_of_links(module_that_says({"", "See [nodes](nodes/README.md)."})) ==
        Faults{"core/README.md:2: a link that leads nowhere: nodes/README.md"});
  CHECK(faults_of_links(module_that_says({"See [nodes](../nodes/README.md#astrology)."})).size() == 1);
  CHECK(faults_of_links(module_that_says({"<img src=\"none.png\">"})).size() == 1);
  CHECK(anchor_of("## What is skipped, and why?") == "what-is-skipped-and-why");
}

TEST_CASE("documents speak of the present") {
  check_all(faults_of_tense);
  CHECK(faults_of_tense(module_that_says({"It is what at first it was."})).size() == 1);
  CHECK(faults_of_tense(module_that_says({"See commit 59ba5d7."})).size() == 1);
  CHECK(faults_of_tense(module_that_says({"See commit 59ba5d7, formerly."}, "core/RESULTS.md")).empty());
  CHECK(faults_of_tense(module_that_says({"A decade of 1234567 rays defaced nothing."})).empty());
}

TEST_CASE("results have a date, a commit and a command") {
  check_all(faults_of_results);
  const fs::path results = "core/RESULTS.md";
  CHECK(faults_of_results(module_that_says({"On 2026-11-23, commit 59ba5d7.", "## Load", "    dmpc study"}, results)).empty());
  CHECK(faults_of_results(module_that_says({"## Load", "    dmpc study"}, results)).size() == 2);
  CHECK(faults_of_results(module_that_says({"## A", "2026-11-23, commit 59ba5d7", "    x", "## B"}, results)).size() == 3);
}

}  // namespace dmpc::tests::style_documents_test
