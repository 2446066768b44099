// The words of a line of a foreign file, and its numbers.
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

/// A line's words, one after the other. Blanks are spaces, tabulators, and a backslash before a line end (text_lines.h). What
/// follows a # is a remark, but for one behind a point, as in `1.#INF`.
class LineWords {
 public:
  /// `number` is the line's, for messages. The line outlives this.
  LineWords(std::string_view line, std::size_t number) : rest_(line), line_number_(number) {}

  /// The next; nothing at the line's end, or where a remark begins.
  std::string_view next();
  /// All that follows, without blanks around it, with what looks like a remark: names may have blanks and # in them.
  std::string_view rest() const;
  /// Whether a word follows.
  bool has_next() const { return !LineWords(*this).next().empty(); }

  /// Throw core::InputError, with the line, for a word that is no number, or if there is none.
  double number();
  std::int64_t integer();
  /// Throws core::InputError, with the line, if a word follows.
  void expect_end() const;
  /// core::InputError "line 3: WHAT".
  [[noreturn]] void refuse(const std::string& what) const;

  /// Of the word that was taken last.
  std::size_t line_number() const { return line_number_; }

 private:
  void skip_blanks();

  std::string_view rest_;
  std::size_t line_number_;
};

/// A name without the remark behind it: what follows a # at the begin of a word.
std::string_view without_remark(std::string_view name);
/// The same, and without quotes around it.
std::string_view plain_name(std::string_view name);

}  // namespace dmpc::apps
