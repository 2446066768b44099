#include "apps/foreign/mesh/collada_text.h"

#include <charconv>
#include <cstddef>
#include <utility>

namespace dmpc::apps {
namespace {

constexpr std::string_view no_highlight = "<specular><color>0 0 0 1</color></specular><shininess><float>0</float></shininess>";

/// A tag without its angles: "input semantic='TEXCOORD' set='1'", "lambert/", "/lambert".
struct Tag {
  std::string_view inside;
  std::size_t begin = 0, end = 0;  ///< of its angles, one past the last

  bool is(std::string_view name) const {
    return inside.starts_with(name) &&
           (inside.size() == name.size() || std::string_view(" \t\r\n/").find(inside[name.size()]) != std::string_view::npos);
  }
  bool is_whole() const { return inside.ends_with('/'); }
};

/// Where `mark` ends, or the text.
std::size_t behind(std::string_view text, std::string_view mark, std::size_t from) {
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

/// The value of an attribute; nothing if it has none of this name.
std::string_view attribute(const Tag& tag, std::string_view name) {
  for (std::size_t at = tag.inside.find(name); at != std::string_view::npos; at = tag.inside.find(name, at + 1)) {
    const std::string_view rest = tag.inside.substr(at + name.size());
    const bool is_word = at > 0 && std::string_view(" \t\r\n").find(tag.inside[at - 1]) != std::string_view::npos;
    if (is_word && rest.size() > 2 && rest[0] == '=' && (rest[1] == '"' || rest[1] == '\'')) {
      return rest.substr(2, rest.find(rest[1], 2) - 2);
    }
  }
  return {};
}

/// What is put into the text before `at`.
class Filled {
 public:
  explicit Filled(std::string_view text) : text_(text) {}

  void insert(std::size_t at, std::string_view what) {
    take_up_to(at);
    result_ += what;
  }
  void leave_out(std::size_t begin, std::size_t end) {
    take_up_to(begin);
    taken_ = end;
  }
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

void fill_effect(const Tag& tag, Filled& filled) {
  for (const std::string name : {"lambert", "constant", "phong", "blinn"}) {
    const bool has_highlight = name == "phong" || name == "blinn";
    if (tag.is(name) && tag.is_whole()) {
      filled.leave_out(tag.end - 2, tag.end);
      filled.insert(tag.end, ">" + std::string(no_highlight) + "</" + name + ">");
    } else if (tag.is(name) && has_highlight) {
      filled.insert(tag.end, no_highlight);  // what the file says follows, and counts
    } else if (tag.is("/" + name) && !has_highlight) {
      filled.insert(tag.begin, no_highlight);
    }
  }
}

void fill_camera(std::string_view text, const Tag& tag, Filled& filled) {
  if (tag.is("camera") && !tag.is_whole() && attribute(tag, "name").empty()) {
    filled.insert(tag.end - 1, " name=\"" + std::string(attribute(tag, "id")) + "\"");
  }
  if (!tag.is("perspective") || tag.is_whole()) {
    return;
  }
  const std::string_view inside = text.substr(tag.end, text.find("</perspective", tag.end) - tag.end);
  const auto has = [&](std::string_view what) { return inside.find(what) != std::string_view::npos; };
  if (has("<yfov") && !has("<xfov") && !has("<aspect_ratio")) {
    filled.insert(tag.end, "<aspect_ratio>1</aspect_ratio>");
  }
}

}  // namespace

std::string collada_in_full(std::string_view text) {
  Filled filled(text);
  for_each_tag(text, [&](const Tag& tag) {
    fill_effect(tag, filled);
    fill_camera(text, tag, filled);
  });
  return filled.finish();
}

std::set<unsigned> collada_texture_sets(std::string_view text) {
  std::set<unsigned> sets;
  for_each_tag(text, [&](const Tag& tag) {
    if (tag.is("input") && attribute(tag, "semantic") == "TEXCOORD") {
      const std::string_view number = attribute(tag, "set");
      unsigned set = 0;
      std::from_chars(number.data(), number.data() + number.size(), set);
      sets.insert(set);
    }
  });
  return sets;
}

}  // namespace dmpc::apps
