#include "apps/formats/nff_tokens.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <optional>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/byte_order_mark.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

/// The most of one line; a polygon of the most corners has a third of that. And the most of what may stand between two tokens.
constexpr std::size_t line_bytes_max = std::size_t{16} << 20U, blank_bytes_max = std::size_t{64} << 20U;

/// Most lines are much shorter.
constexpr std::size_t first_room_bytes = 4096;

bool looks_like_number(std::string_view token) {
  const std::size_t sign = token.starts_with('-') || token.starts_with('+') ? 1 : 0;
  const std::string_view rest = token.substr(sign);
  return !rest.empty() && ((rest.front() >= '0' && rest.front() <= '9') || (rest.front() == '.' && rest.size() > 1));
}

/// A plus sign is allowed, as strtod allows it.
std::optional<double> number_from(std::string_view token) {
  if (token.starts_with('+') && looks_like_number(token)) {
    token.remove_prefix(1);
  }
  const auto value = number_in<double>(token);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

NffTokens::NffTokens(std::istream& input, const std::string& name)
    : input_(input),
      name_(name),
      room_bytes_(first_room_bytes),
      room_(std::make_unique_for_overwrite<char[]>(first_room_bytes)) {}

std::string quoted(std::string_view token) {
  constexpr std::size_t shown_max = 32;
  std::string text = "'";
  for (const char c : token.substr(0, shown_max)) {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (token.size() > shown_max ? "...'" : "'");
}

bool NffTokens::read_line() {
  position_ = 0;
  text_ = {};
  const std::size_t size = get_line();
  if (size == 0) {
    return false;
  }
  ++line_;
  if (size >= line_bytes_max && !input_.eof()) {
    throw core::InputError(name_ + ":" + std::to_string(line_) + ": found a line of more than " + mebibytes_text(line_bytes_max) +
                           ", expected an NFF scene");
  }
  text_ = {room_.get(), input_.eof() ? size : size - 1};
  bytes_read_ += text_.size() + 1;
  if (bytes_read_ > token_bytes_ + blank_bytes_max) {
    throw core::InputError(name_ + ":" + std::to_string(line_) + ": found nothing but blanks and comments for " +
                           mebibytes_text(blank_bytes_max) + ", expected an NFF scene");
  }
  position_ = line_ == 1 && text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  return true;
}

std::size_t NffTokens::get_line() {
  std::size_t size = get_part(0);
  while (size + 1 == room_bytes_ && input_.fail() && !input_.eof() && room_bytes_ <= line_bytes_max) {
    grow_room();
    input_.clear(input_.rdstate() & ~std::ios::failbit);
    size += get_part(size);
  }
  return size;
}

std::size_t NffTokens::get_part(std::size_t size) {
  input_.getline(room_.get() + size, static_cast<std::streamsize>(room_bytes_ - size));
  if (input_.bad()) {
    throw core::InputError(name_ + ": reading failed after line " + std::to_string(line_));
  }
  return static_cast<std::size_t>(input_.gcount());
}

void NffTokens::grow_room() {
  const std::size_t bytes = std::min(2 * room_bytes_, line_bytes_max + 1);
  auto room = std::make_unique_for_overwrite<char[]>(bytes);
  std::copy_n(room_.get(), room_bytes_, room.get());
  room_ = std::move(room);
  room_bytes_ = bytes;
}

std::string_view NffTokens::peek() {
  while (token_.empty()) {
    const std::size_t start = text_.find_first_not_of(blanks, position_);
    if (start == std::string_view::npos || text_[start] == '#') {
      if (!read_line()) {
        break;
      }
      continue;
    }
    const std::size_t end = std::min(text_.find_first_of(" \t\r\v\f#", start), text_.size());
    token_ = text_.substr(start, end - start);
    token_bytes_ = bytes_read_;
    position_ = end;
  }
  return token_;
}

std::string_view NffTokens::take() {
  const std::string_view token = peek();
  token_ = {};
  taken_line_ = line_;
  return token;
}

std::string NffTokens::found() {
  const std::string_view token = peek();
  return token.empty() ? "the file ends here" : "found " + quoted(token);
}

double NffTokens::number(const char* entity, const char* what) {
  const std::optional<double> value = number_from(peek());
  if (!value) {
    const std::string expected = std::string(what) + " of " + entity;
    fail_at_next(peek().empty() ? "the file ends here, expected " + expected + "; is it cut off?"
                                : "found " + quoted(peek()) + ", expected " + expected +
                                      ", a finite number; correct it or add what is missing");
  }
  take();
  return *value;
}

int NffTokens::integer(const char* entity, const char* what, int low, int high) {
  const double value = number(entity, what);
  if (!(value >= low && value <= high) || value != std::floor(value)) {
    fail("found " + shortest(value) + " as " + what + " of " + entity + ", expected an integer from " + std::to_string(low) +
         " to " + std::to_string(high) + "; correct it");
  }
  return static_cast<int>(value);
}

bool NffTokens::next_is_number() { return looks_like_number(peek()); }

void NffTokens::skip_numbers_on_line() {
  const std::size_t line = taken_line_;
  while (next_is_number() && line_ == line) {
    take();
  }
}

void NffTokens::fail(const std::string& message) const {
  throw core::InputError(name_ + ":" + std::to_string(taken_line_) + ": " + message);
}

void NffTokens::fail_at_next(const std::string& message) {
  peek();
  throw core::InputError(name_ + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + message);
}

}  // namespace dmpc::apps
