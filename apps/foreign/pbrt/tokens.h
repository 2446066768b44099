// The words of a scene of pbrt-v4, through all the files that it includes.
//
// A text is words, strings in quotes and brackets (pbrt.org, "pbrt-v4 Input File Format"); a # begins a remark. Include and
// Import put another file's words in their place, whose name counts from the folder of the scene's first file.
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

/// Where a word stands: in which of the files that were opened, and there in which line and at which byte of it, from 1.
struct Place {
  std::uint32_t file = 0;
  std::uint32_t line = 1, column = 1;
};

enum class TokenKind : std::uint8_t { end, word, text, open, close };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< a word's, or what stands between quotes
  Place place;
};

/// Limits: nested open files, files opened in all, and bytes read as a multiple of all files' bytes, or bytes_read_min if that is
/// more.
inline constexpr std::size_t include_levels_max = 64, includes_max = 100'000;
inline constexpr std::uint64_t rereadings_max = 64, bytes_read_min = std::uint64_t{1} << 20U;

/// A file's bytes, unpacked if they are packed.
class SourceText {
 public:
  /// Throws core::InputError, a whole sentence, if it cannot be had.
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
  /// Opens the scene's first file. `files` outlives this.
  Tokens(const std::string& path, SceneFiles& files);

  /// The next; one of kind `end` behind the last of all. Throws core::InputError with its place for what is none.
  Token next();
  /// The next, which stays the next.
  const Token& peek();

  /// Goes on with the file of this name, which is meant at `from`, before what follows there. peek() must not have looked
  /// further.
  void include(const std::string& name, const Place& from);
  /// How many files are open: the first alone is 1. One that ends is closed when the word behind it is asked for.
  std::size_t level() const { return open_.size(); }

  /// A file of numbers, as of a spectrum, where # begins a remark. Throws core::InputError at `from` for what is none.
  const std::vector<double>& numbers_of(const std::string& name, const Place& from);

  /// A file's name beside the scene's first.
  std::string path_of(const std::string& name) const;
  /// core::InputError "scene.pbrt:120:7: WHAT (included from main.pbrt:8)".
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
    Place place;  ///< place of the first of `rest`
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
