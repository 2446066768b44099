#include "apps/foreign/mesh/ply_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Words = std::vector<std::string_view>;

struct Property {
  std::string_view type, count_type;  ///< the second of a list's length; else empty
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string_view format;
  std::vector<Element> elements;
};

bool is_white(char letter) { return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n'; }

Words words_of(std::string_view line) {
  Words words;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = at;
    while (end < line.size() && !is_white(line[end])) {
      ++end;
    }
    if (end > at) {
      words.push_back(line.substr(at, end - at));
    }
    at = end + 1;
  }
  return words;
}

/// 0 for what is no type.
std::size_t bytes_of_type(std::string_view type) {
  static const std::map<std::string_view, std::size_t> sizes = {
      {"char", 1}, {"uchar", 1}, {"int8", 1},  {"uint8", 1},  {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
      {"int", 4},  {"uint", 4},  {"int32", 4}, {"uint32", 4}, {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Takes a file apart from the front.
class Reader {
 public:
  explicit Reader(std::string_view file) : rest_(file) {}

  Header header();
  void check_body(const Header& header);

 private:
  [[noreturn]] void fail(const std::string& what) const { throw core::InputError("line " + std::to_string(line_) + ": " + what); }
  [[noreturn]] void fail_short(const Element& element, std::uint64_t i) const {
    throw core::InputError("the file is cut short: it ends within element '" + std::string(element.name) + "' " +
                           std::to_string(i + 1) + " of " + std::to_string(element.count));
  }
  std::string_view line();
  void add_element(const Words& words, Header& header) const;
  void add_property(const Words& words, Header& header) const;
  void check_binary(const Element& element, bool is_big_endian);
  void check_text(const Element& element);
  std::uint64_t length_of(std::size_t bytes, bool is_big_endian) const;
  std::string_view word();

  std::string_view rest_;
  std::size_t line_ = 0;
};

std::string_view Reader::line() {
  const std::size_t end = rest_.find_first_of("\r\n");
  if (end == std::string_view::npos) {
    ++line_;
    fail("the file ends within its header; expected 'end_header' at its end");
  }
  const std::string_view text = rest_.substr(0, end);
  rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
  ++line_;
  return text;
}

void Reader::add_element(const Words& words, Header& header) const {
  const auto count = words.size() == 3 ? whole_number(words[2]) : std::nullopt;
  if (!count) {
    fail("expected 'element NAME COUNT'");
  }
  header.elements.push_back({words[1], *count, {}});
}

void Reader::add_property(const Words& words, Header& header) const {
  const bool is_list = words.size() == 5 && words[1] == "list";
  const bool has_types =
      is_list ? bytes_of_type(words[2]) > 0 && bytes_of_type(words[3]) > 0 : words.size() == 3 && bytes_of_type(words[1]) > 0;
  if (!has_types || header.elements.empty()) {
    fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' below an element, with a type such as float or uchar");
  }
  header.elements.back().properties.push_back(is_list ? Property{words[3], words[2]} : Property{words[1], {}});
}

Header Reader::header() {
  Header header;
  if (words_of(line()) != Words{"ply"}) {
    fail("is no PLY: expected 'ply' in the first line");
  }
  for (;;) {
    const Words words = words_of(line());
    const std::string_view first = words.empty() ? "" : words[0];
    if (first == "end_header") {
      break;
    }
    if (first == "format" && words.size() > 1) {
      header.format = words[1];
    } else if (first == "element") {
      add_element(words, header);
    } else if (first == "property") {
      add_property(words, header);
    }  // comments, obj_info, and what Blender 2.47 wrote without calling it one
  }
  if (header.format != "ascii" && header.format != "binary_little_endian" && header.format != "binary_big_endian") {
    fail("the header names no format; expected ascii, binary_little_endian or binary_big_endian");
  }
  return header;
}

std::uint64_t Reader::length_of(std::size_t bytes, bool is_big_endian) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const auto byte = static_cast<unsigned char>(rest_[is_big_endian ? i : bytes - 1 - i]);
    value = value << 8U | byte;
  }
  return value;
}

void Reader::check_binary(const Element& element, bool is_big_endian) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    for (const Property& property : element.properties) {
      const std::size_t count_bytes = bytes_of_type(property.count_type), bytes = bytes_of_type(property.type);
      if (rest_.size() < count_bytes) {
        fail_short(element, i);
      }
      const std::uint64_t length = property.count_type.empty() ? 1 : length_of(count_bytes, is_big_endian);
      rest_.remove_prefix(count_bytes);
      if (length > rest_.size() / bytes) {
        fail_short(element, i);
      }
      rest_.remove_prefix(length * bytes);
    }
  }
}

/// The next word; nothing at the end. Comments are passed over, as Assimp does.
std::string_view Reader::word() {
  for (;;) {
    while (!rest_.empty() && is_white(rest_.front())) {
      rest_.remove_prefix(1);
    }
    std::size_t end = 0;
    while (end < rest_.size() && !is_white(rest_[end])) {
      ++end;
    }
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(word == "comment" ? std::min(rest_.size(), rest_.find('\n')) : end);
    if (word != "comment") {
      return word;
    }
  }
}

void Reader::check_text(const Element& element) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    for (const Property& property : element.properties) {
      const std::string_view first = word();
      const auto length = property.count_type.empty() ? std::optional<std::uint64_t>(0) : whole_number(first);
      if (first.empty()) {
        fail_short(element, i);
      }
      if (!length) {
        throw core::InputError("element '" + std::string(element.name) + "' " + std::to_string(i + 1) + ": found '" +
                               std::string(first.substr(0, 40)) + "', expected the length of a list");
      }
      for (std::uint64_t k = 0; k < *length; ++k) {
        if (word().empty()) {
          fail_short(element, i);
        }
      }
    }
  }
}

void Reader::check_body(const Header& header) {
  for (const Element& element : header.elements) {
    header.format == "ascii" ? check_text(element) : check_binary(element, header.format == "binary_big_endian");
  }
}

}  // namespace

bool has_ply_material(std::string_view file) {
  const std::vector<Element> elements = Reader(file).header().elements;
  return std::any_of(elements.begin(), elements.end(), [](const Element& element) { return element.name == "material"; });
}

void check_ply(std::string_view file) {
  Reader reader(file);
  reader.check_body(reader.header());
}

}  // namespace dmpc::apps
