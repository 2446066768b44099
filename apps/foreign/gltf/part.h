// A part of a glTF document's JSON with its path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps::gltf {

/// Reads from a document, which outlives it. Errors are core::InputError "meshes[0].primitives[1].mode: ...".
class Part {
 public:
  explicit Part(const nlohmann::json& value, std::string where = "") : value_(&value), where_(std::move(where)) {}

  /// "meshes[0].primitives[1]"; empty for the whole document.
  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// The member of this name, if there is one.
  std::optional<Part> find(const std::string& key) const;
  Part get(const std::string& key) const;
  /// extensions.NAME, if there is one.
  std::optional<Part> extension(const std::string& name) const;

  /// The entries of the list of this name; empty if it does not exist.
  std::vector<Part> list(const std::string& key) const;
  /// Names and values of an object's members.
  std::vector<std::pair<std::string, Part>> members() const;

  /// Values of members; `fallback` if there is no such member.
  std::uint64_t whole(const std::string& key, std::uint64_t fallback) const;
  double number(const std::string& key, double fallback) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  /// One of `names`; without a fallback the member is mandatory.
  std::string choice(const std::string& key, const std::vector<std::string>& names, const std::string& fallback = "") const;
  bool flag(const std::string& key) const;
  /// A list of as many numbers as the fallback has.
  std::vector<double> numbers(const std::string& key, std::vector<double> fallback) const;
  /// An index into a list with `count` entries that is called `list`; in the second form the member is mandatory.
  std::optional<std::size_t> index(const std::string& key, std::size_t count, const std::string& list) const;
  std::size_t required_index(const std::string& key, std::size_t count, const std::string& list) const;

  bool is_number() const { return value_->is_number(); }
  /// The value itself.
  std::uint64_t as_whole() const;
  double as_number() const;
  std::string as_text() const;
  std::size_t as_index(std::size_t count, const std::string& list) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace dmpc::apps::gltf
