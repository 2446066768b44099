// Words, numbers and names in text of foreign formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// Parses a word that is a decimal number: `.9`, `+1`, `1.`, `1e5`. Returns nothing for anything else, such as `1x`, `10.0D-01`,
/// `-1.#IND`, `nan`, `inf`, hexadecimal digits, or a number above the range of doubles. A number below the range is 0.
std::optional<double> decimal_number(std::string_view word);

/// Returns whether programs write this word for a non-finite number: `nan`, `-nan(ind)`, `inf`, `-1.#IND`, `1.#QNAN`.
bool is_no_number(std::string_view word);

/// Separators of words besides blanks and line ends, which are \n, \r or both.
struct WordRules {
  char remark = '#';  ///< begins a comment to the end of the line, except after a point, as in `1.#INF`; 0: no comments
  bool are_one =
      false;  ///< the text is one line, in which a backslash before a line end counts as a blank (apps/foreign/text/text_lines.h)
};
inline constexpr WordRules one_line{.are_one = true}, without_remarks{.remark = '\0'};

/// The words of a text in order, across lines. Results are views into the text, which outlives this object.
class LineWords {
 public:
  /// `first_line` is the number of the text's first line, for messages.
  explicit LineWords(std::string_view text, std::size_t first_line = 1, const WordRules& rules = one_line)
      : text_(text), line_(first_line), rules_(rules) {}

  /// Returns the next word; empty at the end of the text.
  std::string_view next();
  /// Returns the next word if it is on the line of the last one; else empty.
  std::string_view next_in_line();
  bool has_next() const { return !LineWords(*this).next().empty(); }
  /// Returns the rest of the line without surrounding blanks. Apparent comments are included, since names may contain both.
  std::string_view rest_of_line();

  /// Returns the line of the last word, or at the end the line of the text's end.
  std::size_t line() const { return line_; }
  /// Returns the number of bytes read.
  std::size_t position() const { return at_; }

  /// Parses the next word as a number; `what` describes it in errors. Throw core::InputError, with the line.
  double number(const std::string& what = "a number");
  std::int64_t integer();
  /// Throws core::InputError, with the line, if a word follows.
  void expect_end() const;
  /// Throws core::InputError "line N: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws core::InputError "line N: found 'WORD', expected WHAT" for the last word.
  [[noreturn]] void fail_at(std::string_view word, const std::string& expected) const;

 private:
  bool is_at_join() const;
  bool is_at_remark() const;
  bool is_in_hole() const;
  std::size_t end_of_line() const;
  void skip_blanks();
  void skip_to_word();
  void skip_line_end();

  std::string_view text_;
  std::size_t at_ = 0, line_;
  WordRules rules_;
};

/// Returns a name without a trailing comment, which is a # at the start of a word and the text after it.
std::string_view without_remark(std::string_view name);
/// Also removes quotes around the name.
std::string_view plain_name(std::string_view name);

}  // namespace dmpc::apps
