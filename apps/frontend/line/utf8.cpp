#include "apps/frontend/line/utf8.h"

namespace dmpc::apps {

namespace {

unsigned char byte_at(std::string_view text, std::size_t index) { return static_cast<unsigned char>(text[index]); }

/// Bytes of the character that begins with this one, as the Unicode standard's table 3-7 has it; 0 if none does.
std::size_t length_of(unsigned char first) {
  return first < 0x80                    ? 1
         : first >= 0xC2 && first < 0xE0 ? 2
         : first >= 0xE0 && first < 0xF0 ? 3
         : first >= 0xF0 && first < 0xF5 ? 4
                                         : 0;
}

/// The least and the most that the second byte may be.
bool is_second(unsigned char first, unsigned char second) {
  const unsigned char least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  return least <= second && second <= most;
}

/// Whether the first `count` bytes can stand together at the front of a character.
bool go_together(std::string_view text, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) {
    const unsigned char byte = byte_at(text, i);
    if (i == 1 ? !is_second(byte_at(text, 0), byte) : (byte & 0xC0U) != 0x80U) {
      return false;
    }
  }
  return true;
}

}  // namespace

Utf8Character first_character(std::string_view text) {
  const std::size_t length = length_of(byte_at(text, 0));
  if (length == 0 || length > text.size() || !go_together(text, length)) {
    return {};
  }
  char32_t code = length == 1 ? byte_at(text, 0) : byte_at(text, 0) & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    code = code << 6U | (byte_at(text, i) & 0x3FU);
  }
  return {length, code};
}

bool is_cut_character(std::string_view text) {
  return text.size() < length_of(byte_at(text, 0)) && go_together(text, text.size());
}

}  // namespace dmpc::apps
