#include "apps/frontend/manual/roff.h"

#include <cstddef>
#include <sstream>
#include <vector>

#include "apps/frontend/line/words.h"

namespace dmpc::apps {

namespace {

constexpr std::size_t source_columns = 78;

/// What stands for a character that means something, or looks otherwise, in roff; empty if it stands for itself.
std::string_view escape_of(char character) {
  switch (character) {
    case '\\':
      return "\\(rs";
    case '-':
      return "\\-";
    case '\'':
      return "\\(aq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    case '"':
      return "\\(dq";
    case '|':
      return "|\\:";  // a line may end here
    default:
      return "";
  }
}

/// The line cut at blanks such that sources stay readable; one line if it is empty.
std::vector<std::string> wrapped(const std::string& line) {
  std::vector<std::string> parts(1);
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const std::string escaped = roff(word);
    if (!parts.back().empty() && parts.back().size() + 1 + escaped.size() > source_columns) {
      parts.emplace_back();
    }
    parts.back() += (parts.back().empty() ? "" : " ") + escaped;
  }
  return parts;
}

/// A word that stands out and what follows it.
std::string highlighted(std::string_view term, std::string_view rest) {
  return (term.empty() ? "" : "\\fB" + roff(term) + "\\fP") + (rest.empty() ? "" : "\\fI" + roff(rest) + "\\fP") + "\n";
}

}  // namespace

std::string roff(std::string_view text) {
  std::string escaped;
  bool begins_line = true;
  for (const char character : text) {
    escaped += begins_line && character == '.' ? "\\&" : "";
    const std::string_view escape = escape_of(character);
    escaped += escape.empty() ? std::string_view(&character, 1) : escape;
    begins_line = character == '\n';
  }
  return escaped;
}

ManualPage::ManualPage(std::string_view title, std::string_view source) {
  text_ = ".TH \"" + roff(title) + "\" 1 \"\" \"" + roff(source) + "\" \"User Commands\"\n.ad l\n.nh\n";
}

void ManualPage::order(const std::string& name, std::string_view argument) {
  text_ += "." + name + " \"" + roff(argument) + "\"\n";
}

void ManualPage::add_text(std::string_view text) {
  bool is_first = true;
  for (const std::string& line : lines_of(text)) {
    text_ += is_first ? "" : ".br\n";
    is_first = false;
    for (const std::string& part : wrapped(line)) {
      text_ += part + "\n";
    }
  }
}

void ManualPage::begin_section(std::string_view title) {
  order("SH", title);
  is_begun_ = true;
}

void ManualPage::begin_part(std::string_view title) {
  order("SS", title);
  is_begun_ = true;
}

void ManualPage::begin_paragraph() {
  text_ += is_begun_ ? "" : ".PP\n";
  is_begun_ = false;
}

void ManualPage::add_paragraph(std::string_view text) {
  begin_paragraph();
  add_text(text);
}

void ManualPage::add_heading(std::string_view text) {
  begin_paragraph();
  order("I", text);
}

void ManualPage::add_call(std::string_view term, std::string_view rest) {
  text_ += (is_begun_ ? "" : ".br\n") + highlighted(term, rest);
  is_begun_ = false;
}

void ManualPage::add_entry(std::string_view term, std::string_view rest, std::string_view text) {
  text_ += ".TP\n" + highlighted(term, rest);
  is_begun_ = false;
  add_text(text);
}

void ManualPage::add_lines(std::string_view text) {
  begin_paragraph();
  text_ += ".nf\n";
  for (const std::string& line : lines_of(text)) {
    text_ += (line.empty() ? "\\&" : roff(line)) + "\n";
  }
  text_ += ".fi\n";
}

}  // namespace dmpc::apps
