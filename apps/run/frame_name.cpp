#include "apps/run/frame_name.h"

#include <algorithm>

#include "apps/frontend/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// The position of the number in a name, and its minimum number of digits.
struct Place {
  std::size_t begin = 0, length = 0, digits = 0;
};

/// Parses "%d" or "%04d" at `begin`.
std::optional<Place> printed_place(const std::string& name, std::size_t begin) {
  const std::size_t letter = name.find_first_not_of("0123456789", begin + 1);
  if (letter == std::string::npos || name[letter] != 'd') {
    return std::nullopt;
  }
  const std::string width = name.substr(begin + 1, letter - begin - 1);
  const std::size_t digits = number_in<std::size_t>(width).value_or(0);
  const bool is_width = width.empty() || (width.front() == '0' && digits > 0 && digits <= 20);
  return is_width ? std::optional(Place{begin, letter + 1 - begin, digits}) : std::nullopt;
}

std::optional<Place> place_at(const std::string& name, std::size_t begin) {
  if (name[begin] == '#') {
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    return Place{begin, end - begin, end - begin};
  }
  return name[begin] == '%' ? printed_place(name, begin) : std::nullopt;
}

}  // namespace

std::optional<FrameName> FrameName::in(const std::filesystem::path& path, std::string_view option) {
  const std::string name = path.filename().string();
  std::optional<Place> found;
  for (std::size_t i = 0; i < name.size();) {
    const std::optional<Place> place = place_at(name, i);
    if (place && found) {
      throw core::UsageError(std::string(option) + "=" + path.string() +
                             ": expected one place for the frame's number, such as in out.####.png: this has two");
    }
    found = place ? place : found;
    i += place ? place->length : 1;
  }
  if (!found) {
    return std::nullopt;
  }
  FrameName frame_name;
  frame_name.folder_ = path.parent_path();
  frame_name.before_ = name.substr(0, found->begin);
  frame_name.after_ = name.substr(found->begin + found->length);
  frame_name.digits_ = found->digits;
  return frame_name;
}

std::string FrameName::number_text(std::uint64_t frame) const {
  const std::string number = std::to_string(frame);
  return std::string(digits_ - std::min(digits_, number.size()), '0') + number;
}

std::filesystem::path FrameName::of(std::uint64_t frame) const { return folder_ / (before_ + number_text(frame) + after_); }

std::optional<std::uint64_t> FrameName::frame_of(const std::string& file_name) const {
  const std::size_t beside = before_.size() + after_.size();
  if (file_name.size() <= beside || !file_name.starts_with(before_) || !file_name.ends_with(after_)) {
    return std::nullopt;
  }
  const std::string number = file_name.substr(before_.size(), file_name.size() - beside);
  const auto frame = number_in<std::uint64_t>(number);
  return frame && number_text(*frame) == number ? frame : std::nullopt;
}

}  // namespace dmpc::apps
