#include "apps/foreign/mesh/mtl_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/edge/system/byte_order_mark.h"
#include "apps/foreign/mesh/trimmed.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view blanks = " \t", line_ends = "\r\n";
/// The longest name of a texture, with the options before it; Assimp holds no more.
constexpr std::size_t name_bytes_max = 1023;

/// How many arguments an option of a texture has at most, and what it is without the option.
struct Option {
  std::string_view name;
  std::size_t numbers_max;  ///< 0: a word
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

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

/// The first word, and what follows it.
struct Split {
  std::string_view word, rest;
};

Split split(std::string_view text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(blanks), text.size());
  return {text.substr(0, end), trimmed(text.substr(end))};
}

std::optional<double> number_from(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_whole = error == std::errc() && end == word.data() + word.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

const Option* option_of(std::string_view word) {
  const auto found = std::find_if(options.begin(), options.end(),
                                  [name = in_small_letters(word)](const Option& option) { return option.name == name; });
  return found == options.end() ? nullptr : &*found;
}

/// An option as it stands before a texture's name.
struct Said {
  const Option* option;
  std::array<double, 3> numbers;
  std::string word;

  bool changes() const { return option->numbers_max > 0 ? numbers != option->plain_numbers : word != option->plain_word; }
};

/// Cuts the option's arguments off, of which there may be fewer; the last word is the texture's name, whatever it looks like.
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
    const auto number = number_from(next.word);
    if (!number || next.rest.empty()) {
      break;
    }
    said.numbers[i] = *number;
    rest = next.rest;
  }
  return said;
}

/// What stands before a texture's name, which is left.
std::vector<Said> take_options(std::string_view& rest) {
  std::vector<Said> all;
  for (Split next = split(rest); !next.rest.empty(); next = split(rest)) {
    const Option* const option = option_of(next.word);
    if (option == nullptr) {
      break;
    }
    rest = next.rest;
    all.push_back(take_arguments(*option, rest));
  }
  return all;
}

bool is_texture(const std::string& keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "norm" || keyword == "decal";
}

/// MTL's t grows upwards: s' = su s + ou, t' = sv t + ov.
TexturePlace place_of(const std::array<double, 3>& scale, const std::array<double, 3>& offset) {
  return {{{{scale[0], 0, offset[0]}, {0, scale[1], 1 - scale[1] - offset[1]}}}};
}

void keep(const std::vector<Said>& said, const std::string& material, MtlTextures& textures) {
  std::array<double, 3> scale{1, 1, 1}, offset{};
  for (const Said& one : said) {
    if (one.option->name == "-s") {
      scale = one.numbers;
    } else if (one.option->name == "-o") {
      offset = one.numbers;
    } else if (one.option->name != "-clamp" && one.changes()) {
      ++textures.left_out[std::string(one.option->name)];
    }
  }
  textures.places[material] = place_of(scale, offset);
}

bool is_clamped(const std::vector<Said>& said) {
  const auto last = std::find_if(said.rbegin(), said.rend(), [](const Said& one) { return one.option->name == "-clamp"; });
  return last != said.rend() && last->word == "on";
}

/// Goes through a file, line by line.
class MtlWalk {
 public:
  MtlWalk(const std::string& path, MtlTextures& textures) : path_(path), textures_(textures) {}

  PlainMtl read(std::string_view file) {
    std::string text;
    for (file = without_mark(file); !file.empty(); ++number_) {
      const std::size_t end = std::min(file.find_first_of(line_ends), file.size());
      const std::size_t next = std::min(end + (file.substr(end).starts_with("\r\n") ? 2 : 1), file.size());
      text += plain_line(file.substr(0, end));
      text += file.substr(end, next - end);
      file.remove_prefix(next);
    }
    return {std::move(text), note()};
  }

 private:
  std::string plain_line(std::string_view line) {
    const auto [word, rest] = split(line);
    const std::string keyword = in_small_letters(word);
    if (keyword == "newmtl") {
      material_ = rest;
    }
    if (!is_texture(keyword)) {
      return std::string(line);
    }
    std::string_view name = rest;
    const std::vector<Said> said = take_options(name);
    if (keyword == "map_kd") {
      check_name(rest.size());
      keep(said, material_, textures_);
    }
    return said.empty() ? std::string(line) : std::string(word) + (is_clamped(said) ? " -clamp on " : " ") + std::string(name);
  }

  void check_name(std::size_t name_bytes) {
    if (name_bytes > name_bytes_max) {
      throw core::InputError(path_ + " names a texture in " + std::to_string(name_bytes) + " bytes in line " +
                             std::to_string(number_) + "; expected at most " + std::to_string(name_bytes_max));
    }
    if (name_bytes == 0 && nameless_++ == 0) {
      first_nameless_ = number_;
    }
  }

  std::string note() const {
    return nameless_ == 0 ? ""
                          : path_ + ": map_Kd names no file in line " + std::to_string(first_nameless_) +
                                (nameless_ == 1 ? "" : " and " + std::to_string(nameless_ - 1) + " others") +
                                ": there the plain colour is shown";
  }

  const std::string& path_;
  MtlTextures& textures_;
  std::string material_;
  std::size_t number_ = 1;  ///< of the line, as editors count
  std::size_t nameless_ = 0, first_nameless_ = 0;
};

}  // namespace

PlainMtl plain_mtl(const std::string& path, std::string_view file, MtlTextures& textures) {
  return MtlWalk(path, textures).read(file);
}

}  // namespace dmpc::apps
