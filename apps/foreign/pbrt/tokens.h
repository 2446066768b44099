// The tokens of a pbrt-v4 scene, across all included files.
//
// A text consists of words, quoted strings and brackets (pbrt.org, "pbrt-v4 Input File Format"); # begins a comment. Include and
// Import insert another file; its name is relative to the folder of the scene's first file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps::pbrt {

/// The position of a token: the index of the opened file, the line, and the byte within the line, from 1.
struct Place {
  std::uint32_t file = 0;
  std::uint32_t line = 1, column = 1;
};

enum class TokenKind : std::uint8_t { end, word, text, open, close };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< the word, or the contents of the quotes
  Place place;
};

/// Limits: nested open files, total opened files, and bytes read as a multiple of all files' size, or bytes_read_min if larger.
inline constexpr std::size_t include_levels_max = 64, includes_max = 100'000;
inline constexpr std::uint64_t rereadings_max = 64, bytes_read_min = std::uint64_t{1} << 20U;

/// The bytes of a file, decompressed if necessary.
class SourceText {
 public:
  /// Throws core::InputError with a complete message if the file cannot be read.
  SourceText(const std::string& path, SceneFiles& files);

  std::string_view text() const {
    return unpacked_.empty() ? text_of(*file_) : std::string_view(unpacked_.data(), unpacked_.size());
  }
  std::uint64_t file_bytes() const { return file_bytes_; }

 private:
  std::unique_ptr<FileBytes> file_;
  std::vector<char> unpacked_;
  std::uint64_t file_bytes_;
};

class Tokens {
 public:
  /// Opens the scene's first file. `files` outlives this object.
  Tokens(const std::string& path, SceneFiles& files);

  /// Returns the next token, of kind `end` after the last one. Throws core::InputError, with the position, for an invalid token.
  Token next();
  /// Returns the next token without consuming it.
  const Token& peek();

  /// Continues with the named file, which is included at `from`, before the tokens that follow. peek() must not have read ahead.
  void include(const std::string& name, const Place& from);
  /// Returns the number of open files, at least 1. A file is closed when the token after its last one is requested.
  std::size_t level() const { return open_.size(); }

  /// Reads a file of numbers, such as a spectrum; # begins a comment. Throws core::InputError at `from` for an invalid file.
  const std::vector<double>& numbers_of(const std::string& name, const Place& from);

  /// Returns the path of a file relative to the scene's first file.
  std::string path_of(const std::string& name) const;
  /// Throws core::InputError "scene.pbrt:120:7: WHAT (included from main.pbrt:8)".
  [[noreturn]] void fail(const Place& place, const std::string& what) const;
  std::string text_of(const Place& place) const;

 private:
  struct Opened {
    std::string path;
    Place from;
    bool is_first;
  };
  struct Source {
    std::unique_ptr<SourceText> bytes;
    std::string_view rest;
    Place place;  ///< position of the first byte of `rest`
    std::string normal_path;
  };

  void open(const std::string& path, const Place& from, bool is_first);
  void check_includes(const std::string& path, const Place& from) const;
  void count_bytes(const SourceText& text, const std::string& path, const Place& from);
  Token read();
  Token read_text(Source& source);
  Token read_word(Source& source) const;
  static void advance(Source& source, std::size_t bytes);
  static bool skip_blanks(Source& source);

  std::filesystem::path folder_;
  SceneFiles& files_;
  std::vector<Opened> opened_;
  std::vector<Source> open_;
  std::set<std::string> known_;
  std::map<std::string, std::vector<double>> numbers_;  ///< by name
  std::uint64_t bytes_of_files_ = 0, bytes_read_ = 0, next_shown_ = 0;
  Token next_;
  bool has_next_ = false;
};

}  // namespace dmpc::apps::pbrt
