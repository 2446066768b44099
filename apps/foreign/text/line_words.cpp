#include "apps/foreign/text/line_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/small_letters.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f'; }
bool is_line_end(char letter) { return letter == '\n' || letter == '\r'; }

std::string_view trimmed_end(std::string_view text) { return text.substr(0, text.find_last_not_of(" \t\v\f") + 1); }

std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return word.substr(has_plus ? 1 : 0);
}

/// Returns the value of a number that std::from_chars finds too large or too small.
std::optional<double> extreme_number(std::string_view word) {
  const double value = std::strtod(std::string(word).c_str(), nullptr);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string_view without_quotes(std::string_view name) {
  const bool is_quoted = name.size() > 2 && name.front() == '"' && name.find('"', 1) == name.size() - 1;
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

}  // namespace

std::optional<double> decimal_number(std::string_view word) {
  const std::string_view plain = without_plus(word);
  const std::string_view digits = plain.substr(plain.starts_with('-') ? 1 : 0);
  if (digits.empty() || (digits[0] != '.' && std::isdigit(static_cast<unsigned char>(digits[0])) == 0)) {
    return std::nullopt;  // "nan", "inf"
  }
  double value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (end != plain.data() + plain.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  return error == std::errc{} ? std::optional(value) : extreme_number(plain);
}

bool is_no_number(std::string_view word) {
  word.remove_prefix(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
  const std::string small = in_small_letters(word);
  return small.starts_with("nan") || small == "inf" || small == "infinity" || small.starts_with("1.#");
}

bool LineWords::is_at_join() const {
  return rules_.are_one && text_[at_] == '\\' && at_ + 1 < text_.size() && is_line_end(text_[at_ + 1]);
}

/// "-1.#IND", which one library writes for a non-finite number, is one word; otherwise it would be read as -1.
bool LineWords::is_at_remark() const {
  return rules_.remark != '\0' && text_[at_] == rules_.remark && (at_ == 0 || text_[at_ - 1] != '.');
}

/// Handles NUL bytes in a file with a hole, which may be long: each byte is a word of its own.
bool LineWords::is_in_hole() const { return !rules_.are_one && at_ < text_.size() && text_[at_] == '\0'; }

void LineWords::skip_line_end() {
  at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++line_;
}

void LineWords::skip_blanks() {
  while (at_ < text_.size() && (is_blank(text_[at_]) || is_at_join())) {
    if (text_[at_++] == '\\') {
      skip_line_end();
    }
  }
}

std::size_t LineWords::end_of_line() const {
  return rules_.are_one ? text_.size() : std::min(text_.find_first_of("\r\n", at_), text_.size());
}

void LineWords::skip_to_word() {
  skip_blanks();
  if (at_ < text_.size() && is_at_remark()) {
    at_ = end_of_line();
  }
}

std::string_view LineWords::next_in_line() {
  skip_to_word();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_]) && !is_in_hole() && !is_at_remark() &&
         !is_at_join()) {
    ++at_;
  }
  at_ += at_ == begin && is_in_hole() ? 1 : 0;
  return text_.substr(begin, at_ - begin);
}

std::string_view LineWords::next() {
  for (skip_to_word(); at_ < text_.size() && is_line_end(text_[at_]); skip_to_word()) {
    skip_line_end();
  }
  return next_in_line();
}

std::string_view LineWords::rest_of_line() {
  skip_blanks();
  const std::size_t begin = std::exchange(at_, end_of_line());
  return trimmed_end(text_.substr(begin, at_ - begin));
}

void LineWords::fail(const std::string& what) const { throw core::InputError("line " + std::to_string(line_) + ": " + what); }

void LineWords::fail_at(std::string_view word, const std::string& expected) const {
  const std::string end = rules_.are_one ? "found the end of the line" : "the file is cut short";
  fail((word.empty() ? end : "found '" + clipped(word, 60) + "'") + ", expected " + expected);
}

double LineWords::number(const std::string& what) {
  const std::string_view word = next();
  const auto value = decimal_number(word);
  if (!value) {
    fail_at(word, what);
  }
  return *value;
}

std::int64_t LineWords::integer() {
  const std::string_view word = next();
  const auto value = number_in<std::int64_t>(without_plus(word));
  if (!value) {
    fail_at(word, "a whole number");
  }
  return *value;
}

void LineWords::expect_end() const {
  LineWords words = *this;
  if (const std::string_view word = words.next(); !word.empty()) {
    words.fail_at(word, "the end of the line");
  }
}

std::string_view without_remark(std::string_view name) {
  for (std::size_t at = name.find('#'); at != std::string_view::npos; at = name.find('#', at + 1)) {
    if (at == 0 || is_blank(name[at - 1])) {
      return trimmed_end(name.substr(0, at));
    }
  }
  return name;
}

std::string_view plain_name(std::string_view name) {
  const std::string_view inside = without_quotes(name);
  return inside.size() < name.size() ? inside : without_quotes(without_remark(name));
}

}  // namespace dmpc::apps
