// The tags of a text in XML, where it lies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace dmpc::apps {

/// A tag without its angles: "input semantic='TEXCOORD' set='1'", "lambert/", "/lambert".
struct Tag {
  std::string_view inside;
  std::size_t begin = 0, end = 0;  ///< of its angles, one past the last

  bool is(std::string_view name) const {
    return inside.starts_with(name) &&
           (inside.size() == name.size() || std::string_view(" \t\r\n/").find(inside[name.size()]) != std::string_view::npos);
  }
  bool is_whole() const { return inside.ends_with('/'); }
  /// Where what follows the name stands in the text: the place for another attribute.
  std::size_t end_of_name() const { return begin + 1 + inside.substr(0, inside.find_first_of(" \t\r\n/")).size(); }
};

/// Where `mark` ends, or the text.
inline std::size_t behind(std::string_view text, std::string_view mark, std::size_t from) {
  const std::size_t at = text.find(mark, from);
  return at == std::string_view::npos ? text.size() : at + mark.size();
}

/// Calls take(tag) for each that stands in no comment and no verbatim text.
template <class Take>
void for_each_tag(std::string_view text, const Take& take) {
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(text, "-->", at);
    } else if (rest.starts_with("<![CDATA[")) {
      at = behind(text, "]]>", at);
    } else {
      const std::size_t end = behind(text, ">", at);
      if (text[end - 1] == '>' && end > at + 2) {
        take(Tag{text.substr(at + 1, end - at - 2), at, end});
      }
      at = end;
    }
  }
}

/// What stands between a tag and the next; nothing behind one that is whole.
inline std::string_view content(std::string_view text, const Tag& tag) {
  return tag.is_whole() ? std::string_view() : text.substr(tag.end, text.find('<', tag.end) - tag.end);
}

/// Calls take(word) for each word between these letters.
template <class Take>
void for_each_word(std::string_view text, std::string_view between, const Take& take) {
  for (std::size_t at = text.find_first_not_of(between); at != std::string_view::npos; at = text.find_first_not_of(between, at)) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    take(text.substr(at, end - at));
    at = end;
  }
}

/// Throws core::InputError "line 3: WHAT", by where in `text` that is.
[[noreturn]] void refuse_at(std::string_view text, std::size_t at, const std::string& what);

/// The value of an attribute, a part of the text; nothing if the tag has none of this name.
std::optional<std::string_view> attribute(const Tag& tag, std::string_view name);

/// The same, or nothing between its quotes.
inline std::string value_of(const Tag& tag, std::string_view name) {
  return std::string(attribute(tag, name).value_or(std::string_view()));
}

/// A text, in which some is put, or left out, from its begin to its end. What comes too late for that is not done: tags that
/// are not closed may lie in two others.
class Filled {
 public:
  explicit Filled(std::string_view text) : text_(text) {}

  /// Before what stands there.
  void insert(std::size_t at, std::string_view what) {
    if (at >= taken_) {
      take_up_to(at);
      result_ += what;
    }
  }
  void leave_out(std::size_t begin, std::size_t end) {
    if (begin >= taken_) {
      take_up_to(begin);
      taken_ = end;
    }
  }
  /// `part` is a part of the text.
  std::size_t place_of(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }
  std::string finish() {
    take_up_to(text_.size());
    return std::move(result_);
  }

 private:
  void take_up_to(std::size_t at) {
    result_ += text_.substr(taken_, at - taken_);
    taken_ = at;
  }

  std::string_view text_;
  std::size_t taken_ = 0;
  std::string result_;
};

}  // namespace dmpc::apps
