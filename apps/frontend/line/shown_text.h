// Escapes text for a terminal, so that names from files and command lines cannot control it.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A stream buffer that passes on lines, tabs and printable characters. Characters that would move the cursor, change colours or
/// the text's direction are escaped as \x1b or \u202e, and so are bytes that are not UTF-8. It allocates no memory. Thread-safe,
/// like the standard streams that it serves.
class ShownBuffer : public std::streambuf {
 public:
  /// `target` outlives it.
  explicit ShownBuffer(std::streambuf& target) : target_(target) {}

  /// Passes on the text unchanged, for intended control sequences.
  void put_unchanged(std::string_view text);
  /// Ends the text: an incomplete character is escaped.
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
  std::recursive_mutex one_at_a_time_;  ///< recursive, since the functions for texts call those for characters
  std::array<char, 4> kept_{};          ///< the beginning of a character
  std::size_t kept_bytes_ = 0;
  bool is_whole_ = true;  ///< the target has accepted everything
};

/// Escapes everything that goes to the stream during its lifetime.
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

/// Escapes a text.
std::string shown(std::string_view text);

/// Escapes untrusted text, including line ends, for use within a line; longer text is cut, with a note.
std::string clipped(std::string_view text, std::size_t bytes_max = 300);

/// Shortens untrusted words in a text so that the rest stays readable: a word too long for a path is replaced by its beginning
/// and its number of bytes.
std::string with_words_clipped(std::string_view text);

/// A manipulator: returns to the beginning of the line and clears it.
std::ostream& clear_line(std::ostream& stream);

}  // namespace dmpc::apps
