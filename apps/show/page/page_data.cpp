#include "apps/show/page/page_data.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "apps/show/page/typed_array.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;

/// Deeper than any data of ours, and small enough for a recursive function.
constexpr int depth_max = 16;

constexpr const char* what_to_do = "; the page is damaged, or was changed: render it again with --report";

}  // namespace

std::optional<json> data_in(std::string_view page, const std::string& file) {
  constexpr std::string_view begin = "<script type=\"application/json\" id=\"data\">", end = "</script>";
  const std::size_t at = page.find(begin);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  page.remove_prefix(at + begin.size());
  const std::size_t length = page.find(end);
  if (length == std::string_view::npos) {
    throw core::InputError(file + ": this page ends within its data, it was cut off; copy it or render it again");
  }
  try {
    json data = json::parse(page.substr(0, length), [&file](int depth, json::parse_event_t, const json&) {
      if (depth > depth_max) {
        throw core::InputError(file + ": its data have more than " + std::to_string(depth_max) + " objects in each other" +
                               what_to_do);
      }
      return true;
    });
    if (data.is_object()) {
      return data;
    }
  } catch (const json::exception&) {
  }
  throw core::InputError(file + ": its data are no object of JSON" + what_to_do);
}

void DataPart::refuse(const std::string& expected) const {
  throw core::InputError(where_ + ": expected " + expected + what_to_do);
}

DataPart DataPart::at(const char* key) const {
  if (!has(key)) {
    refuse(std::string("an object with \"") + key + "\"");
  }
  return {(*value_)[key], where_ + "." + key};
}

DataPart DataPart::at(std::size_t place) const {
  if (!value_->is_array() || place >= value_->size()) {
    refuse("a list with more than " + std::to_string(place) + " entries");
  }
  return {(*value_)[place], where_ + "." + std::to_string(place)};
}

std::size_t DataPart::size(std::size_t most) const {
  if (!value_->is_array() || value_->size() > most) {
    refuse("a list of at most " + std::to_string(most) + " entries");
  }
  return value_->size();
}

std::uint64_t DataPart::whole(std::uint64_t most, std::uint64_t least) const {
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > most || value_->get<std::uint64_t>() < least) {
    refuse("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value_->get<std::uint64_t>();
}

double DataPart::number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) {
    refuse("a number");
  }
  return value_->get<double>();
}

std::string DataPart::text(std::size_t most) const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().size() > most) {
    refuse("a text of at most " + std::to_string(most) + " bytes");
  }
  return value_->get<std::string>();
}

std::size_t DataPart::count_numbers(std::uint64_t most) const {
  const std::optional<std::vector<std::uint64_t>> numbers = numbers_of(*value_);
  if (!numbers) {
    refuse("whole numbers in base 64");
  }
  for (const std::uint64_t number : *numbers) {
    if (number > most) {
      refuse("whole numbers up to " + std::to_string(most));
    }
  }
  return numbers->size();
}

const json& DataPart::numbers(std::size_t count, std::uint64_t most) const {
  if (const std::size_t found = count_numbers(most); found != count) {
    refuse(std::to_string(count) + " numbers, and there are " + std::to_string(found));
  }
  return *value_;
}

}  // namespace dmpc::apps::html
