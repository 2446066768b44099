// Splits the text of foreign files into lines without copying.
#pragma once

#include <cstddef>
#include <string_view>

namespace dmpc::apps {

/// Whether a backslash at the end of a line joins the line with the next one.
enum class LineJoin : bool { none, backslash };

/// Lines end with \n, \r\n or \r. Nothing is copied: `file` outlives this object.
class TextLines {
 public:
  /// Skips a byte order mark.
  explicit TextLines(std::string_view file, LineJoin join = LineJoin::none);

  /// Advances to the next line; returns false at the end of the file. Throws core::InputError "line 3: ..." for a byte that text
  /// cannot contain: any below 32 except blanks and line ends, and 127, unless a # precedes it on its line. One byte 26 at the
  /// end of the file, with which DOS terminated texts, is skipped.
  bool next();

  /// Returns the line without its end. Joined lines are one, including the backslash and the line end between them, which
  /// LineWords treats as blanks.
  std::string_view line() const { return line_; }
  /// Returns the number, from 1, of the line or of the first of joined lines.
  std::size_t number() const { return number_; }
  /// Returns the number of bytes up to and including the line's end, where the next line begins.
  std::size_t bytes_passed() const { return passed_; }

 private:
  /// Returns the end of the line that contains `begin`, excluding the line terminator.
  std::size_t end_of_line(std::size_t begin) const;
  /// Returns the position after the line terminator at `end`.
  std::size_t behind_end(std::size_t end) const;
  bool goes_on(std::size_t begin, std::size_t end) const;

  std::string_view file_;
  LineJoin join_;
  std::size_t passed_ = 0;
  std::string_view line_;
  std::size_t number_ = 0, lines_ = 1;
};

}  // namespace dmpc::apps
