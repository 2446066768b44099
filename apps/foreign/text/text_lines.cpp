#include "apps/foreign/text/text_lines.h"

#include <array>
#include <cstdint>
#include <string>

#include "apps/frontend/system/byte_order_mark.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

enum class Letter : std::uint8_t { text, line_end, none };

constexpr std::array<Letter, 256> make_letters() {
  std::array<Letter, 256> letters{};
  for (std::size_t i = 0; i < 32; ++i) {
    letters[i] = Letter::none;
  }
  letters['\t'] = letters['\v'] = letters['\f'] = Letter::text;
  letters['\n'] = letters['\r'] = Letter::line_end;
  letters[127] = Letter::none;
  return letters;
}

constexpr std::array<Letter, 256> letters = make_letters();

Letter letter_of(char byte) { return letters[static_cast<unsigned char>(byte)]; }

std::string_view without_dos_end(std::string_view file) {
  constexpr char dos_end = 26;
  return file.ends_with(dos_end) ? file.substr(0, file.size() - 1) : file;
}

[[noreturn]] void refuse_byte(char byte, std::size_t line) {
  throw core::InputError("line " + std::to_string(line) + ": expected text, found byte " +
                         std::to_string(static_cast<unsigned char>(byte)) + "; write the file anew, as text");
}

}  // namespace

TextLines::TextLines(std::string_view file, LineJoin join)
    : file_(without_dos_end(file)), join_(join), passed_(file_.size() - without_mark(file_).size()) {}

std::size_t TextLines::end_of_line(std::size_t begin) const {
  std::size_t end = begin;
  for (bool is_remark = false; end < file_.size() && letter_of(file_[end]) != Letter::line_end; ++end) {
    if (letter_of(file_[end]) == Letter::none && !is_remark) {
      is_remark = file_.substr(begin, end - begin).find('#') != std::string_view::npos;
      if (!is_remark) {
        refuse_byte(file_[end], lines_);
      }
    }
  }
  return end;
}

std::size_t TextLines::behind_end(std::size_t end) const {
  return end == file_.size() ? end : end + (file_.substr(end, 2) == "\r\n" ? 2 : 1);
}

/// A comment ends with its line, even if the line ends with a backslash, such as in a folder's name.
bool TextLines::goes_on(std::size_t begin, std::size_t end) const {
  return join_ == LineJoin::backslash && end > begin && end < file_.size() && file_[end - 1] == '\\' &&
         file_.substr(begin, end - begin).find('#') == std::string_view::npos;
}

bool TextLines::next() {
  if (passed_ == file_.size()) {
    return false;
  }
  number_ = lines_;
  const std::size_t first = passed_;
  std::size_t begin = first, end = end_of_line(begin);
  for (++lines_; goes_on(begin, end); ++lines_) {
    begin = behind_end(end);
    end = end_of_line(begin);
  }
  line_ = file_.substr(first, end - first);
  passed_ = behind_end(end);
  return true;
}

}  // namespace dmpc::apps
