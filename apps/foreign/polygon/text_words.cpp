#include "apps/foreign/polygon/text_words.h"

#include <algorithm>
#include <optional>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/mesh/trimmed.h"
#include "apps/foreign/text/line_words.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

bool is_space(char letter) { return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f'; }
bool is_line_end(char letter) { return letter == '\n' || letter == '\r'; }
/// Of a hole in a file, whose end may be far: each is a word of its own.
bool is_no_text(char letter) { return letter == '\0'; }

}  // namespace

void TextWords::skip_blanks() {
  while (at_ < text_.size() && is_space(text_[at_])) {
    ++at_;
  }
  if (at_ < text_.size() && is_at_remark()) {
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  }
}

void TextWords::skip_line_end() {
  at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++line_;
}

std::string_view TextWords::word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) && !is_line_end(text_[at_]) && !is_no_text(text_[at_]) && !is_at_remark()) {
    ++at_;
  }
  at_ += at_ == begin && at_ < text_.size() && is_no_text(text_[at_]) ? 1 : 0;
  return text_.substr(begin, at_ - begin);
}

std::string_view TextWords::next() {
  for (skip_blanks(); at_ < text_.size() && is_line_end(text_[at_]); skip_blanks()) {
    skip_line_end();
  }
  return word();
}

std::string_view TextWords::next_in_line() {
  skip_blanks();
  return word();
}

std::string_view TextWords::rest_of_line() {
  const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  const std::string_view rest = text_.substr(at_, end - at_);
  at_ = end;
  return trimmed(rest);
}

void TextWords::fail(const std::string& what) const { throw core::InputError("line " + std::to_string(line_) + ": " + what); }

void TextWords::fail_at(std::string_view word, const std::string& expected) const {
  fail((word.empty() ? "the file ends" : "found '" + clipped(word, 40) + "'") + ", expected " + expected);
}

double TextWords::number(const std::string& what) {
  const std::string_view word = next();
  const std::optional<double> value = decimal_number(word);
  if (!value) {
    fail_at(word, what);
  }
  return *value;
}

}  // namespace dmpc::apps
