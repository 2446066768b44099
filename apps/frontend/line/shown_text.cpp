#include "apps/frontend/line/shown_text.h"

#include <algorithm>
#include <sstream>

#include "apps/frontend/line/utf8.h"

namespace dmpc::apps {

namespace {

/// Controls, and what changes the direction of writing or begins a line without being a line's end.
bool steers(char32_t code) {
  const bool is_control = (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7F && code < 0xA0);
  const bool is_direction = code == 0x61C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
                            (code >= 0x2066 && code <= 0x2069);
  return is_control || is_direction || code == 0x2028 || code == 0x2029;
}

/// Bytes at the front of the text that are shown as they are.
std::size_t plain_bytes(std::string_view text) {
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const Utf8Character next = first_character(text.substr(bytes));
    if (next.bytes == 0 || steers(next.code)) {
      break;
    }
    bytes += next.bytes;
  }
  return bytes;
}

}  // namespace

void ShownBuffer::put(std::string_view text) {
  const auto size = static_cast<std::streamsize>(text.size());
  is_whole_ = target_.sputn(text.data(), size) == size && is_whole_;
}

void ShownBuffer::put_unchanged(std::string_view text) {
  const std::lock_guard lock(one_at_a_time_);
  end();
  put(text);
}

void ShownBuffer::end() {
  const std::lock_guard lock(one_at_a_time_);
  while (kept_bytes_ > 0) {
    put_kept();
  }
}

ShownBuffer::int_type ShownBuffer::overflow(int_type character) {
  const std::lock_guard lock(one_at_a_time_);
  if (traits_type::eq_int_type(character, traits_type::eof())) {
    return traits_type::not_eof(character);
  }
  kept_[kept_bytes_++] = traits_type::to_char_type(character);
  while (kept_bytes_ > 0 && !is_cut_character({kept_.data(), kept_bytes_})) {
    put_kept();
  }
  return is_whole_ ? character : traits_type::eof();
}

/// In pieces as long as can be, since a terminal's stream hands on each at once.
std::streamsize ShownBuffer::xsputn(const char* text, std::streamsize size) {
  const std::lock_guard lock(one_at_a_time_);
  std::string_view left(text, static_cast<std::size_t>(size));
  while (!left.empty()) {
    const std::size_t plain = kept_bytes_ == 0 ? plain_bytes(left) : 0;
    if (plain > 0) {
      put(left.substr(0, plain));
    } else {
      overflow(traits_type::to_int_type(left.front()));
    }
    left.remove_prefix(plain > 0 ? plain : 1);
  }
  return is_whole_ ? size : 0;
}

int ShownBuffer::sync() {
  const std::lock_guard lock(one_at_a_time_);
  return target_.pubsync() == 0 && is_whole_ ? 0 : -1;
}

/// The first character that is kept, or if there is none, the first byte.
void ShownBuffer::put_kept() {
  const std::string_view kept(kept_.data(), kept_bytes_);
  const Utf8Character first = first_character(kept);
  const std::size_t bytes = first.bytes == 0 ? 1 : first.bytes;
  if (first.bytes == 0) {
    put_escaped('x', static_cast<unsigned char>(kept.front()), 2);
  } else if (steers(first.code)) {
    put_escaped(first.code < 0x80 ? 'x' : 'u', first.code, first.code < 0x80 ? 2 : 4);
  } else {
    put(kept.substr(0, bytes));
  }
  kept_bytes_ -= bytes;
  for (std::size_t i = 0; i < kept_bytes_; ++i) {
    kept_[i] = kept_[i + bytes];
  }
}

void ShownBuffer::put_escaped(char letter, char32_t code, int digits) {
  std::array<char, 6> text{'\\', letter};
  for (int i = 0; i < digits; ++i) {
    text[static_cast<std::size_t>(2 + i)] = "0123456789abcdef"[code >> (4 * (digits - 1 - i)) & 0xFU];
  }
  put({text.data(), static_cast<std::size_t>(2 + digits)});
}

ShownOutput::~ShownOutput() {
  buffer_.end();
  const std::ios_base::iostate state = stream_.rdstate();
  stream_.rdbuf(before_);  // forgets the state
  stream_.setstate(state);
}

std::string shown(std::string_view text) {
  std::ostringstream stream;
  {
    const ShownOutput output(stream);
    stream << text;
  }
  return stream.str();
}

std::string clipped(std::string_view text, std::size_t bytes_max) {
  std::string line = shown(text.substr(0, bytes_max));
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line + (text.size() > bytes_max ? " ... (" + std::to_string(text.size()) + " bytes)" : "");
}

std::string with_words_clipped(std::string_view text) {
  constexpr std::size_t word_bytes_max = 4096, kept_bytes = 200;
  std::string clipped_text;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size()), next = std::min(end + 1, text.size());
    clipped_text += end <= word_bytes_max ? std::string(text.substr(0, end))
                                          : std::string(text.substr(0, kept_bytes)) + "...(" + std::to_string(end) + " bytes)";
    clipped_text += text.substr(end, next - end);
    text.remove_prefix(next);
  }
  return clipped_text;
}

std::ostream& clear_line(std::ostream& stream) {
  constexpr const char* words = "\r\x1b[K";
  if (auto* const buffer = dynamic_cast<ShownBuffer*>(stream.rdbuf())) {
    buffer->put_unchanged(words);
    return stream;
  }
  return stream << words;
}

}  // namespace dmpc::apps
