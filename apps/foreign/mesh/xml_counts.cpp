#include "apps/foreign/mesh/xml_counts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "apps/edge/line/parsed_number.h"
#include "apps/edge/line/shown_text.h"
#include "apps/foreign/text/xml_tags.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view blanks = " \t\r\n";

template <std::size_t count>
bool is_one_of(const Tag& tag, const std::array<const char*, count>& names) {
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return tag.is(name); });
}

class Counts {
 public:
  explicit Counts(std::string_view file) : file_(file) {}

  void take_collada(const Tag& tag);
  void check_accessors() const;
  void take_amf(const Tag& tag);

 private:
  struct Accessor {
    std::string array;
    std::uint64_t values_end;  ///< of those that it looks at
    std::size_t at;
  };

  [[noreturn]] void refuse(std::size_t at, const std::string& what) const { refuse_at(file_, at, what); }
  /// An attribute's; `standard` if it is not there. No number of a file exceeds its bytes, but for what is a lie.
  std::uint64_t number_of(const Tag& tag, const char* name, std::uint64_t standard) const;
  void take_array(const Tag& tag);
  void take_accessor(const Tag& tag);
  void check_whole(const Tag& tag) const;

  std::string_view file_;
  std::map<std::string, std::uint64_t> arrays_;
  std::vector<Accessor> accessors_;
  std::size_t group_ = 0;      ///< where AMF's last vertex or triangle begins
  std::uint32_t members_ = 0;  ///< a bit for each of its three that has been there
};

std::uint64_t Counts::number_of(const Tag& tag, const char* name, std::uint64_t standard) const {
  const auto text = attribute(tag, name);
  const auto number = text ? number_in<std::uint64_t>(*text) : std::optional(standard);
  if (!number || *number > file_.size()) {
    refuse(tag.begin, "found " + std::string(name) + "=\"" + clipped(std::string(*text), 40) +
                          "\", expected a whole number that the file has room for");
  }
  return *number;
}

void Counts::take_array(const Tag& tag) {
  std::uint64_t values = 0;
  for_each_word(content(file_, tag), blanks, [&](std::string_view) { ++values; });
  if (const std::uint64_t said = number_of(tag, "count", values); said != values) {
    refuse(tag.begin, "an array says that it has " + std::to_string(said) + " values, and has " + std::to_string(values));
  }
  arrays_[value_of(tag, "id")] = values;
}

void Counts::take_accessor(const Tag& tag) {
  const std::string source = value_of(tag, "source");
  const std::uint64_t count = number_of(tag, "count", 0), stride = number_of(tag, "stride", 1),
                      offset = number_of(tag, "offset", 0);
  if (count > 0 && stride > file_.size() / count) {
    refuse(tag.begin, "an accessor looks at more values than the file has");
  }
  accessors_.push_back({source.substr(source.starts_with('#') ? 1 : 0), offset + count * stride, tag.begin});
}

void Counts::check_accessors() const {
  for (const Accessor& accessor : accessors_) {
    const auto array = arrays_.find(accessor.array);
    if (array != arrays_.end() && accessor.values_end > array->second) {
      refuse(accessor.at, "an accessor looks at " + std::to_string(accessor.values_end) + " values of an array that has " +
                              std::to_string(array->second));
    }
  }
}

void Counts::check_whole(const Tag& tag) const {
  for_each_word(content(file_, tag), blanks, [&](std::string_view word) {
    if (!number_in<std::uint64_t>(word)) {
      refuse(static_cast<std::size_t>(word.data() - file_.data()),
             "found '" + clipped(std::string(word), 40) + "', expected a whole number from 0 on");
    }
  });
}

void Counts::take_collada(const Tag& tag) {
  constexpr std::array primitives{"triangles", "polylist", "polygons", "lines", "linestrips", "tristrips", "trifans"};
  if (tag.is("float_array")) {
    take_array(tag);
  } else if (tag.is("accessor")) {
    take_accessor(tag);
  } else if (is_one_of(tag, primitives)) {
    number_of(tag, "count", 0);
  } else if (tag.is("p") || tag.is("vcount") || tag.is("ph")) {
    check_whole(tag);
  } else if (tag.is("skew")) {
    refuse(tag.begin, "a node is skewed, which is not shown; write its transforms as one matrix");
  }
}

void Counts::take_amf(const Tag& tag) {
  constexpr std::array groups{"coordinates", "triangle"}, ends{"/coordinates", "/triangle"};
  constexpr std::array members{"x", "y", "z", "v1", "v2", "v3"};
  if (is_one_of(tag, groups)) {
    group_ = tag.begin;
    members_ = 0;
  } else if (is_one_of(tag, ends)) {
    const bool is_vertex = tag.is("/coordinates");
    if (members_ != (is_vertex ? 0b000111U : 0b111000U)) {
      refuse(group_, is_vertex ? "expected an x, a y and a z" : "expected a v1, a v2 and a v3");
    }
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (tag.is(members[i])) {
      std::size_t words = 0;
      for_each_word(content(file_, tag), blanks, [&](std::string_view) { ++words; });
      if (words != 1) {
        refuse(tag.begin, std::string("expected one number in <") + members[i] + ">");
      }
      if (i >= 3) {
        check_whole(tag);
      }
      members_ |= 1U << i;
    }
  }
}

}  // namespace

void check_counts(std::string_view file, const std::string& ending) {
  Counts counts(file);
  if (ending == "dae") {
    for_each_tag(file, [&](const Tag& tag) { counts.take_collada(tag); });
    counts.check_accessors();
  } else if (ending == "amf") {
    for_each_tag(file, [&](const Tag& tag) { counts.take_amf(tag); });
  }
}

}  // namespace dmpc::apps
