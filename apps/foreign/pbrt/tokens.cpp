#include "apps/foreign/pbrt/tokens.h"

#include <algorithm>
#include <utility>

#include "apps/foreign/pbrt/unpacked.h"
#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::pbrt {
namespace {

constexpr std::string_view white = " \t\r\n\v\f", word_ends = " \t\r\n\v\f\"[]";

/// The maximum length of a word, which is copied out of its file.
constexpr std::size_t word_bytes_max = std::size_t{1} << 20U;

bool is_of_no_text(char letter) {
  return (static_cast<unsigned char>(letter) < 32 && white.find(letter) == std::string_view::npos) || letter == 127;
}

/// Returns the letter for an escape sequence; 0 for an invalid one.
char escaped(char letter) {
  constexpr std::string_view letters = "bfnrt\\'\"", meant = "\b\f\n\r\t\\'\"";
  const std::size_t at = letters.find(letter);
  return at == std::string_view::npos ? '\0' : meant[at];
}

}  // namespace

SourceText::SourceText(const std::string& path, SceneFiles& files) : file_(files.open(path)), file_bytes_(file_->bytes().size()) {
  if (is_packed(apps::text_of(*file_))) {
    try {
      unpacked_ = unpacked(apps::text_of(*file_));
    } catch (const core::InputError& error) {
      throw core::InputError(path + ": " + error.what());
    }
    if (unpacked_.empty()) {
      unpacked_.push_back('\n');
    }
  }
}

Tokens::Tokens(const std::string& path, SceneFiles& files) : folder_(std::filesystem::path(path).parent_path()), files_(files) {
  open(path, {}, true);
}

std::string Tokens::path_of(const std::string& name) const { return (folder_ / name).string(); }

std::string Tokens::text_of(const Place& place) const {
  return opened_[place.file].path + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

void Tokens::fail(const Place& place, const std::string& what) const {
  const Opened& file = opened_[place.file];
  const std::string from =
      file.is_first ? "" : " (included from " + opened_[file.from.file].path + ":" + std::to_string(file.from.line) + ")";
  throw core::InputError(text_of(place) + ": " + what + from);
}

void Tokens::check_includes(const std::string& path, const Place& from) const {
  if (std::any_of(open_.begin(), open_.end(), [&](const Source& source) { return source.normal_path == path; })) {
    fail(from, "includes " + path + " within itself, which has no end");
  }
  if (open_.size() >= include_levels_max) {
    fail(from, "files include each other more than " + std::to_string(include_levels_max) + " deep");
  }
  if (opened_.size() >= includes_max) {
    fail(from, "more than " + grouped(includes_max) + " files are included");
  }
}

/// Bounds the bytes read, since nested files that each include another twice would take exponential time.
void Tokens::count_bytes(const SourceText& text, const std::string& path, const Place& from) {
  bytes_of_files_ += known_.insert(path).second ? text.text().size() : 0;
  bytes_read_ += text.text().size();
  if (bytes_read_ > std::max(rereadings_max * bytes_of_files_, bytes_read_min)) {
    fail(from, "the files are included again and again, which makes " + grouped(bytes_read_) + " bytes of " +
                   grouped(bytes_of_files_) + "; there may be " + std::to_string(rereadings_max) + " times as many");
  }
}

void Tokens::open(const std::string& path, const Place& from, bool is_first) {
  auto bytes = std::make_unique<SourceText>(path, files_);
  opened_.push_back({path, from, is_first});
  count_bytes(*bytes, path, is_first ? Place{} : from);
  std::string_view text = bytes->text();
  text.remove_prefix(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  open_.push_back({.bytes = std::move(bytes),
                   .rest = text,
                   .place = {.file = static_cast<std::uint32_t>(opened_.size() - 1)},
                   .normal_path = std::filesystem::path(path).lexically_normal().string()});
}

void Tokens::include(const std::string& name, const Place& from) {
  core::expect(!has_next_, "the words of a file that is included come before those behind its name");
  const std::string path = std::filesystem::path(path_of(name)).lexically_normal().string();
  check_includes(path, from);
  try {
    open(path, from, false);
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    throw text.starts_with(text_of(from)) ? error : core::InputError(text_of(from) + ": " + text);
  }
}

const std::vector<double>& Tokens::numbers_of(const std::string& name, const Place& from) {
  const auto [known, is_new] = numbers_.try_emplace(name);
  if (!is_new) {
    return known->second;
  }
  Source source;
  try {
    source.bytes = std::make_unique<SourceText>(path_of(name), files_);
  } catch (const core::InputError& error) {
    fail(from, "the spectrum \"" + clipped(name, 60) + "\" is none that pbrt-v4 names, and no file of numbers: " + error.what());
  }
  source.rest = source.bytes->text();
  while (skip_blanks(source)) {
    const std::string_view word = source.rest.substr(0, source.rest.find_first_of(white));
    const auto value = decimal_number(word);
    if (!value) {
      fail(from, "the spectrum's file " + clipped(name, 60) + " has '" + clipped(std::string(word), 40) + "' in its line " +
                     std::to_string(source.place.line) + ", expected a number");
    }
    known->second.push_back(*value);
    advance(source, word.size());
  }
  return known->second;
}

void Tokens::advance(Source& source, std::size_t bytes) {
  for (const char letter : source.rest.substr(0, bytes)) {
    ++source.place.column;
    if (letter == '\n') {
      ++source.place.line;
      source.place.column = 1;
    }
  }
  source.rest.remove_prefix(bytes);
}

/// Also skips comments; returns false at the end.
bool Tokens::skip_blanks(Source& source) {
  while (!source.rest.empty()) {
    const std::size_t blank = std::min(source.rest.find_first_not_of(white), source.rest.size());
    advance(source, blank);
    if (!source.rest.starts_with('#')) {
      break;
    }
    advance(source, std::min(source.rest.find('\n'), source.rest.size()));
  }
  return !source.rest.empty();
}

Token Tokens::read_text(Source& source) {
  Token token{.kind = TokenKind::text, .text = {}, .place = source.place};
  for (std::size_t i = 1; i < std::min(source.rest.size(), word_bytes_max) && source.rest[i] != '\n'; ++i) {
    if (source.rest[i] == '"') {
      advance(source, i + 1);
      return token;
    }
    if (source.rest[i] == '\\') {
      const char letter = i + 1 < source.rest.size() ? escaped(source.rest[i + 1]) : '\0';
      if (letter == '\0') {
        fail(token.place, "a backslash in quotes stands before what means nothing there; expected one of b f n r t \\ ' \"");
      }
      ++i;
      token.text += letter;
      continue;
    }
    if (is_of_no_text(source.rest[i])) {
      fail(token.place, "has a byte that no text has, " + std::to_string(static_cast<unsigned char>(source.rest[i])));
    }
    token.text += source.rest[i];
  }
  fail(token.place, "quotes are not closed in their line, or only after more than 1 MiB");
}

Token Tokens::read_word(Source& source) const {
  const auto ends = [](char letter) { return word_ends.find(letter) != std::string_view::npos || is_of_no_text(letter); };
  const auto end = static_cast<std::size_t>(std::ranges::find_if(source.rest, ends) - source.rest.begin());
  if (end > word_bytes_max) {
    fail(source.place, "has a word of more than 1 MiB, which no scene has");
  }
  Token token{.kind = TokenKind::word, .text = std::string(source.rest.substr(0, end)), .place = source.place};
  if (end < source.rest.size() && is_of_no_text(source.rest[end])) {
    fail(token.place, "has a byte that no text has, " + std::to_string(static_cast<unsigned char>(source.rest[end])));
  }
  advance(source, end);
  return token;
}

Token Tokens::read() {
  while (!skip_blanks(open_.back())) {
    if (open_.size() == 1) {
      return {.kind = TokenKind::end, .text = {}, .place = open_.back().place};
    }
    open_.pop_back();
  }
  Source& source = open_.back();
  if (open_.size() == 1) {
    const auto all = static_cast<double>(std::max<std::size_t>(source.bytes->text().size(), 1));
    const std::uint64_t done = source.bytes->text().size() - source.rest.size();
    if (done >= next_shown_) {
      files_.show_progress(static_cast<float>(static_cast<double>(done) / all));
      next_shown_ = done + source.bytes->text().size() / 100 + 1;
    }
  }
  switch (source.rest[0]) {
    case '"':
      return read_text(source);
    case '[':
    case ']': {
      Token token{.kind = source.rest[0] == '[' ? TokenKind::open : TokenKind::close, .text = {}, .place = source.place};
      advance(source, 1);
      return token;
    }
    default:
      return read_word(source);
  }
}

Token Tokens::next() {
  if (std::exchange(has_next_, false)) {
    return std::move(next_);
  }
  return read();
}

const Token& Tokens::peek() {
  if (!has_next_) {
    next_ = read();
    has_next_ = true;
  }
  return next_;
}

}  // namespace dmpc::apps::pbrt
