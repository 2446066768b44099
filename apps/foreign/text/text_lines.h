// Text of foreign files, line by line, where it lies.
#pragma once

#include <cstddef>
#include <string_view>

namespace dmpc::apps {

/// Whether a line goes on behind a backslash at its end.
enum class LineJoin : bool { none, backslash };

/// A line ends with \n, \r\n or \r. Nothing is copied: `file` outlives this.
class TextLines {
 public:
  /// A byte order mark is passed over.
  explicit TextLines(std::string_view file, LineJoin join = LineJoin::none);

  /// Goes to the next line; false at the file's end. Throws core::InputError "line 3: ..." for a byte that no text has: any below
  /// 32 but blanks and line ends, and 127, unless a # stands before it in its line; one byte 26 at the end of all is passed over,
  /// with which DOS ended texts.
  bool next();

  /// Without its end. Joined lines are one, with the backslash and the line end between them, which LineWords takes for blanks.
  std::string_view line() const { return line_; }
  /// Number of the line, or of the first of joined lines, counted from 1.
  std::size_t number() const { return number_; }
  /// How much of the file lies behind, with the line and its end: where the next line begins.
  std::size_t bytes_passed() const { return passed_; }

 private:
  /// From `begin` to the end of that line, without its end.
  std::size_t end_of_line(std::size_t begin) const;
  /// Behind what ends the line there.
  std::size_t behind_end(std::size_t end) const;
  bool goes_on(std::size_t begin, std::size_t end) const;

  std::string_view file_;
  LineJoin join_;
  std::size_t passed_ = 0;
  std::string_view line_;
  std::size_t number_ = 0, lines_ = 1;
};

}  // namespace dmpc::apps
