#include "apps/foreign/polygon/ply_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

/// `least` and `most` fit in 64 bits.
bool is_whole_number(double value, double least, double most) {
  return value >= least && value <= most && static_cast<double>(static_cast<std::int64_t>(value)) == value;
}

class TextValues final : public PlyValues {
 public:
  TextValues(std::string_view body, std::size_t first_line) : words_(body, first_line, without_remarks), bytes_(body.size()) {}

  void begin_element() override {
    LineWords ahead = words_;
    const std::string_view more = words_.position() == 0 ? "" : ahead.next_in_line();
    if (!more.empty() && more != "comment" && shared_line_.empty()) {
      shared_line_ = "line " + std::to_string(words_.line()) + ": found '" + clipped(more, 40) +
                     "', expected no more values of an element than the header says";
    }
  }

  double next(PlyType type) override {
    const std::string_view found = word();
    if (found.empty()) {
      throw PlyIsShort{};
    }
    if (!is_whole(type) && is_no_number(found)) {
      return std::numeric_limits<double>::quiet_NaN();  // as the same file in binary has it
    }
    const auto value = decimal_number(found);
    if (!value) {
      words_.fail_at(found, "a number" + doubt());
    }
    if (is_whole(type) && !is_whole_number(*value, least_of(type), most_of(type))) {
      words_.fail_at(found, "a whole number from " + rounded(least_of(type)) + " to " + rounded(most_of(type)) +
                                ", as the header says" + doubt());
    }
    return *value;
  }

  std::uint64_t next_length(PlyType /*count_type*/, PlyType /*type*/) override {
    const std::string_view found = word();
    if (found.empty()) {
      throw PlyIsShort{};
    }
    const auto length = decimal_number(found);
    if (!length || !is_whole_number(*length, 0, 0x1p32)) {
      words_.fail_at(found, "the length of a list" + doubt());
    }
    if (*length > static_cast<double>(left() / 2 + 1)) {
      throw PlyIsShort{};
    }
    return static_cast<std::uint64_t>(*length);
  }

  void next_list(PlyType count_type, PlyType type, std::vector<double>& values) override {
    values.clear();
    for (std::uint64_t left = next_length(count_type, type); left > 0; --left) {
      values.push_back(next(type));
    }
  }

  void skip(PlyType /*type*/, std::uint64_t count) override {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (word().empty()) {
        throw PlyIsShort{};
      }
    }
  }

  std::uint64_t room_for(const PlyElement& element) const override {
    return left() / std::max<std::size_t>(2 * element.properties.size(), 1) + 1;
  }

  std::uint64_t count_rest() override {
    const std::string_view first = word();
    if (!shared_line_.empty() && !first.empty()) {
      throw core::InputError(shared_line_);
    }
    return first.empty() ? 0 : left() + first.size();
  }

  std::size_t position() const override { return words_.position(); }
  std::string doubt() const override { return shared_line_.empty() ? "" : " (" + shared_line_ + ")"; }
  std::string place() const override { return "line " + std::to_string(words_.line()); }

 private:
  std::uint64_t left() const { return bytes_ - words_.position(); }

  /// Skips comments.
  std::string_view word() {
    std::string_view word = words_.next();
    while (word == "comment") {
      words_.rest_of_line();
      word = words_.next();
    }
    return word;
  }

  LineWords words_;
  std::size_t bytes_;
  std::string shared_line_;  ///< describes the first line on which an element starts after another
};

/// Calls act with a value of the C++ type for `type`.
template <class Act>
auto with_type(PlyType type, const Act& act) {
  switch (type) {
    case PlyType::int8:
      return act(std::int8_t{});
    case PlyType::uint8:
      return act(std::uint8_t{});
    case PlyType::int16:
      return act(std::int16_t{});
    case PlyType::uint16:
      return act(std::uint16_t{});
    case PlyType::int32:
      return act(std::int32_t{});
    case PlyType::uint32:
      return act(std::uint32_t{});
    case PlyType::float32:
      return act(float{});
    case PlyType::float64:
      return act(double{});
  }
  core::expect(false, "a value has one of PLY's types");
  return act(double{});
}

class BinaryValues final : public PlyValues {
 public:
  BinaryValues(std::string_view file, std::size_t begin, bool is_big_endian)
      : file_(file), begin_(begin), at_(begin), is_swapped_(is_big_endian == (std::endian::native == std::endian::little)) {}

  void begin_element() override {}

  double next(PlyType type) override {
    return with_type(type, [this](auto of_type) { return static_cast<double>(take<decltype(of_type)>()); });
  }

  std::uint64_t next_length(PlyType count_type, PlyType type) override {
    const double length = next(count_type);
    if (!is_whole_number(length, 0, 0x1p32)) {
      throw core::InputError(place() + ": found " + rounded(length) + ", expected the length of a list");
    }
    if (length > static_cast<double>(left() / bytes_of(type))) {
      throw PlyIsShort{};
    }
    return static_cast<std::uint64_t>(length);
  }

  /// The type is dispatched once for the whole list.
  void next_list(PlyType count_type, PlyType type, std::vector<double>& values) override {
    values.resize(next_length(count_type, type));
    with_type(type, [&](auto of_type) { take_all<decltype(of_type)>(values); });
  }

  void skip(PlyType type, std::uint64_t count) override {
    if (count > left() / bytes_of(type)) {
      throw PlyIsShort{};
    }
    at_ += count * bytes_of(type);
  }

  std::uint64_t room_for(const PlyElement& element) const override {
    const std::uint64_t bytes = core::sum_over<std::uint64_t>(
        element.properties, [&](const PlyProperty& property) { return bytes_of(property.count_type.value_or(property.type)); });
    return left() / std::max<std::uint64_t>(bytes, 1);
  }

  std::uint64_t count_rest() override { return left(); }
  std::size_t position() const override { return at_ - begin_; }
  std::string place() const override { return "byte " + std::to_string(at_); }

 private:
  std::uint64_t left() const { return file_.size() - at_; }

  template <class T>
  T take() {
    if (left() < sizeof(T)) {
      throw PlyIsShort{};
    }
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), file_.data() + at_, sizeof(T));
    if (is_swapped_) {
      std::reverse(bytes.begin(), bytes.end());
    }
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }

  template <class T>
  void take_all(std::vector<double>& values) {
    for (double& value : values) {
      value = static_cast<double>(take<T>());
    }
  }

  std::string_view file_;
  std::size_t begin_, at_;
  bool is_swapped_;
};

}  // namespace

std::unique_ptr<PlyValues> ply_values(const PlyHeader& header, std::string_view file) {
  if (header.format == PlyFormat::text) {
    return std::make_unique<TextValues>(file.substr(header.bytes), header.lines + 1);
  }
  return std::make_unique<BinaryValues>(file, header.bytes, header.format == PlyFormat::big_endian);
}

}  // namespace dmpc::apps
