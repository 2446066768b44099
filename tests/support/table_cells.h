// What stands in a table.
#pragma once

#include <algorithm>
#include <string>
#include <variant>

#include "apps/frontend/table/table.h"
#include "tests/support/text.h"

namespace dmpc::tests {

/// What stands in the column called `name` of `row`.
inline apps::Cell cell(const apps::Table& table, std::size_t row, const std::string& name) {
  std::size_t column = 0;
  while (table.columns().at(column).name != name) {
    ++column;
  }
  return table.rows().at(row)[column];
}

/// What stands there, where a real number, a whole one, a text or nothing is known to stand.
inline double real(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::get<double>(cell(table, row, name));
}
inline std::uint64_t whole(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::get<std::uint64_t>(cell(table, row, name));
}
inline std::string text(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::get<std::string>(cell(table, row, name));
}
inline bool is_missing(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::holds_alternative<std::monostate>(cell(table, row, name));
}

/// The real number that stands in `cell`.
inline double number(const apps::Cell& cell) { return std::get<double>(cell); }

inline bool has_note(const apps::Table& table, const std::string& words) {
  return std::any_of(table.notes().begin(), table.notes().end(), [&](const std::string& note) { return contains(note, words); });
}

}  // namespace dmpc::tests
