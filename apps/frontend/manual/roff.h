// Text in the language of manual pages, man(7).
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

/// Escapes the text so that it is printed literally, on any line: it contains no requests, no quotation marks of requests, and no
/// dashes or quotes that a printer replaces, so that text copied from the page can be typed.
std::string roff(std::string_view text);

/// A page, written from top to bottom. Texts are given literally, with line ends where lines are to end.
class ManualPage {
 public:
  /// `title` in capitals; `source` is the program with its version.
  ManualPage(std::string_view title, std::string_view source);

  void begin_section(std::string_view title);
  void begin_part(std::string_view title);
  void add_text(std::string_view text);
  void add_paragraph(std::string_view text);
  /// A small title within a part.
  void add_heading(std::string_view text);
  /// A line of a synopsis: `term` in bold, `rest` after it in italics.
  void add_call(std::string_view term, std::string_view rest);
  /// `term` in bold, `rest` after it in italics, `text` indented below.
  void add_entry(std::string_view term, std::string_view rest, std::string_view text);
  /// Lines that keep their breaks and blanks.
  void add_lines(std::string_view text);

  /// The page so far.
  const std::string& text() const { return text_; }

 private:
  void order(const std::string& name, std::string_view argument);
  void begin_paragraph();

  std::string text_;
  bool is_begun_ = true;  ///< a section or part has begun, which begins a paragraph
};

}  // namespace dmpc::apps
