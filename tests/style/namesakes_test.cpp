// Two classes, or two functions of the same parameters, with one name and external linkage are one to the linker, which takes
// either: a program that has both libraries then runs the one with the other's data. The compiler sees no more than one of them.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/style/sources.h"

namespace dmpc::tests::namesakes_test {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// Reads a source that clang-format has laid out: what stands in a namespace begins at the start of a line, and a namespace ends
/// in a line that says so.
class Definitions {
 public:
  explicit Definitions(std::istream& text) {
    for (std::string line; std::getline(text, line);) {
      take(line, text);
    }
  }
  /// "dmpc::apps::Command", or of a function "dmpc::apps::text_of(const Camera&)"; none of what a namespace without a name has.
  const Names& names() const { return names_; }

 private:
  void take(const std::string& line, std::istream& text) {
    static const std::regex opening(R"(^(inline )?namespace ?([\w:]*) ?\{$)"), closing(R"(^\}.*// namespace.*)");
    std::smatch match;
    if (std::regex_match(line, match, opening)) {
      namespaces_.push_back(match[2]);
    } else if (std::regex_match(line, closing)) {
      namespaces_.pop_back();
    } else if (!line.empty() && std::string(" #/}").find(line.front()) == std::string::npos) {
      take_declaration(whole_head(line, text));
    }
  }

  /// Up to the brace of a definition or the end of a declaration, in one line.
  static std::string whole_head(std::string head, std::istream& text) {
    std::string more;
    while (head.find_first_of(";{") == std::string::npos && std::getline(text, more)) {
      more.erase(0, more.find_first_not_of(' '));
      head += " " + more;
    }
    return head.substr(0, head.find_first_of(";{") + 1);
  }

  void take_declaration(const std::string& head) {
    static const std::regex prefix(R"(^template <.*?> (?=class |struct |\w+ |\w+[&*:<]))"),
        type(R"(^(?:class|struct|union|enum(?: class)?) (?:alignas\(.*?\) )?(\w+)(?: final)?(?: :[^:].*)? ?\{$)"),
        function(R"(^(?!static |using |TEST_CASE|struct |class )[^=]*?(\S*\b[\w~]+)\((.*)\)[^()]* ?\{$)");
    const bool is_hidden = std::find(namespaces_.begin(), namespaces_.end(), "") != namespaces_.end();
    if (is_hidden || namespaces_.empty()) {
      return;
    }
    const std::string plain = std::regex_replace(head, prefix, "");
    std::smatch match;
    if (std::regex_match(plain, match, type)) {
      names_.push_back(scope() + match[1].str());
    } else if (std::regex_match(plain, match, function) && match[1].str().find("::") == std::string::npos) {
      names_.push_back(scope() + match[1].str() + "(" + types_of(match[2]) + ")");
    }
  }

  /// Parameters without their names.
  static std::string types_of(const std::string& parameters) {
    static const std::regex name(R"(([\w>&*\]]) \w+(?=,|$))");
    return std::regex_replace(parameters, name, "$1");
  }

  std::string scope() const {
    std::string text;
    for (const std::string& each : namespaces_) {
      text += each + "::";
    }
    return text;
  }

  Names namespaces_, names_;
};

Names definitions_in(const std::string& text) {
  std::istringstream stream(text);
  return Definitions(stream).names();
}

/// Programs, each of which may call what it likes; and code for several instruction sets, which Highway puts into a namespace for
/// each.
bool is_aside(const std::string& file) { return file.starts_with("apps/computer/examples/") || file.ends_with("main.cpp"); }

}  // namespace

TEST_CASE("no two classes or functions of the product have one name") {
  std::map<std::string, std::string> file_of;
  for (const std::string folder : {"core", "nodes", "svm", "dataflow", "apps"}) {
    for (const std::string& file : sources_below(DMPC_SOURCE_DIR, folder)) {
      if (is_aside(file)) {
        continue;
      }
      std::ifstream text(fs::path(DMPC_SOURCE_DIR) / file);
      const Definitions found(text);
      for (const std::string& name : found.names()) {
        const auto [place, is_new] = file_of.emplace(name, file);
        CHECK_MESSAGE((is_new || place->second == file), name, " is in ", place->second, " and ", file);
      }
    }
  }
  CHECK(file_of.size() > 1500);
}

TEST_CASE("classes and functions are found with their scope, but not members, declarations, and what one file has for itself") {
  CHECK(definitions_in("namespace dmpc::apps {\nstruct Command {\n  int x;\n};\n}  // namespace dmpc::apps\n") ==
        Names{"dmpc::apps::Command"});
  CHECK(definitions_in(
            "namespace a {\nclass B final : public C {\n};\nstruct D;\nenum class E : int { one };\n}  // namespace a\n") ==
        Names{"a::B", "a::E"});
  CHECK(definitions_in("namespace a {\nint sum(const B& one,\n        int two) {\n}\nint sum(int);\n}  // namespace a\n") ==
        Names{"a::sum(const B&, int)"});
  CHECK(definitions_in(
            "namespace a {\nnamespace {\nstruct B {\n};\nint f() {\n}\n}  // namespace\nint g() {\n}\n}  // namespace a\n") ==
        Names{"a::g()"});
  CHECK(definitions_in("namespace a {\nB::B(int x) : x_(x) {\n}\nint B::f() const {\n}\nstruct B::C {\n};\n}  // namespace a\n")
            .empty());
}

}  // namespace dmpc::tests::namesakes_test
