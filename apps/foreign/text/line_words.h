// The words of foreign text, its numbers, and names in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A decimal number, all of the word: `.9`, `+1`, `1.`, `1e5`. Nothing for anything else, such as `1x`, `10.0D-01`, `-1.#IND`,
/// `nan`, `inf`, hexadecimal digits, or a number beyond what a double holds. One below that is 0.
std::optional<double> decimal_number(std::string_view word);

/// Whether programs write it for what is no finite number: `nan`, `-nan(ind)`, `inf`, `-1.#IND`, `1.#QNAN`.
bool is_no_number(std::string_view word);

/// What parts words beside blanks and ends of lines, which are \n, \r or both.
struct WordRules {
  char remark = '#';     ///< begins one that goes to the line's end, but behind a point, as in `1.#INF`; 0: there are none
  bool are_one = false;  ///< the text is one line, in which a backslash before an end of a line is a blank (text_lines.h)
};
inline constexpr WordRules one_line{.are_one = true}, without_remarks{.remark = '\0'};

/// The words of a text, one after the other, whatever lines they stand in. Views are into the text, which outlives this.
class LineWords {
 public:
  /// `first_line`: the number of the text's first line, for messages.
  explicit LineWords(std::string_view text, std::size_t first_line = 1, const WordRules& rules = one_line)
      : text_(text), line_(first_line), rules_(rules) {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// The next word, if it stands in the line of the last one; else empty.
  std::string_view next_in_line();
  bool has_next() const { return !LineWords(*this).next().empty(); }
  /// What is left of the line, without the blanks around it, with what looks like a remark: names may have both in them.
  std::string_view rest_of_line();

  /// Line of the last word; at the end, of the text's end.
  std::size_t line() const { return line_; }
  /// How many bytes are read.
  std::size_t position() const { return at_; }

  /// The next word as a number; `what` says in errors what it is. Throw core::InputError, with the line.
  double number(const std::string& what = "a number");
  std::int64_t integer();
  /// Throws core::InputError, with the line, if a word follows.
  void expect_end() const;
  /// core::InputError "line N: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
  /// core::InputError "line N: found 'WORD', expected WHAT", of the last word.
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

/// A name without the remark behind it: what follows a # at the begin of a word.
std::string_view without_remark(std::string_view name);
/// As above, without quotes around the name.
std::string_view plain_name(std::string_view name);

}  // namespace dmpc::apps
