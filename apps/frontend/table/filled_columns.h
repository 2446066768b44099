// Columns that define their cells, so that the head of a table and its rows are declared once.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/frontend/table/table.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

/// A column, and how it computes its cell for a subject: a run, a result, or the like.
template <class Subject>
struct FilledColumn {
  Column column;
  std::function<Cell(const Subject&)> cell;
};

template <class Subject>
using FilledColumns = std::vector<FilledColumn<Subject>>;

/// Returns an empty cell for nothing.
template <class Value>
Cell cell_of(const std::optional<Value>& value) {
  return value ? Cell(*value) : Cell();
}

/// Returns a function that fills cells by `cell` for subjects that are `meant`, and leaves others empty.
template <class Meant, class Fill>
auto only_if(Meant meant, Fill cell) {
  return [meant, cell](const auto& subject) { return meant(subject) ? Cell(cell(subject)) : Cell(); };
}

template <class Subject>
std::vector<Column> heads_of(const FilledColumns<Subject>& columns) {
  return core::mapped<Column>(columns, [&](const FilledColumn<Subject>& one) { return one.column; });
}

template <class Subject>
std::vector<Cell> row_of(const FilledColumns<Subject>& columns, const Subject& subject) {
  return core::mapped<Cell>(columns, [&](const FilledColumn<Subject>& one) { return one.cell(subject); });
}

}  // namespace dmpc::apps
