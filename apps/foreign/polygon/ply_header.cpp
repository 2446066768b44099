#include "apps/foreign/polygon/ply_header.h"

#include <array>
#include <map>

#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/small_letters.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::optional<PlyType> type_of(std::string_view name) {
  using enum PlyType;
  static const std::map<std::string_view, PlyType> types = {
      {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},    {"short", int16}, {"int16", int16},
      {"ushort", uint16}, {"uint16", uint16},   {"int", int32},      {"int32", int32},    {"uint", uint32}, {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(std::string_view file) : file_(file) {}

  PlyHeader read() {
    if (LineWords words(next_line(), 1, without_remarks); in_small_letters(words.next()) != "ply" || !words.next().empty()) {
      fail("is no PLY: expected 'ply' in the first line");
    }
    while (!read_line(next_line())) {
    }
    if (!format_) {
      fail("the header names no format; expected ascii, binary_little_endian or binary_big_endian");
    }
    if (strange_lines_ > 0) {
      header_.notes.push_back("lines of the header that PLY does not know, which are passed over: " + grouped(strange_lines_) +
                              ", such as " + strange_);
    }
    header_.format = *format_;
    header_.bytes = at_;
    header_.lines = line_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw core::InputError("line " + std::to_string(line_) + ": " + what); }

  std::string_view next_line() {
    constexpr std::string_view ends("\r\n\0", 3);  // \0 occurs in a hole of a file, which may be long
    const std::size_t end = file_.find_first_of(ends, at_);
    ++line_;
    if (end == std::string_view::npos) {
      fail("the file ends within its header; expected 'end_header' at its end");
    }
    if (file_[end] == '\0') {
      fail("expected text, found byte 0; write the file anew");
    }
    const std::string_view text = file_.substr(at_, end - at_);
    const bool ends_by_both = file_.substr(end, 2) == "\r\n";
    if (line_ == 1) {
      ends_by_return_ = file_[end] == '\r' && !ends_by_both;
    }
    at_ = end + (ends_by_both && !ends_by_return_ ? 2 : 1);
    return text;
  }

  /// Returns whether that was the last line.
  bool read_line(std::string_view line) {
    LineWords words(line, line_, without_remarks);
    const std::string_view first = words.next();
    if (first == "end_header") {
      return true;
    }
    if (first == "format") {
      add_format(words, line);
    } else if (first == "element") {
      add_element(words, line);
    } else if (first == "property") {
      add_property(words, line);
    } else if (first == "comment") {
      add_comment(words);
    } else if (!first.empty() && first != "obj_info" && ++strange_lines_ == 1) {  // as written by Blender 2.47
      strange_ = "line " + std::to_string(line_) + ", '" + clipped(line, 40) + "'";
    }
    return false;
  }

  void add_format(LineWords& words, std::string_view line) {
    static const std::map<std::string_view, PlyFormat> formats = {{"ascii", PlyFormat::text},
                                                                  {"binary_little_endian", PlyFormat::little_endian},
                                                                  {"binary_big_endian", PlyFormat::big_endian}};
    const auto found = formats.find(words.next());
    if (found == formats.end()) {
      words.fail_at(line, "'format' and ascii, binary_little_endian or binary_big_endian");
    }
    format_ = found->second;
  }

  void add_element(LineWords& words, std::string_view line) {
    const std::string_view name = words.next();
    const auto count = number_in<std::uint64_t>(words.next());
    if (!count || !words.next().empty()) {
      words.fail_at(line, "'element NAME COUNT', with a whole number from 0 on");
    }
    header_.elements.push_back({name, *count, {}});
  }

  void add_property(LineWords& words, std::string_view line) {
    PlyProperty property;
    std::string_view word = words.next();
    const bool is_list = word == "list";
    if (is_list) {
      property.count_type = type_of(words.next());
      word = words.next();
    }
    const auto type = type_of(word);
    property.name = words.next();
    if (!type || (is_list && !property.count_type) || property.name.empty() || !words.next().empty() ||
        header_.elements.empty()) {
      words.fail_at(
          line, "'property TYPE NAME' or 'property list TYPE TYPE NAME' below an element, with a type such as float or uchar");
    }
    property.type = *type;
    header_.elements.back().properties.push_back(property);
  }

  void add_comment(LineWords& words) {
    if (words.next() == "TextureFile") {
      header_.textures.emplace_back(words.rest_of_line());
    }
  }

  std::string_view file_;
  std::size_t at_ = 0, line_ = 0;
  bool ends_by_return_ = false;  ///< for every line, so that a first byte \n belongs to the body
  PlyHeader header_;
  std::optional<PlyFormat> format_;
  std::uint64_t strange_lines_ = 0;
  std::string strange_;  ///< the first one
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> bytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

bool is_whole(PlyType type) { return type < PlyType::float32; }

double least_of(PlyType type) {
  constexpr std::array<double, 6> least = {-0x1p7, 0, -0x1p15, 0, -0x1p31, 0};
  return least[static_cast<std::size_t>(type)];
}

double most_of(PlyType type) {
  constexpr std::array<double, 6> most = {0x1p7 - 1, 0x1p8 - 1, 0x1p15 - 1, 0x1p16 - 1, 0x1p31 - 1, 0x1p32 - 1};
  return most[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(std::string_view file) { return PlyHeaderReader(file).read(); }

}  // namespace dmpc::apps
