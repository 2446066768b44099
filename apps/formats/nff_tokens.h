// Splits an NFF stream into words and numbers with their line numbers, and reports errors with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// Splits a text stream at blanks and line ends; `#` starts a comment to the line's end. Stores one line at a time.
class NffTokens {
 public:
  /// `name` is what messages call the stream. Both must outlive the object.
  NffTokens(std::istream& input, const std::string& name);

  /// The next token, or empty at the end; valid until the token after it is taken. Throws core::InputError if reading fails, for
  /// a line that does not end within 16 MiB, and for 64 MiB of blanks and comments.
  std::string_view peek();
  std::string_view take();

  /// The next number, finite; `what` says which one was expected ("the radius of the sphere").
  double number(const char* entity, const char* what);
  /// The next token is an integer from `low` to `high`.
  int integer(const char* entity, const char* what, int low, int high);

  bool next_is_number();
  /// Drops the numbers that are left on the line of the token taken last.
  void skip_numbers_on_line();

  /// Throws core::InputError "NAME:LINE: message", with the line of the token taken last (`fail`) or next (`fail_at_next`).
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_at_next(const std::string& message);

  /// The next token for a message: "found 'x'", or "the file ends here".
  std::string found();
  /// The line of the token taken last.
  std::size_t line() const { return taken_line_; }
  /// Bytes of the stream up to the end of the current line; one more if the stream's last line has no end.
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  bool read_line();
  /// The bytes of the next line with its end; one part of it, behind `size` bytes of the buffer.
  std::size_t get_line();
  std::size_t get_part(std::size_t size);
  void grow_room();

  std::istream& input_;
  const std::string& name_;
  std::size_t room_bytes_;
  std::unique_ptr<char[]> room_;                    ///< buffer for a line; grows with the longest
  std::string_view text_;                           ///< the current line
  std::string_view token_;                          ///< in text_; empty if it is not split yet
  std::size_t position_ = 0;                        ///< in text_, behind token_
  std::size_t line_ = 0;                            ///< line in text_, from 1
  std::size_t taken_line_ = 0;                      ///< line of the token taken last
  std::uint64_t bytes_read_ = 0, token_bytes_ = 0;  ///< up to the end of the current line, and of the last token's line
};

/// A token as a message shows it: in quotes, short, printable.
std::string quoted(std::string_view token);

}  // namespace dmpc::apps
