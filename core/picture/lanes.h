// Numbers of the hits of a bundle side by side, for loops that compilers vectorise. Their bodies are one straight line, each is
// compiled for each width of vectors, and CMakeLists.txt lets compilers compute what a choice then leaves out.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/trace/bundle.h"
#include "core/trace/vector_width.h"

namespace dmpc::core {

/// Rows of vectors, by component.
struct VectorRows {
  Row<double> x, y, z;
};

inline void put(VectorRows& rows, std::size_t lane, const Vec3d& v) {
  rows.x[lane] = v.x;
  rows.y[lane] = v.y;
  rows.z[lane] = v.z;
}

inline Vec3d get(const VectorRows& rows, std::size_t lane) { return {rows.x[lane], rows.y[lane], rows.z[lane]}; }

/// So many lanes rounded up to whole vectors: those that are not taken hold zeros, and are computed for nothing.
inline std::size_t whole_groups(std::size_t count) {
  constexpr std::size_t group_lanes = 8;  // doubles in the widest vector
  return (count + group_lanes - 1) / group_lanes * group_lanes;
}

template <class Loop>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void run_by_512(const Loop& loop) {
  loop();
}
template <class Loop>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void run_by_256(const Loop& loop) {
  loop();
}
/// Calls loop(), which is compiled for each width. Requires a processor that has it.
template <class Loop>
void run_by(VectorWidth width, const Loop& loop) {
  switch (width) {
    case VectorWidth::bits_512:
      return run_by_512(loop);
    case VectorWidth::bits_256:
      return run_by_256(loop);
    case VectorWidth::any:
      return loop();
  }
}

}  // namespace dmpc::core
