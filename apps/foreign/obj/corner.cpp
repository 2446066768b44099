#include "apps/foreign/obj/corner.h"

#include <algorithm>
#include <string>

#include "apps/foreign/obj/geometry.h"
#include "apps/frontend/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps::obj {
namespace {

constexpr std::array<const char*, named_count> nouns{"vertex", "texture coordinate", "normal"};
constexpr std::uint64_t index_max = none - 1;

[[noreturn]] void refuse_corner(std::string_view word, const LineWords& words) {
  words.fail_at(word, "a corner such as 3, 3/1, 3//2 or 3/1/2");
}

std::string missing_one(std::size_t kind, std::int64_t index, const std::string& why) {
  return "the face has " + std::string(nouns[kind]) + " " + std::to_string(index) + ", which does not exist: " + why;
}

}  // namespace

std::uint32_t CornerReader::index(std::string_view text, std::size_t kind, const LineWords& words, const Counts& so_far) {
  const auto found = number_in<std::int64_t>(text);
  if (!found) {
    refuse_corner(text, words);
  }
  const std::int64_t value = *found;
  const auto count = static_cast<std::int64_t>(so_far[kind]);
  if (value == 0) {
    words.fail(missing_one(kind, 0, "they are counted from 1"));
  }
  if (value < -count) {
    words.fail(missing_one(kind, value, "there are " + std::to_string(count) + " before it"));
  }
  const auto place = static_cast<std::uint64_t>(value > 0 ? value - 1 : count + value);
  std::vector<Later>& later = later_[kind];
  if (value > count && (later.empty() || place > later.back().index)) {
    later.push_back({place, words.line()});
  }
  return static_cast<std::uint32_t>(std::min(place, index_max));  // check_named() refuses larger indices
}

Corner CornerReader::read(std::string_view word, const LineWords& words, const Counts& so_far) {
  Corner corner{none, none, none};
  std::string_view rest = word;
  for (std::size_t kind = 0; kind < named_count && !rest.empty(); ++kind) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    if (end > 0) {
      corner[kind] = index(rest.substr(0, end), kind, words, so_far);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!rest.empty() || corner[0] == none || std::count(word.begin(), word.end(), '/') > 2) {
    refuse_corner(word, words);
  }
  return corner;
}

void CornerReader::check_named(const Counts& all) const {
  const Later* first = nullptr;
  std::size_t first_kind = 0;
  for (std::size_t kind = 0; kind < named_count; ++kind) {
    const auto found = std::find_if(later_[kind].begin(), later_[kind].end(),
                                    [count = all[kind]](const Later& later) { return later.index >= count; });
    if (found != later_[kind].end() && (first == nullptr || found->line < first->line)) {
      first = &*found;
      first_kind = kind;
    }
  }
  if (first != nullptr) {
    const std::string there = "there are " + std::to_string(all[first_kind]);
    throw core::InputError("line " + std::to_string(first->line) + ": " +
                           missing_one(first_kind, static_cast<std::int64_t>(first->index + 1), there));
  }
}

}  // namespace dmpc::apps::obj
