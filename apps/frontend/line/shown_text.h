// Text as a terminal may be shown it: names from files and command lines must not steer it.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A stream's end that hands on lines, tabs and all characters that are only seen. What would move the cursor, change colours or
/// turn the direction of the text becomes \x1b or \u202e, and so does what is no UTF-8. It allocates nothing. Thread-safe, as the
/// standard streams are that it stands behind.
class ShownBuffer : public std::streambuf {
 public:
  /// `target` outlives it.
  explicit ShownBuffer(std::streambuf& target) : target_(target) {}

  /// Hands on the text as it is: what steers the terminal on purpose.
  void put_unchanged(std::string_view text);
  /// Nothing follows: what is kept back as the beginning of a character is none.
  void end();

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;

 private:
  void put(std::string_view text);
  void put_kept();
  void put_escaped(char letter, char32_t code, int digits);

  std::streambuf& target_;
  std::recursive_mutex one_at_a_time_;  ///< serializes threads; recursive, since the functions for texts call those for characters
  std::array<char, 4> kept_{};          ///< the beginning of a character
  std::size_t kept_bytes_ = 0;
  bool is_whole_ = true;  ///< all has been taken by the target
};

/// While it lives, all that goes to the stream is shown so.
class ShownOutput {
 public:
  explicit ShownOutput(std::ostream& stream) : stream_(stream), buffer_(*stream.rdbuf()), before_(stream.rdbuf(&buffer_)) {}
  ~ShownOutput();
  ShownOutput(const ShownOutput&) = delete;
  ShownOutput& operator=(const ShownOutput&) = delete;

 private:
  std::ostream& stream_;
  ShownBuffer buffer_;
  std::streambuf* before_;
};

/// A text as it is shown.
std::string shown(std::string_view text);

/// A text of strangers as a part of a line: what is longer is cut off, which is said, and all is shown so, line ends too.
std::string clipped(std::string_view text, std::size_t bytes_max = 300);

/// A text whose words of strangers, however long, leave the rest to be read: of one that no path could be, the begin and its
/// number of bytes.
std::string with_words_clipped(std::string_view text);

/// A manipulator: back to the begin of the line, which is cleared.
std::ostream& clear_line(std::ostream& stream);

}  // namespace dmpc::apps
