#include "apps/foreign/obj/texture_words.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/small_letters.h"
#include "core/base/ranges.h"
#include "core/scene/texture.h"

namespace dmpc::apps::obj {
namespace {

/// The maximum number of arguments of a texture option, and its default.
struct Option {
  std::string_view name;
  std::size_t numbers_max;  ///< 0: a single word
  std::string_view plain_word;
  std::array<double, 3> plain_numbers;
};

constexpr std::array options{
    Option{"-s", 3, "", {1, 1, 1}},      Option{"-o", 3, "", {0, 0, 0}},     Option{"-t", 3, "", {0, 0, 0}},
    Option{"-mm", 2, "", {0, 1, 0}},     Option{"-boost", 1, "", {0, 0, 0}}, Option{"-bm", 1, "", {1, 0, 0}},
    Option{"-texres", 1, "", {0, 0, 0}}, Option{"-blendu", 0, "on", {}},     Option{"-blendv", 0, "on", {}},
    Option{"-cc", 0, "off", {}},         Option{"-clamp", 0, "off", {}},     Option{"-imfchan", 0, "", {}},
    Option{"-type", 0, "", {}},
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// The first word, and the text after it.
struct Split {
  std::string_view word, rest;
};

Split split(std::string_view text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  return {text.substr(0, end), trimmed(text.substr(end))};
}

const Option* option_of(std::string_view word) { return core::find_in(options, in_small_letters(word), &Option::name); }

/// An option before a texture's name.
struct Said {
  const Option* option;
  std::array<double, 3> numbers;
  std::string word;

  bool changes() const { return option->numbers_max > 0 ? numbers != option->plain_numbers : word != option->plain_word; }
};

/// Removes the option's arguments, of which there may be fewer than the maximum.
Said take_arguments(const Option& option, std::string_view& rest) {
  Said said{&option, option.plain_numbers, std::string(option.plain_word)};
  if (option.numbers_max == 0) {
    const Split next = split(rest);
    if (!next.rest.empty()) {
      said.word = in_small_letters(next.word);
      rest = next.rest;
    }
    return said;
  }
  for (std::size_t i = 0; i < option.numbers_max; ++i) {
    const Split next = split(rest);
    const auto number = decimal_number(next.word);
    if (!number || next.rest.empty()) {
      break;
    }
    said.numbers[i] = *number;
    rest = next.rest;
  }
  return said;
}

/// In MTL files t increases upwards: s' = su s + ou, t' = sv t + ov.
TexturePlace place_of(const std::array<double, 3>& scale, const std::array<double, 3>& offset) {
  return {{{{scale[0], 0, offset[0]}, {0, scale[1], 1 - scale[1] - offset[1]}}}};
}

}  // namespace

TextureWords texture_words(std::string_view text) {
  TextureWords words;
  std::array<double, 3> scale{1, 1, 1}, offset{};
  std::string_view rest = trimmed(text);
  for (Split next = split(rest); !next.rest.empty(); next = split(rest)) {
    const Option* const option = option_of(next.word);
    if (option == nullptr) {
      break;
    }
    rest = next.rest;
    const Said said = take_arguments(*option, rest);
    if (option->name == "-s") {
      scale = said.numbers;
    } else if (option->name == "-o") {
      offset = said.numbers;
    } else if (option->name == "-clamp") {
      const auto wrap = said.word == "on" ? core::TextureWrap::clamp : core::TextureWrap::repeat;
      words.edges = {wrap, wrap};
    } else if (said.changes()) {
      words.left_out.emplace_back(option->name);
    }
  }
  words.name = rest;
  words.place = place_of(scale, offset);
  return words;
}

}  // namespace dmpc::apps::obj
