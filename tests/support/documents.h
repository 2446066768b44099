// The project's Markdown files, and what is wrong with one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace dmpc::tests {

using Lines = std::vector<std::string>;

/// Its path is relative to the root.
struct Document {
  std::filesystem::path path;
  Lines lines;

  bool is_front() const { return path == "README.md" || path == "ARCHITECTURE.md"; }
  bool is_results() const { return path.filename() == "RESULTS.md"; }
};

/// "core/README.md:12: ...", one for each fault.
using Faults = std::vector<std::string>;

inline Lines lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Lines lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// All below `root`, except for what was built.
inline std::vector<Document> all_documents(const std::filesystem::path& root) {
  std::vector<Document> documents;
  using Entries = std::filesystem::recursive_directory_iterator;
  for (auto entry = Entries(root); entry != Entries(); ++entry) {
    const std::string name = entry->path().filename();
    if (entry->is_directory() && (name.front() == '.' || name == "build")) {
      entry.disable_recursion_pending();
    } else if (entry->path().extension() == ".md") {
      documents.push_back({std::filesystem::relative(entry->path(), root), lines_of(entry->path())});
    }
  }
  return documents;
}

/// What `expression` finds in a line: the first group of each match.
inline Lines found_in(const std::string& line, const std::regex& expression) {
  Lines found;
  for (auto match = std::sregex_iterator(line.begin(), line.end(), expression); match != std::sregex_iterator(); ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

/// A document of the project's, or a text in place of one for those who test the tests.
struct Place {
  std::filesystem::path root;
  Document document;

  /// Behind the number of a line, counted from 0.
  std::string text(std::size_t line, const std::string& fault) const {
    return document.path.string() + ":" + std::to_string(line + 1) + ": " + fault;
  }
};

}  // namespace dmpc::tests
