#include "apps/foreign/gltf/part.h"

#include <algorithm>
#include <cmath>

#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps::gltf {

void Part::fail(const std::string& what) const { throw core::InputError(where_ + (where_.empty() ? "" : ": ") + what); }

std::optional<Part> Part::find(const std::string& key) const {
  if (!value_->is_object()) {
    fail("not of type object, which is expected here");
  }
  const auto found = value_->find(key);
  return found == value_->end() ? std::nullopt : std::optional(Part(*found, where_ + (where_.empty() ? "" : ".") + key));
}

Part Part::get(const std::string& key) const {
  const auto found = find(key);
  return found ? *found : (fail("has no \"" + key + "\", which has to be there"), *this);
}

std::optional<Part> Part::extension(const std::string& name) const {
  const auto all = find("extensions");
  return all ? all->find(name) : std::nullopt;
}

std::vector<Part> Part::list(const std::string& key) const {
  std::vector<Part> entries;
  const auto found = find(key);
  if (found && !found->value_->is_array()) {
    found->fail("not of type array, which is expected here");
  }
  for (std::size_t i = 0; found && i < found->value_->size(); ++i) {
    entries.emplace_back((*found->value_)[i], found->where_ + "[" + std::to_string(i) + "]");
  }
  return entries;
}

std::vector<std::pair<std::string, Part>> Part::members() const {
  std::vector<std::pair<std::string, Part>> all;
  if (value_->is_object()) {
    for (const auto& [key, value] : value_->items()) {
      all.emplace_back(key, Part(value, where_ + (where_.empty() ? "" : ".") + key));
    }
  }
  return all;
}

double Part::as_number() const {
  if (!value_->is_number()) {
    fail("not of type number, which is expected here");
  }
  return value_->get<double>();
}

std::uint64_t Part::as_whole() const {
  constexpr double most = 9007199254740992;  // up to which doubles have all whole numbers
  const double number = as_number();
  if (!(number >= 0) || number > most || number != std::floor(number)) {
    fail("not of type whole number from 0 on, which is expected here");
  }
  return static_cast<std::uint64_t>(number);
}

std::string Part::as_text() const {
  if (!value_->is_string()) {
    fail("not of type string, which is expected here");
  }
  return value_->get<std::string>();
}

std::size_t Part::as_index(std::size_t count, const std::string& list) const {
  const std::uint64_t index = as_whole();
  if (index >= count) {
    fail("refers to " + list + "[" + std::to_string(index) + "], which does not exist: there are " + std::to_string(count));
  }
  return index;
}

std::uint64_t Part::whole(const std::string& key, std::uint64_t fallback) const {
  const auto found = find(key);
  return found ? found->as_whole() : fallback;
}

double Part::number(const std::string& key, double fallback) const {
  const auto found = find(key);
  return found ? found->as_number() : fallback;
}

std::string Part::text(const std::string& key, const std::string& fallback) const {
  const auto found = find(key);
  return found ? found->as_text() : fallback;
}

std::string Part::choice(const std::string& key, const std::vector<std::string>& names, const std::string& fallback) const {
  const std::string found = fallback.empty() ? get(key).as_text() : text(key, fallback);
  if (std::find(names.begin(), names.end(), found) == names.end()) {
    get(key).fail("is '" + clipped(found, 40) + "', expected " + joined({names.begin(), names.end() - 1}, ", ") + " or " +
                  names.back());
  }
  return found;
}

bool Part::flag(const std::string& key) const {
  const auto found = find(key);
  if (found && !found->value_->is_boolean()) {
    found->fail("not of type true or false, which is expected here");
  }
  return found && found->value_->get<bool>();
}

std::vector<double> Part::numbers(const std::string& key, std::vector<double> fallback) const {
  const std::vector<Part> entries = list(key);
  if (!find(key)) {
    return fallback;
  }
  if (entries.size() != fallback.size()) {
    get(key).fail("has " + std::to_string(entries.size()) + " numbers, expected " + std::to_string(fallback.size()));
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    fallback[i] = entries[i].as_number();
  }
  return fallback;
}

std::optional<std::size_t> Part::index(const std::string& key, std::size_t count, const std::string& list) const {
  const auto found = find(key);
  return found ? std::optional(found->as_index(count, list)) : std::nullopt;
}

std::size_t Part::required_index(const std::string& key, std::size_t count, const std::string& list) const {
  return get(key).as_index(count, list);
}

}  // namespace dmpc::apps::gltf
