// Numbers of the hits of a bundle side by side, for loops that compilers vectorise. Their bodies are one straight line, each is
// compiled for each width of vectors, and CMakeLists.txt lets compilers compute what a choice then leaves out.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/base/vector_width.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Rows of vectors, by component.
template <class T>
struct RowsOf {
  Row<T> x, y, z;
};
using VectorRows = RowsOf<double>;

template <class T>
void put(RowsOf<T>& rows, std::size_t lane, const Vec3<T>& v) {
  rows.x[lane] = v.x;
  rows.y[lane] = v.y;
  rows.z[lane] = v.z;
}

template <class T>
Vec3<T> get(const RowsOf<T>& rows, std::size_t lane) {
  return {rows.x[lane], rows.y[lane], rows.z[lane]};
}

/// Doubles in the widest vector. Loops over lanes go by groups of so many: those of the last group that are not taken hold what
/// the first one does, by fill_up(), and are computed for nothing.
inline constexpr std::size_t group_lanes = 8;

/// Puts the first of `count` lanes into those behind them, up to a whole group: nothing is computed with what nobody has set.
inline void fill_up(Row<double>& row, std::size_t count) {
  for (; count % group_lanes != 0; ++count) {
    row[count] = row[0];
  }
}
inline void fill_up(VectorRows& rows, std::size_t count) {
  fill_up(rows.x, count);
  fill_up(rows.y, count);
  fill_up(rows.z, count);
}

}  // namespace dmpc::core
