// The vector width of this processor, and loops compiled for each width.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// The target of a loop: any processor, or one with all of x86-64-v3 (AVX2) or v4 (AVX-512). All give the same bits.
enum class VectorWidth : std::uint8_t { any, bits_256, bits_512 };

/// The widest target that this processor supports.
VectorWidth vector_width();

template <class Loop>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void run_by_512(const Loop& loop) {
  loop();
}
template <class Loop>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void run_by_256(const Loop& loop) {
  loop();
}
/// Calls loop(), which is compiled for each width; its body must be branch-free for compilers to vectorise it. Requires a
/// processor that supports `width`.
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
