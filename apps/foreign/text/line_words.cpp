#include "apps/foreign/text/line_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "apps/edge/line/parsed_number.h"
#include "apps/edge/line/shown_text.h"
#include "apps/foreign/text/small_letters.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view blank_letters = " \t\v\f\r\n";

bool is_blank_letter(char letter) { return blank_letters.find(letter) != std::string_view::npos; }

/// Whether a line is joined to the next there.
bool is_join(std::string_view text) { return text.size() > 1 && text[0] == '\\' && (text[1] == '\n' || text[1] == '\r'); }

/// "-1.#IND", as one library writes what is no number, is one word: else it would read as -1.
bool begins_remark(std::string_view text, std::size_t at) { return text[at] == '#' && (at == 0 || text[at - 1] != '.'); }

std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return word.substr(has_plus ? 1 : 0);
}

/// One that std::from_chars finds too large or too small.
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

void LineWords::skip_blanks() {
  while (!rest_.empty()) {
    if (is_join(rest_)) {
      rest_.remove_prefix(rest_.substr(1).starts_with("\r\n") ? 3 : 2);
      ++line_number_;
    } else if (is_blank_letter(rest_[0])) {
      rest_.remove_prefix(1);
    } else {
      return;
    }
  }
}

std::string_view LineWords::next() {
  skip_blanks();
  std::size_t end = 0;
  while (end < rest_.size() && !is_blank_letter(rest_[end]) && !begins_remark(rest_, end) && !is_join(rest_.substr(end))) {
    ++end;
  }
  const std::string_view word = rest_.substr(0, end);
  rest_.remove_prefix(end);
  return word;
}

std::string_view LineWords::rest() const {
  LineWords words = *this;
  words.skip_blanks();
  return words.rest_.substr(0, words.rest_.find_last_not_of(blank_letters) + 1);
}

void LineWords::refuse(const std::string& what) const {
  throw core::InputError("line " + std::to_string(line_number_) + ": " + what);
}

double LineWords::number() {
  const std::string_view word = next();
  const auto value = decimal_number(word);
  if (!value) {
    refuse("expected a number, found " + (word.empty() ? "the end of the line" : "'" + clipped(word, 60) + "'"));
  }
  return *value;
}

std::int64_t LineWords::integer() {
  const std::string_view word = next();
  const auto value = number_in<std::int64_t>(without_plus(word));
  if (!value) {
    refuse("expected a whole number, found " + (word.empty() ? "the end of the line" : "'" + clipped(word, 60) + "'"));
  }
  return *value;
}

void LineWords::expect_end() const {
  LineWords words = *this;
  if (const std::string_view word = words.next(); !word.empty()) {
    words.refuse("expected the end of the line, found '" + clipped(word, 60) + "'");
  }
}

std::string_view without_remark(std::string_view name) {
  for (std::size_t at = name.find('#'); at != std::string_view::npos; at = name.find('#', at + 1)) {
    if (at == 0 || is_blank_letter(name[at - 1])) {
      name = name.substr(0, at);
      return name.substr(0, name.find_last_not_of(blank_letters) + 1);
    }
  }
  return name;
}

std::string_view plain_name(std::string_view name) {
  const std::string_view inside = without_quotes(name);
  return inside.size() < name.size() ? inside : without_quotes(without_remark(name));
}

}  // namespace dmpc::apps
