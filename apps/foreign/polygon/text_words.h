// The words of a text that is read once, from its beginning to its end, whatever lines they stand in; where lines count, see
// apps/foreign/text/line_words.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// Words stand between blanks and ends of lines, which are \n, \r or both. Views are into the text, which nobody copies.
class TextWords {
 public:
  /// `first_line`: the number of the text's first line. `remark`: what begins a remark that goes to the end of its line, or 0.
  explicit TextWords(std::string_view text, std::size_t first_line = 1, char remark = '\0')
      : text_(text), line_(first_line), remark_(remark) {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// The next word, if it stands in the line of the last one; else empty.
  std::string_view next_in_line();
  /// What is left of the line, without the blanks around it.
  std::string_view rest_of_line();

  /// Of the last word; at the end that of the text's end.
  std::size_t line() const { return line_; }
  /// How many bytes are read.
  std::size_t position() const { return at_; }

  /// Throws core::InputError "line N: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws core::InputError "line N: found 'WORD', expected WHAT", of the last word.
  [[noreturn]] void fail_at(std::string_view word, const std::string& expected) const;

  /// The next word as a decimal number; `what` says in errors what it is. Throws core::InputError.
  double number(const std::string& what);

 private:
  void skip_blanks();
  void skip_line_end();
  bool is_at_remark() const { return remark_ != '\0' && text_[at_] == remark_; }
  std::string_view word();

  std::string_view text_;
  std::size_t at_ = 0, line_;
  char remark_;
};

}  // namespace dmpc::apps
